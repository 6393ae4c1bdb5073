// What is beyond its limit comes from find_suspects, coupling by coupling; what would hold is asked
// of all couplings together (app/diagnose/coupled_step.h), in the pose of the start.
#include "app/diagnose/remedies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/diagnose/coupled_step.h"
#include "app/diagnose/post_mortem.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr double kHalf = 0.5;  // of the largest w h: a run swings about the limit's pose

// 0.00037 gives 0.0002: one digit, 1, 2 or 5, that people read at once.
double rounded_down(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= value * (1 + 1e-12)) return digit * decade;
  return decade;
}

// The largest factor in (0, 1], a power of two, that holds; 0: none.
template <class Good>
double max_half(Good good) {
  double factor = 1;
  for (int i = 0; i < 60; ++i, factor *= kHalf)
    if (good(factor)) return factor;
  return 0;
}

class RemedyFinder {
 public:
  RemedyFinder(const SimulatePlan& plan, const PostMortem& dead)
      : plan_(plan), scene_(plan.input.scene->description), step_(plan) {
    std::vector<StabilityViolation> suspects = dead.suspects;
    if (suspects.empty()) suspects = find_suspects(plan);
    for (const StabilityViolation& s : suspects) blame(s);
    if (guilty_.empty() && !step_.holds()) blame_all();
  }

  std::vector<SuggestedFix> find() {
    if (!guilty_.empty()) {
      shorter_step();
      softer();
      implicit();
    }
    if (damper_) integrator();
    if (found_.empty()) no_suspect();
    return std::move(found_);
  }

 private:
  const CouplingDescription& coupling(int i) const {
    return scene_.couplings[static_cast<std::size_t>(i)];
  }

  void blame(const StabilityViolation& s) {
    if (s.step <= s.max_step) return;
    if (s.kind == StabilityViolation::Kind::joint_damper)
      damper_ = true;
    else
      guilty_.push_back(static_cast<int>(s.index));
  }

  // Each for itself is within its limit, all together are not.
  void blame_all() {
    for (std::size_t i = 0; i < scene_.couplings.size(); ++i) {
      const CouplingDescription& c = scene_.couplings[i];
      const bool is_stepped = c.law != CouplingSpec::Type::god_object && !c.outside &&
                              c.treatment != Discretization::implicit;
      if (is_stepped) guilty_.push_back(static_cast<int>(i));
    }
  }

  bool any_rate() const {
    return std::ranges::any_of(scene_.couplings,
                               [](const CouplingDescription& c) { return c.rate > 0; });
  }

  void add(std::string words, std::vector<std::string> changes) {
    found_.push_back({std::move(words), std::move(changes)});
  }

  // Where forces are held the step is a part of the time between two, and it is the rate that
  // counts: both are raised together.
  void shorter_step() {
    const double h = step_.step();
    if (any_rate()) return faster();
    const double factor = max_half([&](double f) { return step_.holds_at_step(f * h); });
    if (!(factor > 0)) return;
    const double step = rounded_down(kHalf * factor * h);
    add(fmt::format("a step of {:g} ms", 1000 * step), {"step=" + number_text(step)});
  }

  void faster() {
    std::vector<std::string> changes;
    for (const int i : guilty_) {
      const double rate = coupling(i).rate;
      if (!(rate > 0)) continue;
      const int now = static_cast<int>(std::lround(1 / (rate * step_.step())));
      int steps = now;
      while (steps > 1 && !step_.holds_with_hold(i, steps)) steps /= 2;
      steps = std::max(1, steps / 2);
      if (steps == now || !step_.holds_with_hold(i, steps)) return;
      changes.push_back("coupling[" + std::to_string(i) +
                        "].rate=" + number_text(1 / (steps * step_.step())));
    }
    if (!changes.empty()) add("the force computed more often", std::move(changes));
  }

  void softer() {
    const double factor =
        kHalf * kHalf * max_half([&](double f) { return step_.holds_with_softer(guilty_, f); });
    if (!(factor > 0)) return;
    std::vector<std::string> changes;
    std::string words;
    for (const int i : guilty_) {
      const CouplingDescription& c = coupling(i);
      if (!(c.stiffness > 0)) return;
      const auto put = [&](const char* key, double value) {
        if (value > 0)
          changes.push_back("coupling[" + std::to_string(i) + "]." + key + "=" +
                            number_text(rounded_down(value)));
      };
      put("stiffness", factor * c.stiffness);
      put("damping", std::sqrt(factor) * c.damping);
      put("turn_stiffness", factor * c.turn_stiffness);
      put("turn_damping", std::sqrt(factor) * c.turn_damping);
      words += fmt::format("{}{} at {:g}", words.empty() ? "" : ", ", c.name,
                           rounded_down(factor * c.stiffness));
    }
    add("a softer coupling: " + words, std::move(changes));
  }

  void implicit() {
    using CouplingLaw = CouplingSpec::Type;
    if (plan_.input.scene->may_touch() && scene_.contact == ContactMode::event) return;
    std::vector<std::string> changes;
    for (const int i : guilty_) {
      const CouplingDescription& c = coupling(i);
      const CouplingFacts& facts = facts_of(c.law, c.printed);
      const std::string path = "coupling[" + std::to_string(i) + "].";
      if (c.rate > 0) return;  // what is held is explicit
      if (facts.treatments != CouplingFacts::Discretizations::all)
        changes.push_back(path + "type=" + (facts.at_point ? "linear" : "torsional"));
      if (c.law == CouplingLaw::stable_pd) changes.push_back(path + "measure=joint");
      changes.push_back(path + "treatment=implicit");
    }
    if (!facts_of(plan_.run.integrator).implicit_force)
      changes.emplace_back("integrator=semi-implicit");
    if (!step_.holds_implicitly(guilty_)) return;
    add("implicit treatment: any stiffness, at this step", std::move(changes));
  }

  void integrator() {
    add("the integrator semi-implicit, which takes dampers of joints implicitly",
        {"integrator=semi-implicit"});
  }

  // By linear theory nothing is to blame: it may be the turning of a spring's arm, contacts, or a
  // throw. A shorter step has more room for all of them.
  void no_suspect() {
    if (plan_.run.is_adaptive() || any_rate()) return;
    const double step = rounded_down(0.25 * step_.step());
    if (!step_.is_empty() || plan_.input.scene->may_touch())
      add(fmt::format("a step of {:g} ms: more room for whatever it was", 1000 * step),
          {"step=" + number_text(step)});
  }

  const SimulatePlan& plan_;
  const SceneDescription& scene_;
  CoupledStep step_;
  std::vector<int> guilty_;  // couplings that are beyond their limits
  bool damper_ = false;
  std::vector<SuggestedFix> found_;
};

}  // namespace

std::vector<SuggestedFix> remedies_of(const SimulatePlan& plan, const PostMortem& dead) {
  if (!plan.input.scene) {
    const double step = rounded_down(0.25 * plan.run.step);
    return {{fmt::format("a step of {:g} ms", 1000 * step), {"step=" + number_text(step)}}};
  }
  return RemedyFinder(plan, dead).find();
}

void write_remedies(const std::vector<SuggestedFix>& remedies, JsonWriter& json) {
  json.list(remedies, [&](const SuggestedFix& fix) {
    json.object({{"words", fix.words}, {"changes", fix.changes}});
  });
}

}  // namespace twinarm
