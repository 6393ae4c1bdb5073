// A coupling as plain data, and the registry of coupling types.
//
// A coupling type is one file NAME_coupling.cpp of this folder: its class, and `CouplingFacts
// NAME_coupling()`, which CMake registers (coupling/laws/CMakeLists.txt) for scenes, the lab, maps,
// predictions and tests.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/laws/as_published.h"
#include "coupling/laws/coupling.h"
#include "coupling/laws/mujoco_weld.h"
#include "coupling/target/target_robot.h"
#include "solver/forces/force_source.h"

namespace twinarm {

// Parameters of a coupling in a scene, calibration file or report.
struct CouplingSpec {
  struct Type {  // the registered name, with constants for types used in code
    std::string_view name;
    friend constexpr bool operator==(const Type&, const Type&) = default;
    static const Type torsional, linear, equivalent_torsional, bushing, weld, stable_pd, god_object;
  };
  std::string name;
  Type type = Type::torsional;
  bool printed = false;  // as published (AsPublishedOptions), or the consistent form
  AsPublishedOptions options;
  SpringSpace measure = SpringSpace::world;                   // consistent torsional
  Discretization discretization = Discretization::explicit_;  // of types with several
  int hold_steps = 0;          // zero-order hold of linear, torsional, bushing; 0: none
  SolrefParameters reference;  // weld
  std::vector<Spring> springs;
};
inline constexpr CouplingSpec::Type CouplingSpec::Type::torsional{"torsional"},
    CouplingSpec::Type::linear{"linear"},
    CouplingSpec::Type::equivalent_torsional{"equivalent-torsional"},
    CouplingSpec::Type::bushing{"bushing"}, CouplingSpec::Type::weld{"weld"},
    CouplingSpec::Type::stable_pd{"stable-pd"}, CouplingSpec::Type::god_object{"god-object"};

// Step law in linear theory (coupling/analysis/step_matrix.h).
enum class StepLaw { spring_damper, printed, stable_pd, god_object };

struct CouplingFacts {
  enum class Discretizations { all, explicit_only, own };
  // Gains in a scene: stiffness and damping; linear and torsional; SolrefParameters; none (god
  // object).
  enum class Gains { spring, two_springs, reference, none };
  const char* name;           // in scenes and tables
  CouplingSpec::Type type{};  // default: name
  bool printed = false;
  int order = 100;  // in lists
  // own: fixed by the law, for semi-implicit Euler only.
  Discretizations discretizations = Discretizations::explicit_only;
  Gains gains = Gains::spring;
  // Acts on a point (Spring::p_L), a joint coordinate, or as CouplingSpec::measure; none of these:
  // link orientation.
  bool at_point = false, at_joint = false, has_measure = false;
  bool can_hold = false;  // CouplingSpec::hold_steps, or AsPublishedOptions::hold_steps
  // Its force is k e + b e' of its springs. False: the energy balance lists its work as `drive`.
  bool is_spring_damper = true;
  StepLaw step_law = StepLaw::spring_damper;
  std::unique_ptr<Coupling> (*make)(const CouplingSpec& spec, const Model<double>& model,
                                    TargetRobot& kvr);

  bool acts_at_joint(SpringSpace measure) const {
    return at_joint || (has_measure && measure == SpringSpace::joint);
  }
};
// CouplingFacts::make for a class with such a constructor.
template <class Law>
std::unique_ptr<Coupling> make_law(const CouplingSpec& spec, const Model<double>& model,
                                   TargetRobot& kvr) {
  return std::make_unique<Law>(spec, model, kvr);
}

const std::vector<CouplingFacts>& registered_couplings();  // in the order of file names
const std::vector<CouplingFacts>& couplings_in_order();
inline const std::vector<CouplingFacts>& all_couplings = couplings_in_order();
const CouplingFacts& facts_of(CouplingSpec::Type type, bool printed);
const CouplingFacts* find_coupling(const std::string& name);  // nullptr if unknown

inline std::unique_ptr<Coupling> make_coupling(const CouplingSpec& spec, const Model<double>& model,
                                               TargetRobot& kvr) {
  return facts_of(spec.type, spec.printed).make(spec, model, kvr);
}

// Springs of a god object: one without gains for each joint with degrees of freedom of a robot's
// bodies.
std::vector<Spring> god_object_joints(const Model<double>& model, int first_body, int last_body);

inline const char* name_of(Discretization discretization) {
  constexpr const char* kNames[] = {"explicit", "semi-implicit", "implicit"};
  return kNames[static_cast<std::size_t>(discretization)];
}

// Evaluation of a spring-damper in a step, and its added inertia m* (solver/forces/spring.h).
struct DiscretizationTerms {
  const TargetSample* spring_target;  // sample of the KVR for the spring
  const TargetSample* damper_target;  // sample of the KVR for the damper
  double position_lead;               // the spring uses the DVR's position x + position_lead v [s]
  double m_star(double k, double b) const { return h_b * b + h2_k * k; }
  double h_b, h2_k;                // [s], [s^2]
  bool is_relative_damper = true;  // false: absolute damper, on the link's own velocity
};

inline DiscretizationTerms discretization_terms(Discretization discretization, TargetRobot& kvr,
                                                double t, double h) {
  switch (discretization) {
    case Discretization::explicit_:
      return {&kvr.at(t), &kvr.at(t), 0, 0, 0};
    case Discretization::semi_implicit:
      return {&kvr.start(), &kvr.end(), 0, h, 0};
    case Discretization::implicit:
      break;
  }
  return {&kvr.end(), &kvr.end(), h, h, h * h};
}

}  // namespace twinarm
