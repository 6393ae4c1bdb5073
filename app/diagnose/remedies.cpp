// Violations come from find_violations(), coupling by coupling; the fixes are tested on all
// couplings together (app/diagnose/coupled_step.h) in the initial pose.
#include <fmt/format.h>

#include "app/diagnose/coupled_step.h"
#include "app/diagnose/post_mortem.h"

namespace twinarm {
namespace {

constexpr double kMinFactor = 1e-3;  // softer springs hardly couple, shorter steps are too slow
constexpr double kHalf = 0.5;        // margin in omega h: the limit varies with the pose

// Down to 1, 2 or 5 times a power of ten.
double rounded_down(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= value * (1 + 1e-12)) return digit * decade;
  return decade;
}

// The largest stable factor among 1, 1/2, 1/4, ...; 0: none.
template <class IsStable>
double max_stable_power_of_two(IsStable is_stable) {
  double factor = 1;
  for (int i = 0; i < 60; ++i, factor *= kHalf)
    if (is_stable(factor)) return factor;
  return 0;
}

class RemedyFinder {
 public:
  RemedyFinder(const SimulatePlan& plan, const PostMortem& post_mortem)
      : plan_(plan), scene_(plan.input.scene->description), step_(plan) {
    std::vector<StabilityViolation> violations = post_mortem.violations;
    if (violations.empty()) violations = find_violations(plan);
    for (const StabilityViolation& s : violations) {
      if (s.step <= s.max_step) continue;
      if (s.kind == StabilityViolation::Kind::joint_damper)
        damper_ = true;
      else
        unstable_.push_back(static_cast<int>(s.index));
    }
    if (unstable_.empty() && !step_.is_stable()) take_all_couplings();
  }

  std::vector<SuggestedFix> find() {
    const auto take_violations = [this] {
      shorter_step();
      softer();
      implicit();
    };
    if (!unstable_.empty()) take_violations();
    if (found_.empty() && !unstable_.empty()) {  // others are unstable with them
      take_all_couplings();
      take_violations();
    }
    if (damper_)
      add("integrator semi-implicit: takes joint dampers implicitly", {"integrator=semi-implicit"});
    if (found_.empty()) no_violation();
    return std::move(found_);
  }

 private:
  const CouplingDescription& coupling(int i) const {
    return scene_.couplings[static_cast<std::size_t>(i)];
  }

  // Each coupling alone is stable, all together are not.
  void take_all_couplings() {
    unstable_.clear();
    for (std::size_t i = 0; i < scene_.couplings.size(); ++i) {
      const CouplingDescription& c = scene_.couplings[i];
      const bool is_stepped = c.law != CouplingSpec::Type::god_object && !c.soft_limits &&
                              c.discretization != Discretization::implicit;
      if (is_stepped) unstable_.push_back(static_cast<int>(i));
    }
  }

  bool any_rate() const {
    return std::ranges::any_of(scene_.couplings,
                               [](const CouplingDescription& c) { return c.rate > 0; });
  }

  void add(std::string words, std::vector<std::string> changes) {
    found_.push_back({std::move(words), std::move(changes)});
  }

  // For held forces the rate decides, not the step.
  void shorter_step() {
    const double h = step_.step();
    if (any_rate()) return higher_rate();
    const double factor =
        max_stable_power_of_two([&](double f) { return step_.is_stable_at_step(f * h); });
    if (factor < kMinFactor) return;
    const double step = rounded_down(kHalf * factor * h);
    add(fmt::format("step {:g} ms", 1000 * step), {"step=" + number_text(step)});
  }

  void higher_rate() {
    std::vector<std::string> changes;
    for (const int i : unstable_) {
      const double rate = coupling(i).rate;
      if (!(rate > 0)) continue;
      const int now = static_cast<int>(std::lround(1 / (rate * step_.step())));
      int steps = now;
      while (steps > 1 && !step_.is_stable_with_hold(i, steps)) steps /= 2;
      steps = std::max(1, steps / 2);
      if (steps == now || !step_.is_stable_with_hold(i, steps)) return;
      changes.push_back("coupling[" + std::to_string(i) +
                        "].rate=" + number_text(1 / (steps * step_.step())));
    }
    if (!changes.empty()) add("higher rate of the coupling force", std::move(changes));
  }

