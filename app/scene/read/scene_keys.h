// The numbers of a scene file, one row a key. From the rows are made: what the reader takes and
// refuses, what a change of a coupling's type leaves out, the units of `map`, the sliders of the
// lab, and the tables of docs/reference/scene_file.md. A key more is a row more, and the member that it fills; a
// slider more is `slider` in its row.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/data/table_reader.h"
#include "app/scene/read/scene_description.h"

namespace twinarm {

// What a number may be; `fits` beside its sign, with what a fault says where it does not.
struct NumberRange {
  enum class Sign { any, not_negative, positive } sign = Sign::not_negative;
  bool (*fits)(double) = nullptr;
  const char *problem = "", *fix = "";
};

// What the lab offers, without a label nothing; and what the number means.
struct SliderRow {
  enum Scale { log, linear };
  const char* label = nullptr;
  double low = 0, high = 0;
  const char* meaning = "";
  Scale scale = log;
  bool restarts = false;  // the run goes on from coordinates and velocities alone
};

// Of robots and bodies, and of pairs in place of what these have.
struct SurfaceKey {
  const char *key, *unit = "";
  NumberRange range = {};
  double Surface::*member;
  std::optional<double> PairDescription::*of_pair = nullptr;  // nullptr: pairs have none
  SliderRow slider = {};
  bool is_of_compliant = false;  // the slider goes with compliant contacts alone
};
const std::vector<SurfaceKey>& surface_keys();

// Of couplings. Rows without a number stand for a key that some types have and others have not.
struct CouplingKey {
  const char* key;
  bool (*has)(const CouplingFacts& facts);
  const char* useless = "";  // what is told where a type has it not, or a target
  const char *unit = "", *turning_unit = nullptr;  // the latter of those that turn a link
  NumberRange range = {};
  double& (*number)(CouplingDescription& coupling) = nullptr;
  // Where a change of type adds the key that must be there: its value, or the multiple of another.
  double added = 0;
  const char* added_times = nullptr;
  SliderRow slider = {};
  double turning_low = 0, turning_high = 0;  // of its slider, where it turns a link; 0: the same
  // The targets that it goes with, and what helps where it stands beside another; nullptr: all.
  bool (*of_target)(CouplingTarget::Kind target) = nullptr;
  const char* help = "";

  bool is_required() const { return added > 0; }
  const char* unit_of(bool turns) const { return turns && turning_unit ? turning_unit : unit; }
  double value(const CouplingDescription& c) const {
    return number(const_cast<CouplingDescription&>(c));
  }
};
const std::vector<CouplingKey>& coupling_keys();
const CouplingKey& coupling_key(const std::string& key);  // that must be there

// Where the key stands and is within its range; else nothing, or a fault.
std::optional<double> read_number(TableReader& table, const char* key, const NumberRange& range);

// After the `type` of a [[coupling]] was changed: leaves out the keys that the new type has not,
// and adds what it must have, in `line`. A type that is not known stays, for the reader to tell.
void fit_keys_to_type(Value& coupling, int line);

// What is measured in which unit, by the path's last key; empty where that is not known. Of a
// coupling's gain it depends on the couplings that are meant.
std::string unit_of_number(const Value& scene, const std::string& path);

// The rows as Markdown: a table of surfaces, an empty line, one of couplings.
std::string scene_numbers();

}  // namespace twinarm
