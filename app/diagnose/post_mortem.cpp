#include "app/diagnose/post_mortem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "app/record/record_run.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

std::string short_text(double value) {
  return short_number_text(value);
}

using Works = std::map<std::string, double>;  // by row

Works works_of(const std::vector<EnergyRow>& rows) {
  Works works;
  for (const EnergyRow& row : rows) works[row.name] = row.work;
  return works;
}

// An implicit point spring whose target lay too far out: what the treatment leaves explicit, the
// turning of the lever arm, has a limit of its own (coupling/analysis/joint_space_stiffness.h).
struct PassedRadius {
  long step = 0;
  double time = 0;
  std::string coupling, joint;
  TargetRadius radius;
};

// The ledger where the last steps begin and where they end.
struct LastSteps {
  Works before, after;
  std::optional<PassedRadius> passed;  // the first in them
  long first = -1, last = 0;
  long count() const { return last - std::max(first, 1L) + 1; }  // the start is no step
  std::string words() const { return count() == 1 ? "step" : fmt::format("{} steps", count()); }
};

std::optional<PassedRadius> passed_radius(const SimulatePlan& prepared, const RunView& run) {
  SceneCouplings* couplings = prepared.input.couplings.get();
  const Simulation& simulation = run.simulation();
  const State<double>& x = simulation.state();
  for (std::size_t c = 0; couplings && c < couplings->size(); ++c) {
    const SceneCoupling& spec = couplings->spec(c);
    if (spec.treatment != Discretization::implicit || !spec.is_external() ||
        spec.type != CouplingDescription::Type::linear)
      continue;
    const TargetRadius radius =
        nearest_target_radius(simulation.mechanism().model, x, simulation.kinematics(),
                              couplings->target(c, x.t).k, spec.spring, prepared.run.step);
    if (radius.ratio() > 1)
      return PassedRadius{
          run.step(), x.t, spec.name,
          simulation.mechanism().model.joint_name[static_cast<std::size_t>(radius.body)], radius};
  }
  return std::nullopt;
}

LastSteps run_again(const SimulatePlan& prepared, RecordingHeader header,
                    const std::filesystem::path& file, const SimulateResult& result) {
  LastSteps found;
  const PostMortem& end = *result.post_mortem;
  const long last = end.by_energy ? end.step : end.step - 1;
  RunPlan plan = prepared.run;
  plan.times.clear();
  plan.energy_bound = HUGE_VAL;
  std::error_code ignored;
  if (!file.parent_path().empty()) std::filesystem::create_directories(file.parent_path(), ignored);
  RunRecorder recorder(file, std::move(header), prepared);
  RunWatch watch;
  watch.look = [&](RunView& run) {
    if (run.step() <= last - kLastSteps) return;
    found.last = run.step();
    if (found.first < 0) {
      found.first = run.step();
      found.before = works_of(run.ledger());
    }
    if (run.step() == last) found.after = works_of(run.ledger());
    if (!found.passed) found.passed = passed_radius(prepared, run);
    recorder.write(run);
  };
  const RunStart start{result.checkpoint, last};
  run_plan(prepared.input, plan, watch, &start);
  recorder.finish("post-mortem: " + end.reason);
  return found;
}

void find_row(const Works& since, const Works& now, PostMortem& found) {
  for (const auto& [name, work] : now) {
    const auto before = since.find(name);
    const double growth = work - (before == since.end() ? 0 : before->second);
    if (growth > found.row_growth || (std::isnan(growth) && found.row.empty()))
      found.row = name, found.row_growth = growth;
  }
}

void say_first_bad(PostMortem& found) {
  if (found.by_energy)
    found.words.push_back(
        fmt::format("fastest then: joint '{}', which carries body '{}'", found.joint, found.body));
  else if (!found.field.empty())
    found.words.push_back(fmt::format(
        "first bad quantity: '{}' of body '{}' (joint '{}'), {}", found.field, found.body,
        found.joint,
        found.pass > 0 ? fmt::format("in pass {}", found.pass) : "an input of the passes"));
}

std::string beyond_limit(const StabilityViolation& s) {
  return fmt::format("{}, w h = {} where at most {} holds ({})", s.name, short_text(s.product),
                     short_text(s.limit), s.scheme);
}

// The limits are about the start: what has moved since may be beyond one that was near then.
bool is_near_its_limit(const StabilityViolation& s) {
  return s.step > 0.5 * s.max_step;
}
std::string near_limit(const StabilityViolation& s, double h) {
  return fmt::format(
      "nearest its limit of linear theory about the start: {}, w h = {} where at most {} holds "
      "({}): "
      "the limit falls where less inertia meets it, or several pull at once; a step of {} s has "
      "twice the room",
      s.name, short_text(s.product), short_text(s.limit), s.scheme, short_text(0.5 * h));
}