  void softer() {
    const auto is_stable = [&](double stiffness, double damping) {
      return step_.is_stable_with_softer(unstable_, stiffness, damping);
    };
    const double factor = kHalf * kHalf * max_stable_power_of_two([&](double f) {
                            return is_stable(f, std::sqrt(f));
                          });
    if (factor > kMinFactor) return scale_gains("lower stiffness: ", factor, std::sqrt(factor));
    const double damping =
        kHalf * max_stable_power_of_two([&](double f) { return is_stable(1, f); });
    if (damping > 0) scale_gains("lower damping: ", 1, damping);
  }

  void scale_gains(std::string words, double stiffness, double damping) {
    std::vector<std::string> changes;
    const char* separator = "";
    for (const int i : unstable_) {
      const CouplingDescription& c = coupling(i);
      const auto put = [&](const char* key, double value, double factor) {
        if (value > 0 && factor < 1)
          changes.push_back("coupling[" + std::to_string(i) + "]." + key + "=" +
                            number_text(rounded_down(factor * value)));
      };
      put("stiffness", c.stiffness, stiffness);
      put("damping", c.damping, damping);
      put("rotational_stiffness", c.rotational_stiffness, stiffness);
      put("rotational_damping", c.rotational_damping, damping);
      const double shown = stiffness < 1 ? stiffness * c.stiffness : damping * c.damping;
      if (!(shown > 0)) return;
      words += fmt::format("{}{} {:g}", separator, c.name, rounded_down(shown));
      separator = ", ";
    }
    add(std::move(words), std::move(changes));
  }

  void implicit() {
    using CouplingLaw = CouplingSpec::Type;
    if (plan_.input.scene->may_touch() && scene_.contact == ContactMode::event) return;
    std::vector<std::string> changes;
    for (const int i : unstable_) {
      const CouplingDescription& c = coupling(i);
      const CouplingFacts& facts = facts_of(c.law, c.printed);
      const std::string path = "coupling[" + std::to_string(i) + "].";
      if (c.rate > 0) return;  // a held force is explicit
      if (facts.discretizations != CouplingFacts::Discretizations::all)
        changes.push_back(path + "type=" + (facts.at_point ? "linear" : "torsional"));
      if (c.law == CouplingLaw::stable_pd) changes.push_back(path + "measure=joint");
      changes.push_back(path + "discretization=implicit");
    }
    if (!facts_of(plan_.run.integrator).implicit_force)
      changes.emplace_back("integrator=semi-implicit");
    if (!step_.is_stable_with_implicit(unstable_)) return;
    add("implicit discretization: stable at this step for any stiffness", std::move(changes));
  }

  // Stable by linear theory: large rotations of a spring's arm, contacts or speeds may be the
  // cause.
  void no_violation() {
    if (plan_.run.is_adaptive() || any_rate()) return;
    const double step = rounded_down(0.25 * step_.step());
    if (!step_.is_empty() || plan_.input.scene->may_touch())
      add(fmt::format("step {:g} ms: larger stability margin", 1000 * step),
          {"step=" + number_text(step)});
  }

  const SimulatePlan& plan_;
  const SceneDescription& scene_;
  CoupledStep step_;
  std::vector<int> unstable_;  // couplings beyond their stability limits
  bool damper_ = false;
  std::vector<SuggestedFix> found_;
};

}  // namespace

std::vector<SuggestedFix> fixes_of(const SimulatePlan& plan, const PostMortem& post_mortem) {
  if (plan.input.scene) return RemedyFinder(plan, post_mortem).find();
  const double step = rounded_down(0.25 * plan.run.step);
  return {{fmt::format("step {:g} ms", 1000 * step), {"step=" + number_text(step)}}};
}

void write_remedies(const std::vector<SuggestedFix>& remedies, JsonWriter& json) {
  json.list(remedies, [&](const SuggestedFix& fix) {
    json.object({{"words", fix.words}, {"changes", fix.changes}});
  });
}

}  // namespace twinarm
