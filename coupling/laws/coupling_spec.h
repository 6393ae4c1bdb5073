// A coupling as plain data, and the list of all that there are.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "coupling/laws/as_published.h"
#include "coupling/laws/coupling.h"
#include "coupling/laws/mujoco_weld.h"

namespace twinarm {

// What a calibration file, a report and a scene can hold.
struct CouplingSpec {
  enum class Type { torsional, linear, matched, bushing, weld_like, stable_pd, god_object };
  std::string name;
  Type type = Type::torsional;
  bool printed = false;  // the paper's own equations (PrintedOptions), or the consistent form
  PrintedOptions options;
  Measure measure = Measure::world;            // consistent torsional
  Treatment treatment = Treatment::explicit_;  // consistent, where its facts say that it has any
  int hold_steps = 0;       // consistent linear, torsional, bushing; 0: every step and stage
  WeldReference reference;  // weld-like
  std::vector<Spring> springs;
};
std::unique_ptr<Coupling> make_coupling(const CouplingSpec& spec, const Model<double>& model,
                                        KinematicRobot& kvr);

struct CouplingFacts {
  enum class Treatments { all, explicit_only, own };
  const char* name;  // in scenes and tables
  CouplingSpec::Type type;
  bool printed;
  Treatments treatments;  // own: it is a treatment itself, and goes with semi-implicit Euler only
  bool at_point;          // Spring::p_L counts
  bool can_hold;          // CouplingSpec::hold_steps, or PrintedOptions::hold_steps
};
inline constexpr std::array<CouplingFacts, 9> all_couplings{{
    {"linear", CouplingSpec::Type::linear, false, CouplingFacts::Treatments::all, true, true},
    {"torsional", CouplingSpec::Type::torsional, false, CouplingFacts::Treatments::all, false,
     true},
    {"bushing", CouplingSpec::Type::bushing, false, CouplingFacts::Treatments::all, true, true},
    {"weld", CouplingSpec::Type::weld_like, false, CouplingFacts::Treatments::all, true, false},
    {"matched", CouplingSpec::Type::matched, false, CouplingFacts::Treatments::explicit_only, true,
     false},
    {"stable-pd", CouplingSpec::Type::stable_pd, false, CouplingFacts::Treatments::own, false,
     false},
    {"god-object", CouplingSpec::Type::god_object, false, CouplingFacts::Treatments::own, false,
     false},
    {"printed-linear", CouplingSpec::Type::linear, true, CouplingFacts::Treatments::explicit_only,
     true, true},
    {"printed-torsional", CouplingSpec::Type::torsional, true,
     CouplingFacts::Treatments::explicit_only, false, true},
}};
const CouplingFacts& facts_of(CouplingSpec::Type type, bool printed);

}  // namespace twinarm
