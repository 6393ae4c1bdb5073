#include "app/diagnose/coupled_step.h"

#include "app/coupling/posed_couplings.h"
#include "coupling/analysis/multi_joint_tracking.h"

namespace twinarm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-9;

bool contains(const std::vector<int>& couplings, int coupling) {
  return std::ranges::find(couplings, coupling) != couplings.end();
}

}  // namespace

CoupledStep::CoupledStep(const SimulatePlan& plan)
    : integrator_(plan.run.integrator), step_(plan.run.step) {
  if (!plan.input.scene || !plan.input.couplings || plan.input.couplings->size() == 0) return;
  if (plan.input.robot.model.nv > kMaxDense) return;
  PosedCouplings posed(plan.input);
  M_ = posed.M();
  joint_damping_ = posed.joint_damping();
  SceneCouplings& couplings = *plan.input.couplings;
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    const SceneCoupling& spec = couplings.spec(c);
    if (spec.soft_limits) continue;  // soft limits are inactive in the nominal pose
    const PredictedCoupling found = posed.about_zero(c);
    Component component;
    component.coupling = static_cast<int>(spec.description);
    component.is_bushing_torsional = spec.law == CouplingSpec::Type::bushing && !spec.is_linear();
    component.absolute_damper = spec.absolute_damper;
    component.k = spec.spring.k;
    component.b = spec.spring.b;
    component.time_constant = spec.reference.time_constant;
    component.delay = spec.delay;
    if (component.k > 0)
      component.square = found.K_zero / component.k;
    else if (component.b > 0)
      component.square = found.B / component.b;
    component.part = step_part(found, step_);
    M_ += found.M_added;
    components_.push_back(std::move(component));
  }
}

// Sums the terms that are evaluated at the same steps.
std::vector<CoupledTerm> CoupledStep::merged(const Components& components, double step) const {
  std::vector<CoupledTerm> parts;
  for (const Component& component : components) {
    CoupledTerm part = component.part;
    if (part.hold_steps > 0 && step != step_)
      part.hold_steps = std::max(1, static_cast<int>(std::lround(part.hold_steps * step_ / step)));
    const auto same = std::ranges::find_if(parts, [&](const CoupledTerm& other) {
      return other.law == part.law && other.discretization == part.discretization &&
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

double CoupledStep::growth_of(const Components& components, Integrator integrator,
                              double step) const {
  std::vector<CoupledTerm> parts = merged(components, step);
  if (!joint_damping_.isZero(0)) parts.push_back(joint_damper_term(joint_damping_, integrator));
  return spectral_radius(M_, parts, integrator, step);
}

bool CoupledStep::is_stable(const Components& components, double step) const {
  if (components.empty() || integrator_ == Integrator::dopri5) return true;
  return growth_of(components, integrator_, step) <= 1 + kRounding;
}

CoupledStep::Component CoupledStep::with_gain(const Component& component, Gain gain, double value) {
  Component other = component;
  if (gain == Gain::time_constant) {
    const double faster = component.time_constant / value;
    other.part.K *= faster * faster;
    other.part.K_zero *= faster * faster;
    other.part.B *= faster;
    return other;
  }
  const bool is_torsional = gain == Gain::rotational_stiffness || gain == Gain::rotational_damping;
  if (is_torsional != component.is_bushing_torsional || component.square.size() == 0) return other;
  if (gain == Gain::stiffness || gain == Gain::rotational_stiffness)
    other.part.K = other.part.K_zero = value * component.square;
  else if (component.b == 0 || !component.part.B.isZero(0))  // else as printed, without linear part
    other.part.B = value * component.square;
  return other;
}

bool CoupledStep::is_stable_with_gain(int coupling, Gain gain, double value) const {
  Components changed = components_;
  for (Component& c : changed)
    if (coupling < 0 || c.coupling == coupling) c = with_gain(c, gain, value);
  return is_stable(changed, step_);
}

bool CoupledStep::is_stable_with_hold(int coupling, int steps) const {
  Components changed = components_;
  for (Component& c : changed)
    if (c.coupling == coupling) c.part.hold_steps = steps;
  return is_stable(changed, step_);
}

bool CoupledStep::is_stable_with_softer(const std::vector<int>& couplings, double stiffness,
                                        double damping) const {
  Components changed = components_;
  for (Component& c : changed) {
    if (!contains(couplings, c.coupling)) continue;
    c.part.K *= stiffness;
    c.part.K_zero *= stiffness;
    c.part.B *= damping;
  }
  return is_stable(changed, step_);
}

bool CoupledStep::is_stable_with_implicit(const std::vector<int>& couplings) const {
  Components others = components_;
  for (Component& c : others) {
    if (!contains(couplings, c.coupling)) continue;
    c.part.discretization = Discretization::implicit;
    c.part.law = StepLaw::spring_damper;
    c.part.hold_steps = 0;
  }
  return growth_of(others, Integrator::semi_implicit, step_) <= 1 + kRounding;
}

CoupledStep::Errors CoupledStep::tracking_errors(const VectorXd& v) const {
  const MatrixXd none = MatrixXd::Zero(M_.rows(), M_.cols());
  MatrixXd K = none, B = joint_damping_, absolute = joint_damping_, late = joint_damping_;
  for (const Component& c : components_) {
    if (c.part.law == StepLaw::god_object) return {};
    K += c.part.K;
    B += c.part.B;
    if (c.absolute_damper) absolute += c.part.B, late += c.part.B;
    late += c.delay * c.part.K;
  }
  return {MultiJointTrackingError({M_, K, B, absolute}).after_start(v, 1),
          MultiJointTrackingError({M_, K, B, late}).steady_state(v)};
}

}  // namespace twinarm