std::string passed_words(const PassedRadius& p) {
  return fmt::format(
      "behind it: coupling '{}', a point spring that passed its geometric limit at step {}, t = {} "
      "s: about joint '{}' its target lay at a radius of {} m, and with the point at {} m at most "
      "{} m holds at this step (h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b))",
      p.coupling, p.step, short_text(p.time), p.joint, short_text(p.radius.R_K),
      short_text(p.radius.r), short_text(p.radius.largest));
}

void say_suspects(PostMortem& found, double h, const std::optional<PassedRadius>& passed) {
  bool any = false;
  if (passed) {
    any = true;
    found.words.push_back(passed_words(*passed));
    found.words.emplace_back(
        "a target that is led up step by step would hold, or springs on more links, or a coupling "
        "of type \"torsional\"; no stiffness does, where the spring is stiff: the limit is then "
        "twice "
        "the point's radius");
  }
  for (const StabilityViolation& s : found.suspects) {
    if (s.step <= s.max_step) continue;
    any = true;
    found.words.push_back("behind it: " + beyond_limit(s));
    found.words.push_back(s.fix);
  }
  if (!any && !found.suspects.empty() && is_near_its_limit(found.suspects.front()))
    found.words.push_back(near_limit(found.suspects.front(), h));
  else if (!any)
    found.words.emplace_back(
        "no coupling and no damper of a joint is beyond its limit of linear theory about the "
        "start: look for a short step, a contact or an actuator that drives it");
}

}  // namespace

std::string alarm_words(const Alarm& alarm, const SimulatePlan& prepared) {
  std::string words = fmt::format(
      "at t = {} s the ledger's row '{}' has come to {} J, more than the kinetic energy there was "
      "at {} s, and grows without bound: the run creates energy",
      short_text(alarm.t), alarm.row, short_text(alarm.work), short_text(alarm.since));
  const std::vector<StabilityViolation> suspects = find_suspects(prepared);
  const double h = prepared.run.step;
  if (!suspects.empty() && suspects.front().step > suspects.front().max_step)
    return words + "; behind it: " + beyond_limit(suspects.front()) + "; " + suspects.front().fix;
  if (!suspects.empty() && is_near_its_limit(suspects.front()))
    return words + "; " + near_limit(suspects.front(), h);
  return words + (prepared.run.is_adaptive()
                      ? "; give a smaller --tolerance"
                      : fmt::format("; give a shorter step than {} s, or --integrator dopri5 where "
                                    "nothing touches",
                                    short_text(prepared.run.step)));
}

namespace {

void say_first_words(const SimulatePlan& prepared, SimulateResult& result) {
  PostMortem& found = *result.post_mortem;
  say_first_bad(found);
  if (result.alarm)
    found.words.push_back(fmt::format(
        "an alarm came at t = {} s: the ledger's row '{}' grew without bound, to {} J",
        short_text(result.alarm->t), result.alarm->row, short_text(result.alarm->work)));
  found.suspects = find_suspects(prepared);
}

}  // namespace

void explain_at_once(const SimulatePlan& prepared, const RunView& run,
                     const std::vector<EnergyRow>& before, SimulateResult& result) {
  PostMortem& found = *result.post_mortem;
  say_first_words(prepared, result);
  say_suspects(found, prepared.run.step, passed_radius(prepared, run));
  if (!before.empty()) find_row(works_of(before), works_of(result.ledger), found);
  if (!found.row.empty())
    found.words.push_back(fmt::format("the ledger's row '{}' grew most: by {} J", found.row,
                                      short_text(found.row_growth)));
}

void explain(const SimulatePlan& prepared, RecordingHeader header,
             const std::filesystem::path& file, SimulateResult& result) {
  PostMortem& found = *result.post_mortem;
  say_first_words(prepared, result);
  std::optional<LastSteps> again;
  std::string not_kept;
  try {
    again = run_again(prepared, std::move(header), file, result);
  } catch (const InputError& error) {
    not_kept = error.what();
  }
  say_suspects(found, prepared.run.step, again ? again->passed : std::nullopt);
  if (again) {
    const LastSteps& steps = *again;
    find_row(steps.before, steps.after, found);
    if (!found.row.empty())
      found.words.push_back(fmt::format("the ledger's row '{}' grew most: by {} J in the last {}",
                                        found.row, short_text(found.row_growth), steps.words()));
    found.recording = file.string();
    found.words.push_back(
        fmt::format("its last {} {} in {}: look with `twinarm inspect {} --at {}`", steps.words(),
                    steps.count() == 1 ? "is" : "are", found.recording, found.recording,
                    number_text(found.time)));
  } else {
    found.words.push_back("its last steps are not kept: " + not_kept);
  }
}

}  // namespace twinarm
