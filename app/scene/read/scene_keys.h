// The numeric keys of surfaces and couplings, a row each: for the reader, a change of a coupling's
// type, units of `map`, sliders of the lab, tables of docs/reference/scene_file.md. A new key is a
// row and the member that it fills. Keys of other tables (step, mass, ..) are read in read_*.cpp.
#pragma once

#include "app/scene/read/scene_description.h"

namespace twinarm {

// Range of a number: its sign and, if set, `fits`, with problem and fix of the diagnostic.
struct NumberRange {
  enum class Sign { any, not_negative, positive } sign = Sign::not_negative;
  bool (*fits)(double) = nullptr;
  const char *problem = "", *fix = "";
};

// The slider of the lab, if it has a label; and the meaning of the number.
struct SliderRow {
  enum Scale { log, linear };
  const char* label = nullptr;
  double low = 0, high = 0;
  const char* meaning = "";
  Scale scale = log;
  bool restarts = false;  // a change keeps only coordinates and velocities
};

// Of robots and bodies, and of pairs, which override them.
struct SurfaceKey {
  const char *key, *unit = "";
  NumberRange range = {};
  double ContactSurface::*member;
  std::optional<double> PairDescription::*of_pair = nullptr;  // nullptr: not a key of pairs
  SliderRow slider = {};
  bool is_of_compliant = false;  // slider only for compliant contacts
};
const std::vector<SurfaceKey>& surface_keys();

// Of couplings. Rows without `number` are other keys that only some types have.
struct CouplingKey {
  const char* key;
  bool (*has)(const CouplingFacts& facts);
  const char* useless = "";                        // diagnostic if type or target do not have it
  const char *unit = "", *turning_unit = nullptr;  // the latter for torsional ones
  NumberRange range = {};
  double& (*number)(CouplingDescription& coupling) = nullptr;
  // A required key is added with this value, or multiple of another key, when the type changes.
  double added = 0;
  const char* added_times = nullptr;
  SliderRow slider = {};
  double turning_low = 0, turning_high = 0;  // slider of torsional ones; 0: the same
  // Targets with which it is valid (nullptr: all), and the fix for other ones.
  bool (*of_target)(CouplingTarget::Kind target) = nullptr;
  const char* help = "";

  bool is_required() const { return added > 0; }
  const char* unit_of(bool is_torsional) const {
    return is_torsional && turning_unit ? turning_unit : unit;
  }
  double value(const CouplingDescription& c) const {
    return number(const_cast<CouplingDescription&>(c));
  }
};
const std::vector<CouplingKey>& coupling_keys();
const CouplingKey& coupling_key(const std::string& key);  // must exist

// The number, if given; a diagnostic if it is out of range.
std::optional<double> read_number(TableReader& table, const char* key, const NumberRange& range);

// After a change of the `type` of a [[coupling]]: removes keys that the new type does not have and
// adds required ones, with line number `line`. Unknown types are left to the reader.
void fit_keys_to_type(Value& coupling, int line);

// Unit of the number at the path; empty if unknown, or if it differs between the couplings that the
// path denotes.
std::string unit_of_number(const Value& scene, const std::string& path);

// Markdown tables of surface keys and of coupling keys.
std::string scene_numbers();

}  // namespace twinarm
