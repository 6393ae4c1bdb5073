// Stability limits and tracking errors of parameters.
//
// A limit is bracketed from the present value by factors of four (outward if stable, inward if
// not), then bisected on a logarithmic scale to one percent.
#include <fmt/format.h>

#include "app/diagnose/coupled_step.h"
#include "app/lab/parameters/parameters.h"

namespace twinarm {
namespace {

using IsStable = std::function<bool(double)>;

constexpr double kStride = 4, kTolerance = 1.01, kMargin = 0.25;
constexpr double kBeyond = 1000;  // factor beyond the slider's range in which a limit is sought

// Boundary between stable `good` and unstable `bad`: its stable side.
double bisect(double good, double bad, const IsStable& is_stable) {
  while (std::max(good, bad) > kTolerance * std::min(good, bad)) {
    const double middle = std::sqrt(good * bad);
    (is_stable(middle) ? good : bad) = middle;
  }
  return good;
}

// Limit nearest to `good` on the way to `end`, in strides of `factor`; NaN: all values are stable.
double first_limit(double good, double factor, double end, const IsStable& is_stable) {
  const auto is_within = [&](double x) { return factor > 1 ? x < end : x > end; };
  double last = good;
  for (double x = good * factor; is_within(x); last = x, x *= factor)
    if (!is_stable(x)) return bisect(last, x, is_stable);
  return is_stable(end) ? std::numeric_limits<double>::quiet_NaN() : bisect(last, end, is_stable);
}

struct Limit {
  std::optional<double> value;
  bool stable_now = false;
  bool is_lower = false;  // stable above
};

// `upward`: instability is expected at larger values.
Limit find_limit(double now, double low, double high, bool upward, bool stable_now,
                 const IsStable& is_stable) {
  Limit limit{std::nullopt, stable_now, !upward};
  const double bad_end = upward ? std::max(high, now) : std::min(low, now);
  const double good_end = upward ? std::min(low, now) : std::max(high, now);
  if (stable_now) {
    const double found = first_limit(now, upward ? kStride : 1 / kStride, bad_end, is_stable);
    if (!std::isnan(found)) limit.value = found;
    return limit;
  }
  double bad = now;
  const double factor = upward ? 1 / kStride : kStride;
  for (double x = now * factor; upward ? x > good_end : x < good_end; bad = x, x *= factor)
    if (is_stable(x)) {
      limit.value = bisect(x, bad, is_stable);
      return limit;
    }
  if (is_stable(good_end)) limit.value = bisect(good_end, bad, is_stable);
  return limit;
}

std::string_view state_of(const Limit& limit, double now) {
  if (!limit.stable_now) return "beyond";
  if (!limit.value) return "ok";
  const double used = limit.is_lower ? *limit.value / now : now / *limit.value;
  return used > 1 - kMargin ? "near" : "ok";
}

ParameterLimit described(const Limit& limit, double now, const std::string& unit, const char* at) {
  ParameterLimit result{limit.value, "", state_of(limit, now)};
  if (limit.value)
    result.words = fmt::format(
        "{} {} {:.3g}{}{}{}", limit.stable_now ? "stable" : "would be stable",
        limit.is_lower ? "from" : "up to", *limit.value, unit.empty() ? "" : " ", unit, at);
  else if (limit.stable_now)
    result.words = fmt::format("any value is stable{}", at);
  return result;
}

struct GainKey {
  const char* key;
  CoupledStep::Gain gain;
  bool upward;  // unstable at large values
};
constexpr GainKey kGains[] = {
    {"stiffness", CoupledStep::Gain::stiffness, true},
    {"damping", CoupledStep::Gain::damping, true},
    {"rotational_stiffness", CoupledStep::Gain::rotational_stiffness, true},
    {"rotational_damping", CoupledStep::Gain::rotational_damping, true},
    {"time_constant", CoupledStep::Gain::time_constant, false}};

struct Limits {
  const SimulatePlan& plan;
  std::vector<LabParameter>& parameters;
  const SceneDescription& scene = plan.input.scene->description;
  CoupledStep step{plan};
  bool stable_now = step.is_stable();

  void add() {
    if (step.is_empty()) return;
    for (LabParameter& parameter : parameters) {
      if (parameter.path == "step") add_step(parameter);
      if (!parameter.coupling) continue;
      // Soft limits are not in the prediction: inactive in the nominal pose.
      const auto coupling = static_cast<std::size_t>(*parameter.coupling);
      if (*parameter.coupling >= 0 && scene.couplings[coupling].soft_limits) continue;
      if (parameter.key == "rate") add_rate(parameter, *parameter.coupling);
      for (const GainKey& gain : kGains)
        if (parameter.key == gain.key) add_gain(parameter, *parameter.coupling, gain);
    }
    if (!stable_now) keep_stabilising();
  }

  // Unstable step: only parameters that stabilise it alone show a limit; if none does, the
  // parameter `step` says so.
  void keep_stabilising() {
    const bool has_any = std::ranges::any_of(
        parameters, [](const LabParameter& p) { return p.limit && p.limit->value; });
    for (LabParameter& parameter : parameters) {
      if (!parameter.limit || parameter.limit->value) continue;
      if (parameter.path == "step" && !has_any)
        parameter.limit->words = "no single parameter stabilises this";
      else
        parameter.limit.reset();
    }
  }

