// Limits and lags beside the knobs.
//
// A limit is sought from the knob's value: outward in steps of four while it holds, inward while it
// does not, then by halving on a logarithmic scale to one percent.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "app/diagnose/coupled_step.h"
#include "app/lab/parameters/parameters.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

using LimitState = ParameterLimit::State;
using Holds = std::function<bool(double)>;

constexpr double kStride = 4, kFine = 1.01, kRoomLeft = 0.25;
constexpr double kBeyond = 1000;  // of a slider's range: how far a limit is sought

// Where `holds` changes between `good` and `bad`: the side that holds.
double edge_between(double good, double bad, const Holds& holds) {
  while (std::max(good, bad) > kFine * std::min(good, bad)) {
    const double middle = std::sqrt(good * bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

// The nearest value on the way from `good`, by strides of `factor`, up to `end`, that does not
// hold; NaN: all hold.
double first_bad(double good, double factor, double end, const Holds& holds) {
  const auto is_within = [&](double x) { return factor > 1 ? x < end : x > end; };
  double last = good;
  for (double x = good * factor; is_within(x); last = x, x *= factor)
    if (!holds(x)) return edge_between(last, x, holds);
  return holds(end) ? std::numeric_limits<double>::quiet_NaN() : edge_between(last, end, holds);
}

struct Edge {
  std::optional<double> value;
  bool holds_now = false;
  bool is_lower = false;  // it holds from there on, and not below
};

// `upward`: towards where it is expected not to hold.
Edge find_edge(double now, double low, double high, bool upward, bool holds_now,
               const Holds& holds) {
  Edge edge{std::nullopt, holds_now, !upward};
  const double bad_end = upward ? std::max(high, now) : std::min(low, now);
  const double good_end = upward ? std::min(low, now) : std::max(high, now);
  if (holds_now) {
    const double found = first_bad(now, upward ? kStride : 1 / kStride, bad_end, holds);
    if (!std::isnan(found)) edge.value = found;
    return edge;
  }
  double bad = now;
  const double factor = upward ? 1 / kStride : kStride;
  for (double x = now * factor; upward ? x > good_end : x < good_end; bad = x, x *= factor)
    if (holds(x)) {
      edge.value = edge_between(x, bad, holds);
      return edge;
    }
  if (holds(good_end)) edge.value = edge_between(good_end, bad, holds);
  return edge;
}

LimitState state_of(const Edge& edge, double now) {
  if (!edge.holds_now) return LimitState::beyond;
  if (!edge.value) return LimitState::ok;
  const double used = edge.is_lower ? *edge.value / now : now / *edge.value;
  return used > 1 - kRoomLeft ? LimitState::near : LimitState::ok;
}

std::string short_value(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

ParameterLimit limit_of(const Edge& edge, double now, const std::string& unit, const char* at) {
  ParameterLimit limit{edge.value, "", state_of(edge, now)};
  if (edge.value)
    limit.words = fmt::format("{} {} {}{}", edge.holds_now ? "stable" : "would be stable",
                              edge.is_lower ? "from" : "up to", short_value(*edge.value, unit), at);
  else
    limit.words = edge.holds_now ? fmt::format("any value is stable{}", at) : "";
  return limit;
}

struct GainKey {
  const char* key;
  CoupledStep::Gain gain;
  bool upward;  // the more, the nearer to the limit
};
constexpr GainKey kGains[] = {{"stiffness", CoupledStep::Gain::stiffness, true},
                              {"damping", CoupledStep::Gain::damping, true},
                              {"turn_stiffness", CoupledStep::Gain::turn_stiffness, true},
                              {"turn_damping", CoupledStep::Gain::turn_damping, true},
                              {"time_constant", CoupledStep::Gain::time_constant, false}};

class Limits {
 public:
  Limits(const SimulatePlan& plan, std::vector<LabParameter>& knobs)
      : scene_(plan.input.scene->description), step_(plan), knobs_(knobs), holds_(step_.holds()) {}

  void add() {
    if (step_.is_empty()) return;
    for (LabParameter& knob : knobs_) {
      if (knob.path == "step") add_step(knob);
      if (!knob.coupling || is_stop(*knob.coupling)) continue;
      if (knob.key == "rate") add_rate(knob, *knob.coupling);
      for (const GainKey& gain : kGains)
        if (knob.key == gain.key) add_gain(knob, *knob.coupling, gain);
    }
    if (!holds_) tell_once();
  }

 private:
  // Of a step that does not hold: knobs that would mend it alone say so, the others nothing; where
  // none would, the step says it for all.
  void tell_once() {
    const bool is_mended = std::any_of(knobs_.begin(), knobs_.end(), [](const LabParameter& knob) {
      return knob.limit && knob.limit->value;
    });
    for (LabParameter& knob : knobs_) {
      if (!knob.limit || knob.limit->value) continue;
      if (knob.path == "step" && !is_mended)
        knob.limit->words = "no knob alone makes it stable";
      else
        knob.limit.reset();
    }
  }

  void add_step(LabParameter& knob) {
    const double now = step_.step();
    const Edge edge =
        find_edge(now, 1e-7, 0.1, true, holds_, [&](double h) { return step_.holds_at_step(h); });
    knob.limit = limit_of(edge, now, "s", " with these gains");
  }

  void add_gain(LabParameter& knob, int coupling, const GainKey& key) {
    const double value = knob.number.value_or(0);
    const bool starts = value > 0;
    const double now = starts ? value : knob.low;
    const Holds holds = [&](double x) { return step_.holds_with_gain(coupling, key.gain, x); };
    const Edge edge = find_edge(now, knob.low / kBeyond, knob.high * kBeyond, key.upward,
                                starts ? holds_ : holds(now), holds);
    knob.limit = limit_of(edge, starts ? value : 0, knob.unit, " at this step");
    if (!holds_) knob.limit->state = LimitState::beyond;
  }

  // Fewer evaluations are what a held force cannot bear.
  void add_rate(LabParameter& knob, int coupling) {
    constexpr int kMaxSteps = 1000;
    const double rate = parse_number(knob.text).value_or(1 / step_.step());
    const int now = std::max(1, static_cast<int>(std::lround(1 / (rate * step_.step()))));
    const auto holds = [&](int steps) { return step_.holds_with_hold(coupling, steps); };
    int good = holds(now) ? now : 0, bad = good ? 0 : now;
    for (int n = now; good && !bad && n < kMaxSteps;) {
      n *= 2;
      holds(n) ? good = n : bad = n;
    }
    for (int n = now; !good && n > 1;) {
      n /= 2;
      holds(n) ? good = n : bad = n;
    }
    while (good && bad && bad - good > 1) {
      const int middle = (good + bad) / 2;
      (holds(middle) ? good : bad) = middle;
    }
    Edge edge{std::nullopt, holds_, true};
    if (good && bad) edge.value = 1 / (good * step_.step());
    knob.limit = limit_of(edge, rate, "Hz", " with these gains");
  }

  // A soft stop mostly does not act, and is left out of the prediction.
  bool is_stop(int coupling) const {
    return coupling >= 0 && scene_.couplings[static_cast<std::size_t>(coupling)].outside;
  }

  const SceneDescription& scene_;
  CoupledStep step_;
  std::vector<LabParameter>& knobs_;
  bool holds_;
};

// What each coupling's link lags at 1 rad/s, of a slide at 0.1 m/s, all joints at once.
class Lags {
 public:
  explicit Lags(const SimulatePlan& plan) : input_(plan.input), step_(plan) {
    const auto& coordinates = input_.robot.coordinates;
    Eigen::VectorXd v = Eigen::VectorXd::Ones(step_.rows());
    for (const NamedJoint& joint : coordinates.all())
      if (is_slide(joint)) v[static_cast<Eigen::Index>(joint.row)] = 0.1;
    lag_ = step_.lag(v);
  }
  // Empty where the joint is not held, or is none of one degree of freedom.
  std::string of(int coupling) const {
    const auto& description = input_.scene->description.couplings;
    for (const SceneCoupling& pull : input_.scene->couplings) {
      if (lag_.start.size() == 0 || pull.outside) continue;
      if (coupling >= 0 && pull.coupling != description[static_cast<std::size_t>(coupling)].name)
        continue;
      for (const NamedJoint& joint : input_.robot.coordinates.all())
        if (joint.body == static_cast<std::size_t>(pull.spring.body) && joint.nv == 1)
          return words(joint);
    }
    return "";
  }

 private:
  bool is_slide(const NamedJoint& joint) const { return is_translational(joint.type); }
  std::string words(const NamedJoint& joint) const {
    const auto row = static_cast<Eigen::Index>(joint.row);
    const double start = std::abs(lag_.start[row]), later = std::abs(lag_.later[row]);
    if (!std::isfinite(start)) return "";
    const bool slides = is_slide(joint);
    const double scale = slides ? 1000 : 180 / std::numbers::pi;
    const char *unit = slides ? " mm" : "°", *speed = slides ? "0.1 m/s" : "1 rad/s";
    std::string text = fmt::format("up to {:.2g}{} at a start to {}", scale * start, unit, speed);
    if (std::isfinite(later) && scale * later > 1e-3)
      text += fmt::format(", {:.2g}{} after it", scale * later, unit);
    return text;
  }

  const SimulateInput& input_;
  CoupledStep step_;
  CoupledStep::Lag lag_;
};

}  // namespace

void predict_knobs(SimulatePlan& plan, const State<double>& now, std::vector<LabParameter>& knobs) {
  if (!plan.input.scene || !plan.input.couplings || plan.input.couplings->size() == 0) return;
  plan.input.robot.state.x = now;
  Limits(plan, knobs).add();
  const Lags lags(plan);
  for (LabParameter& knob : knobs) {
    if (knob.coupling && knob.key == "stiffness") knob.lag = lags.of(*knob.coupling);
  }
}

}  // namespace twinarm
