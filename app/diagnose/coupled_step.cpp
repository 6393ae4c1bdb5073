#include "app/diagnose/coupled_step.h"

#include <algorithm>
#include <cmath>

#include "app/coupling/posed_couplings.h"
#include "coupling/analysis/multi_joint_tracking.h"

namespace twinarm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-9;

// Its number in the scene's list: pulls know the name of their coupling.
int number_of(const SceneDescription& scene, const std::string& name) {
  const auto found = std::ranges::find_if(
      scene.couplings, [&](const CouplingDescription& c) { return c.name == name; });
  return static_cast<int>(found - scene.couplings.begin());
}

bool is_one_of(const std::vector<int>& which, int coupling) {
  return std::ranges::find(which, coupling) != which.end();
}

}  // namespace

CoupledStep::CoupledStep(const SimulatePlan& plan)
    : integrator_(plan.run.integrator), step_(plan.run.step) {
  if (!plan.input.scene || !plan.input.couplings || plan.input.couplings->size() == 0) return;
  PosedCouplings posed(plan.input);
  M_ = posed.M();
  joint_damping_ = posed.joint_damping();
  SceneCouplings& couplings = *plan.input.couplings;
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    const SceneCoupling& spec = couplings.spec(c);
    if (spec.outside) continue;  // a stop mostly does not act
    const PredictedCoupling found = posed.about_zero(c);
    Pull pull;
    pull.coupling = number_of(plan.input.scene->description, spec.coupling);
    pull.turns_bushing = spec.law == CouplingSpec::Type::bushing &&
                         spec.type == CouplingDescription::Type::torsional;
    pull.is_weld = spec.law == CouplingSpec::Type::weld_like;
    pull.absolute_damper = spec.absolute_damper;
    pull.k = spec.spring.k;
    pull.b = spec.spring.b;
    pull.time_constant = spec.reference.time_constant;
    pull.delay = spec.delay;
    if (pull.k > 0)
      pull.square = found.K_zero / pull.k;
    else if (pull.b > 0)
      pull.square = found.B / pull.b;
    pull.part = step_part(found, step_);
    M_ += found.felt;
    pulls_.push_back(std::move(pull));
  }
}

// Forces of the same steps add up to one.
std::vector<CoupledTerm> CoupledStep::merged(const Pulls& pulls, double step) const {
  std::vector<CoupledTerm> parts;
  for (const Pull& pull : pulls) {
    CoupledTerm part = pull.part;
    if (part.hold_steps > 0 && step != step_)
      part.hold_steps = std::max(1, static_cast<int>(std::lround(part.hold_steps * step_ / step)));
    const auto same = std::ranges::find_if(parts, [&](const CoupledTerm& other) {
      return other.law == part.law && other.treatment == part.treatment &&
             other.hold_steps == part.hold_steps && part.law != StepLaw::god_object;
    });
    if (same == parts.end()) {
      parts.push_back(std::move(part));
      continue;
    }
    same->K += part.K;
    same->K_zero += part.K_zero;
    same->B += part.B;
  }
  return parts;
}

double CoupledStep::growth_of(const Pulls& pulls, Integrator integrator, double step) const {
  std::vector<CoupledTerm> parts = merged(pulls, step);
  if (!joint_damping_.isZero(0)) {
    // Dampers of joints are implicit in the step of the semi-implicit integrators.
    const MatrixXd none = MatrixXd::Zero(M_.rows(), M_.cols());
    const bool implicit = facts_of(integrator).implicit_force;
    parts.push_back({none, none, joint_damping_,
                     implicit ? Discretization::semi_implicit : Discretization::explicit_, 0});
  }
  return spectral_radius(M_, parts, integrator, step);
}

bool CoupledStep::holds_with(const Pulls& pulls, double step) const {
  if (pulls.empty() || integrator_ == Integrator::dopri5) return true;
  return growth_of(pulls, integrator_, step) <= 1 + kRounding;
}

CoupledStep::Pull CoupledStep::with_gain(const Pull& pull, Gain gain, double value) {
  Pull other = pull;
  if (gain == Gain::time_constant) {
    const double faster = pull.time_constant / value;
    other.part.K *= faster * faster;
    other.part.K_zero *= faster * faster;
    other.part.B *= faster;
    return other;
  }
  const bool is_turn = gain == Gain::turn_stiffness || gain == Gain::turn_damping;
  if (is_turn != pull.turns_bushing || pull.square.size() == 0) return other;
  if (gain == Gain::stiffness || gain == Gain::turn_stiffness)
    other.part.K = other.part.K_zero = value * pull.square;
  else if (pull.b == 0 ||
           !pull.part.B.isZero(0))  // as printed, a torsional damper has no such part
    other.part.B = value * pull.square;
  return other;
}

bool CoupledStep::holds_with_gain(int coupling, Gain gain, double value) const {
  Pulls others = pulls_;
  for (Pull& pull : others)
    if (coupling < 0 || pull.coupling == coupling) pull = with_gain(pull, gain, value);
  return holds_with(others, step_);
}

bool CoupledStep::holds_with_hold(int coupling, int steps) const {
  Pulls others = pulls_;
  for (Pull& pull : others)
    if (pull.coupling == coupling) pull.part.hold_steps = steps;
  return holds_with(others, step_);
}

bool CoupledStep::holds_with_softer(const std::vector<int>& which, double factor) const {
  Pulls others = pulls_;
  for (Pull& pull : others) {
    if (!is_one_of(which, pull.coupling)) continue;
    pull.part.K *= factor;
    pull.part.K_zero *= factor;
    pull.part.B *= std::sqrt(factor);
  }
  return holds_with(others, step_);
}

bool CoupledStep::holds_implicitly(const std::vector<int>& which) const {
  Pulls others = pulls_;
  for (Pull& pull : others) {
    if (!is_one_of(which, pull.coupling)) continue;
    pull.part.treatment = Discretization::implicit;
    pull.part.law = StepLaw::spring_damper;
    pull.part.hold_steps = 0;
  }
  return growth_of(others, Integrator::semi_implicit, step_) <= 1 + kRounding;
}

CoupledStep::Lag CoupledStep::lag(const VectorXd& v) const {
  const MatrixXd none = MatrixXd::Zero(M_.rows(), M_.cols());
  MatrixXd K = none, B = joint_damping_, absolute = joint_damping_, late = joint_damping_;
  for (const Pull& pull : pulls_) {
    if (pull.part.law == StepLaw::god_object) return {};
    K += pull.part.K;
    B += pull.part.B;
    if (pull.absolute_damper) absolute += pull.part.B, late += pull.part.B;
    late += pull.delay * pull.part.K;
  }
  return {MultiJointTrackingError({M_, K, B, absolute}).after_start(v, 1),
          MultiJointTrackingError({M_, K, B, late}).lag(v)};
}

}  // namespace twinarm
