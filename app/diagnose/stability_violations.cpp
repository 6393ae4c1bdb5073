// Stability limits of each coupling alone and of each joint damper, as the scene's integrator steps
// them (coupling/analysis/step_matrix.h), about the initial state.
#include <fmt/format.h>

#include "app/coupling/posed_couplings.h"
#include "app/diagnose/post_mortem.h"
#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// Suggested omega h over its limit: near the limit an undamped spring still oscillates with several
// times its energy (semi-implicit: 1 / (1 - (w h / 2)^2)), and the limit varies with the pose.
constexpr double kMargin = 0.5;

// The largest stable x in (0, 1], for stability that ends at one value; 0: none above 1e-12.
template <class IsStable>
double max_stable_factor(IsStable is_stable) {
  if (is_stable(1.0)) return 1;
  double low = -12, high = 0;  // powers of ten
  if (!is_stable(1e-12)) return 0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (is_stable(std::pow(10, middle)) ? low : high) = middle;
  }
  return std::pow(10, low);
}

// A coupling with all its components, in the step of the run.
struct SteppedCoupling {
  const SceneCoupling* spec = nullptr;
  CoupledTerm part;
  std::vector<CoupledTerm> beside;  // god objects on the same robot
  std::string beside_names;
  Eigen::MatrixXd M;  // with the inertia that the law adds
  Integrator integrator = Integrator::semi_implicit;
  double h = 0, fastest = 0;  // step [s]; of its modes [rad/s], of a damper alone [1/s]

  std::vector<CoupledTerm> parts(const CoupledTerm& its) const {
    std::vector<CoupledTerm> all = beside;
    all.push_back(its);
    return all;
  }
  bool is_stable(const CoupledTerm& its) const {
    constexpr double kGrowthRounding = 1e-9;
    return spectral_radius(M, parts(its), integrator, h) <= 1 + kGrowthRounding;
  }
  bool is_spring() const { return !part.K.isZero(0); }
  bool is_weld() const { return spec->law == CouplingSpec::Type::weld; }
  // With the stiffness, or where there is none the damping, times `factor`; a weld's time constant
  // divided by it.
  CoupledTerm scaled(double factor) const {
    CoupledTerm its = part;
    const double by = is_weld() ? factor * factor : factor;
    its.K *= by;
    its.K_zero *= by;
    if (is_weld() || !is_spring()) its.B *= factor;
    return its;
  }
};

std::string method_of(const SteppedCoupling& c) {
  const SceneCoupling& spec = *c.spec;
  std::string name;
  if (spec.law == CouplingSpec::Type::stable_pd)
    name = "stable PD";
  else if (spec.printed)
    name = std::string("as printed, ") + integrator_name(c.integrator);
  else if (spec.discretization == Discretization::semi_implicit)
    name = name_of(SteppingScheme::implicit_damper);
  else if (spec.discretization == Discretization::implicit)
    name = name_of(SteppingScheme::implicit);
  else if (spec.rate == 0)
    name = std::string("explicit, ") + integrator_name(c.integrator);
  if (spec.rate > 0) name += name.empty() ? "held force" : ", held force";
  return name + c.beside_names;
}

// "step <= 0.316 ms".
std::string step_fix(double max_step) {
  return fmt::format("step <= {:.3g} ms", 1e3 * kMargin * max_step);
}

// A rate with a whole number of steps per force; empty: none is stable.
std::string rate_fix(const SteppedCoupling& c, double max_step) {
  CoupledTerm its = c.part;
  for (its.hold_steps = static_cast<int>(kMargin * max_step / c.h); its.hold_steps > 0;
       --its.hold_steps)
    if (c.is_stable(its))
      return fmt::format("rate >= {} Hz", short_number_text(1 / (its.hold_steps * c.h)));
  return c.is_stable(its) ? "no rate (a force at each step)" : "";
}

const char* gain_unit(const SteppedCoupling& c) {
  if (c.is_weld()) return "s";
  if (c.is_spring()) return c.spec->is_linear() ? "N/m" : "N m/rad";
  return c.spec->is_linear() ? "N s/m" : "N m s/rad";
}

