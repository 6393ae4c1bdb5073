// A coupling as plain data, and the list of all that there are.
//
// A coupling is one file NAME_coupling.cpp of this folder: its class, and `CouplingFacts
// NAME_coupling()`, which is registered by being there (coupling/laws/CMakeLists.txt). Scenes, the
// lab, maps, predictions and the tests of all couplings find it there.
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

// What a calibration file, a report and a scene can hold.
struct CouplingSpec {
  struct Type {  // its name; couplings that other code asks for have a constant
    std::string_view name;
    friend constexpr bool operator==(const Type&, const Type&) = default;
    static const Type torsional, linear, matched, bushing, weld_like, stable_pd, god_object;
  };
  std::string name;
  Type type = Type::torsional;
  bool printed = false;  // the paper's own equations (AsPublishedOptions), or the consistent form
  AsPublishedOptions options;
  SpringSpace measure = SpringSpace::world;  // consistent torsional
  Discretization treatment =
      Discretization::explicit_;  // consistent, where its facts say that it has any
  int hold_steps = 0;             // consistent linear, torsional, bushing; 0: every step and stage
  SolrefParameters reference;     // weld-like
  std::vector<Spring> springs;
};
inline constexpr CouplingSpec::Type CouplingSpec::Type::torsional{"torsional"},
    CouplingSpec::Type::linear{"linear"}, CouplingSpec::Type::matched{"matched"},
    CouplingSpec::Type::bushing{"bushing"}, CouplingSpec::Type::weld_like{"weld"},
    CouplingSpec::Type::stable_pd{"stable-pd"}, CouplingSpec::Type::god_object{"god-object"};

// How linear theory steps it (coupling/analysis/step_matrix.h).
enum class StepLaw { spring_damper, printed, stable_pd, god_object };

struct CouplingFacts {
  enum class Discretizations { all, explicit_only, own };
  // What a scene states of it: stiffness and damping; and those of a turn; a SolrefParameters;
  // nothing, for it drives all joints of a robot.
  enum class Gains { spring, two_springs, reference, none };
  const char* name;           // in scenes and tables
  CouplingSpec::Type type{};  // left out: as its name
  bool printed = false;
  int order = 100;  // among all, where they are listed
  Discretizations treatments =
      Discretizations::explicit_only;  // own: it is a treatment itself, and goes
                                       // with semi-implicit Euler only
  Gains gains = Gains::spring;
  // What it acts on: a point (Spring::p_L counts), a joint's coordinate, or what
  // CouplingSpec::measure says; none of these: the orientation of a link.
  bool at_point = false, at_joint = false, has_measure = false;
  bool can_hold = false;  // CouplingSpec::hold_steps, or AsPublishedOptions::hold_steps
  // Its force is k e + b e' of its springs, at some moments of the step. False: the ledger of a
  // scene books what it does besides as `drive`.
  bool is_spring_damper = true;
  StepLaw step_law = StepLaw::spring_damper;
  std::unique_ptr<Coupling> (*make)(const CouplingSpec& spec, const Model<double>& model,
                                    TargetRobot& kvr);

  bool acts_at_joint(SpringSpace measure) const {
    return at_joint || (has_measure && measure == SpringSpace::joint);
  }
};
// As CouplingFacts::make, of a class that is made of a CouplingSpec.
template <class Law>
std::unique_ptr<Coupling> make_law(const CouplingSpec& spec, const Model<double>& model,
                                   TargetRobot& kvr) {
  return std::make_unique<Law>(spec, model, kvr);
}

const std::vector<CouplingFacts>& registered_couplings();  // by the names of their files
const std::vector<CouplingFacts>& couplings_in_order();
inline const std::vector<CouplingFacts>& all_couplings = couplings_in_order();
const CouplingFacts& facts_of(CouplingSpec::Type type, bool printed);
const CouplingFacts* find_coupling(const std::string& name);  // nullptr where there is none

inline std::unique_ptr<Coupling> make_coupling(const CouplingSpec& spec, const Model<double>& model,
                                               TargetRobot& kvr) {
  return facts_of(spec.type, spec.printed).make(spec, model, kvr);
}

// What a god object drives: a spring without gains for each joint with degrees of freedom among the
// bodies, which are all of a robot.
std::vector<Spring> god_object_joints(const Model<double>& model, int first_body, int last_body);

// What a treatment is called, which target it looks at, and the m* that it adds
// (solver/forces/spring.h).
inline const char* name_of(Discretization treatment) {
  constexpr const char* kNames[] = {"explicit", "semi-implicit", "implicit"};
  return kNames[static_cast<std::size_t>(treatment)];
}

struct DiscretizationTerms {
  const TargetSample* spring_target;  // pose of the KVR that the spring pulls to
  const TargetSample* damper_target;  // velocity of the KVR that the damper pulls to
  double position_lead;               // [s]: the spring sees the DVR at x + position_lead v
  double m_star(double k, double b) const { return weight_b * b + weight_k * k; }
  double weight_b, weight_k;       // [s], [s^2]
  bool is_relative_damper = true;  // false: an absolute damper, against the link's own velocity
};

inline DiscretizationTerms discretization_terms(Discretization treatment, TargetRobot& kvr,
                                                double t, double h) {
  switch (treatment) {
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