  void add_step(LabParameter& parameter) {
    const double now = step.step();
    const Limit limit = find_limit(now, 1e-7, 0.1, true, stable_now,
                                   [&](double h) { return step.is_stable_at_step(h); });
    parameter.limit = described(limit, now, "s", " with these gains");
  }

  void add_gain(LabParameter& parameter, int coupling, const GainKey& key) {
    const double value = parameter.number.value_or(0);
    const bool is_positive = value > 0;
    const double now = is_positive ? value : parameter.low;
    const IsStable is_stable = [&](double x) {
      return step.is_stable_with_gain(coupling, key.gain, x);
    };
    const Limit limit =
        find_limit(now, parameter.low / kBeyond, parameter.high * kBeyond, key.upward,
                   is_positive ? stable_now : is_stable(now), is_stable);
    parameter.limit = described(limit, is_positive ? value : 0, parameter.unit, " at this step");
    if (!stable_now) parameter.limit->state = "beyond";
  }

  // A held force is unstable at low rates: limit of the number of steps between two evaluations.
  void add_rate(LabParameter& parameter, int coupling) {
    constexpr int kMaxSteps = 1000;
    const double rate = parse_number(parameter.text).value_or(1 / step.step());
    const int now = std::max(1, static_cast<int>(std::lround(1 / (rate * step.step()))));
    const auto is_stable = [&](int steps) { return step.is_stable_with_hold(coupling, steps); };
    int good = is_stable(now) ? now : 0, bad = good ? 0 : now;
    for (int n = now; good && !bad && n < kMaxSteps;) {
      n *= 2;
      is_stable(n) ? good = n : bad = n;
    }
    for (int n = now; !good && n > 1;) {
      n /= 2;
      is_stable(n) ? good = n : bad = n;
    }
    while (good && bad && bad - good > 1) {
      const int middle = (good + bad) / 2;
      (is_stable(middle) ? good : bad) = middle;
    }
    Limit limit{std::nullopt, stable_now, true};
    if (good && bad) limit.value = 1 / (good * step.step());
    parameter.limit = described(limit, rate, "Hz", " with these gains");
  }
};

// Tracking error of each coupling's link, all target joints at 1 rad/s or 0.1 m/s.
class TrackingErrors {
 public:
  explicit TrackingErrors(const SimulatePlan& plan) : input_(plan.input), step_(plan) {
    Eigen::VectorXd v = Eigen::VectorXd::Ones(step_.rows());
    for (const NamedJoint& joint : input_.robot.coordinates.all())
      if (is_translational(joint.type)) v[static_cast<Eigen::Index>(joint.row)] = 0.1;
    error_ = step_.tracking_errors(v);
  }
  // Empty where no coupling acts on the joint, or it does not have one degree of freedom.
  std::string of(int coupling) const {
    const auto& description = input_.scene->description.couplings;
    for (const SceneCoupling& component : input_.scene->couplings) {
      if (error_.start.size() == 0 || component.soft_limits) continue;
      if (coupling >= 0 &&
          component.coupling != description[static_cast<std::size_t>(coupling)].name)
        continue;
      for (const NamedJoint& joint : input_.robot.coordinates.all())
        if (joint.body == static_cast<std::size_t>(component.spring.body) && joint.nv == 1)
          return described(joint);
    }
    return "";
  }

 private:
  std::string described(const NamedJoint& joint) const {
    const auto row = static_cast<Eigen::Index>(joint.row);
    const double peak = std::abs(error_.start[row]), steady = std::abs(error_.later[row]);
    if (!std::isfinite(peak)) return "";
    const bool slides = is_translational(joint.type);
    const double scale = slides ? 1000 : 180 / std::numbers::pi;
    const char *unit = slides ? " mm" : "°", *speed = slides ? "0.1 m/s" : "1 rad/s";
    std::string text =
        fmt::format("peak {:.2g}{} after a velocity step of {}", scale * peak, unit, speed);
    if (std::isfinite(steady) && scale * steady > 1e-3)
      text += fmt::format(", {:.2g}{} in steady motion", scale * steady, unit);
    return text;
  }

  const SimulateInput& input_;
  CoupledStep step_;
  CoupledStep::Errors error_;
};

}  // namespace

void predict_limits(SimulatePlan& plan, const State<double>& now,
                    std::vector<LabParameter>& parameters, const char* pose) {
  if (!plan.input.scene || !plan.input.couplings || plan.input.couplings->size() == 0) return;
  plan.input.robot.state.x = now;
  Limits{plan, parameters}.add();
  const TrackingErrors errors(plan);
  for (LabParameter& parameter : parameters) {
    if (parameter.limit && !parameter.limit->words.empty()) parameter.limit->words += pose;
    if (parameter.coupling && parameter.key == "stiffness")
      parameter.tracking_error = errors.of(*parameter.coupling);
  }
}

}  // namespace twinarm