std::string gain_fix(const SteppedCoupling& c, const StabilityViolation& s) {
  if (!(s.max_gain > 0)) return "";
  if (c.is_weld())
    return fmt::format("time_constant >= {} s", short_number_text(s.max_gain / kMargin));
  if (!c.is_spring())
    return fmt::format("damping <= {} {}", short_number_text(kMargin * s.max_gain), gain_unit(c));
  const double k = kMargin * kMargin * s.max_gain;
  std::string torsional;
  if (c.spec->law == CouplingSpec::Type::bushing)
    torsional = fmt::format(" and rotational_stiffness <= {} N m/rad",
                            short_number_text(k / c.spec->spring.k * c.spec->spring.k_rotational));
  return fmt::format("stiffness <= {} {}{}", short_number_text(k), gain_unit(c), torsional);
}

std::string law_fix(const SceneCoupling& spec) {
  using Type = CouplingSpec::Type;
  std::string type;
  if (spec.law == Type::stable_pd)
    type = "type = \"torsional\", measure = \"joint\", ";
  else if (spec.printed || spec.law == Type::equivalent_torsional)
    type = fmt::format("type = \"{}\", ", spec.law == Type::torsional ? "torsional" : "linear");
  else if (spec.rate > 0)
    type = "no rate, ";
  return type + "discretization = \"implicit\", integrator semi-implicit";
}

// "Limits: step 0.632 ms, stiffness 1000 N/m; stable with a margin: A, or B".
// `interval`: what max_step is the largest value of.
std::string fix_text(const StabilityViolation& s, const char* interval, const char* unit,
                     const std::vector<std::string>& fixes) {
  std::string limits, text;
  if (s.max_step > 0) limits = fmt::format("{} {:.3g} ms", interval, 1e3 * s.max_step);
  if (s.max_gain > 0)
    limits += fmt::format("{}{} {:.3g} {}", limits.empty() ? "" : ", ", s.gain, s.max_gain, unit);
  for (const std::string& fix : fixes)
    if (!fix.empty()) text += (text.empty() ? "" : ", or ") + fix;
  return limits.empty() ? "Stable with " + text
                        : fmt::format("Limits: {}; stable with a margin: {}", limits, text);
}

StabilityViolation violation_of(const SteppedCoupling& c) {
  const SceneCoupling& spec = *c.spec;
  const double steps = std::max(1, c.part.hold_steps);
  StabilityViolation s;
  s.index = spec.description;
  s.name = "coupling '" + spec.coupling + "'";
  s.scheme = method_of(c);
  s.step = steps * c.h;
  s.max_step = steps * max_stable_step(c.M, c.parts(c.part), c.integrator);
  s.product = c.fastest * s.step;
  s.limit = c.fastest * s.max_step;
  s.gain = c.is_weld() ? "time constant" : c.is_spring() ? "stiffness" : "damping";
  if (s.step <= s.max_step) return s;
  const double part = max_stable_factor([&](double f) { return c.is_stable(c.scaled(f)); });
  if (part > 0)
    s.max_gain = c.is_weld()     ? spec.reference.time_constant / part
                 : c.is_spring() ? part * spec.spring.k
                                 : part * spec.spring.b;
  std::string step_or_rate;
  if (s.max_step > 0) step_or_rate = spec.rate > 0 ? rate_fix(c, s.max_step) : step_fix(s.max_step);
  s.fix = fix_text(s, spec.rate > 0 ? "time between forces" : "step", gain_unit(c),
                   {step_or_rate, gain_fix(c, s), law_fix(spec)});
  return s;
}

// God objects alone are stable at any step; they lower the limits of other couplings.
void add_couplings(const SimulatePlan& prepared, std::vector<StabilityViolation>& violations) {
  SceneCouplings& couplings = *prepared.input.couplings;
  PosedCouplings posed(prepared.input);
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    const SceneCoupling& spec = couplings.spec(c);
    const bool is_god = spec.law == CouplingSpec::Type::god_object;
    if (spec.first_component != c || spec.soft_limits || is_god)
      continue;  // soft limits are inactive there
    PredictedCoupling all = posed.about_zero(c);
    SteppedCoupling stepped;
    for (std::size_t other = 0; other < couplings.size(); ++other) {
      const SceneCoupling& its = couplings.spec(other);
      if (other != c && its.first_component == c) {
        const PredictedCoupling more = posed.about_zero(other);
        all.K += more.K, all.K_zero += more.K_zero, all.B += more.B, all.M_added += more.M_added;
      }
      if (its.law != CouplingSpec::Type::god_object || its.first_component != other ||
          its.robot != spec.robot)
        continue;
      stepped.beside.push_back(step_part(posed.about_zero(other), prepared.run.step));
      stepped.beside_names += ", beside the god object '" + its.coupling + "'";
    }
    stepped.spec = &spec;
    stepped.part = step_part(all, prepared.run.step);
    stepped.M = posed.M() + all.M_added;
    stepped.integrator = prepared.run.integrator;
    stepped.h = prepared.run.step;
    const SpringModes modes = spring_modes(stepped.M, all.K, all.B);
    for (Eigen::Index i = 0; i < modes.size(); ++i)
      stepped.fastest =
          std::max(stepped.fastest, modes.omega(i) > 0 ? modes.omega(i) : modes.damping(i, i));
    if (stepped.fastest > 0) violations.push_back(violation_of(stepped));
  }
}

// Limit of b h / I of joint dampers that the integrator takes explicitly.
double damping_limit(Integrator integrator) {
  switch (integrator) {
    case Integrator::euler:
    case Integrator::midpoint:
    case Integrator::heun:
      return 2;
    case Integrator::rk4:
      return 2.785293563405282;
    default:
      return kNever;
  }
}

void add_dampers(const SimulatePlan& prepared, const Eigen::MatrixXd& M,
                 std::vector<StabilityViolation>& violations) {
  const Model<double>& model = prepared.input.robot.model;
  const double limit = damping_limit(prepared.run.integrator), h = prepared.run.step;
  if (limit == kNever) return;
  const Eigen::MatrixXd inverse = inverse_of(M);
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.dofs(i) == 0) continue;
    const std::size_t iv = model.iv[i];
    const double rate =
        model.damping[iv] * inverse(static_cast<Eigen::Index>(iv), static_cast<Eigen::Index>(iv));
    if (!(rate > 0)) continue;
    StabilityViolation s;
    s.kind = StabilityViolation::Kind::joint_damper;
    s.index = i;
    s.name = "damper of joint '" + model.joint_name[i] + "'";
    s.scheme = std::string("omega = b/I; ") + integrator_name(prepared.run.integrator);
    s.step = h;
    s.max_step = limit / rate;
    s.product = rate * h;
    s.limit = limit;
    s.gain = "damping";
    if (h > s.max_step) {
      s.max_gain = model.damping[iv] * s.max_step / h;
      const char* unit = is_translational(model.joint[i]) ? "N s/m" : "N m s/rad";
      s.fix =
          fix_text(s, "step", unit,
                   {step_fix(s.max_step),
                    fmt::format("damping <= {} {}", short_number_text(kMargin * s.max_gain), unit),
                    "integrator semi-implicit (joint dampers are implicit)"});
    }
    violations.push_back(std::move(s));
  }
}

}  // namespace

std::vector<StabilityViolation> find_violations(const SimulatePlan& prepared) {
  std::vector<StabilityViolation> violations;
  const SimulateInput& input = prepared.input;
  const Model<double>& model = input.robot.model;
  if (prepared.run.is_adaptive() || model.nv == 0 || model.nv > kMaxDense) return violations;
  if (input.couplings) add_couplings(prepared, violations);
  add_dampers(prepared, mass_matrix(model, input.robot.state.x), violations);
  std::ranges::stable_sort(violations,
                           [](const StabilityViolation& a, const StabilityViolation& b) {
                             return a.step * b.max_step > b.step * a.max_step;
                           });
  return violations;
}

}  // namespace twinarm
