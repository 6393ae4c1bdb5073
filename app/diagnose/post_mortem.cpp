#include "app/diagnose/post_mortem.h"

#include <fmt/format.h>

#include "app/record/record_run.h"
#include "coupling/analysis/joint_space_stiffness.h"

namespace twinarm {
namespace {

constexpr long kLastSteps = 1000;

using Works = std::map<std::string, double>;  // by row

Works works_of(const std::vector<EnergyRow>& rows) {
  Works works;
  for (const EnergyRow& row : rows) works[row.name] = row.work;
  return works;
}

// An implicit point spring with its target beyond the radius for which it is stable: the rotation
// of the lever arm stays explicit (coupling/analysis/joint_space_stiffness.h).
struct PassedRadius {
  long step = 0;
  double time = 0;
  std::string coupling, joint;
  TargetRadius radius;
};

// Energy balance at the start and the end of the last steps.
struct LastSteps {
  Works before, after;
  std::optional<PassedRadius> passed;  // the first in them
  long first = -1, last = 0;
  std::string text() const {
    const long count = last - std::max(first, 1L) + 1;  // the initial state is not a step
    return count == 1 ? "step" : fmt::format("{} steps", count);
  }
};

std::optional<PassedRadius> passed_radius(const SimulatePlan& prepared, const SteppedRun& run) {
  SceneCouplings* couplings = prepared.input.couplings.get();
  const Simulation& simulation = run.simulation();
  const State<double>& x = simulation.state();
  for (std::size_t c = 0; couplings && c < couplings->size(); ++c) {
    const SceneCoupling& spec = couplings->spec(c);
    if (spec.discretization != Discretization::implicit || !spec.is_external() || !spec.is_linear())
      continue;
    const TargetRadius radius =
        nearest_target_radius(simulation.mechanism().model(), x, simulation.kinematics(),
                              couplings->target(c, x.t).k, spec.spring, prepared.run.step);
    if (radius.ratio() > 1)
      return PassedRadius{
          run.step(), x.t, spec.name,
          simulation.mechanism().model().joint_name[static_cast<std::size_t>(radius.body)], radius};
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
  watch.look = [&](SteppedRun& run) {
    if (run.step() <= last - kLastSteps) return;
    found.last = run.step();
    if (found.first < 0) {
      found.first = run.step();
      found.before = works_of(run.energy_balance());
    }
    if (run.step() == last) found.after = works_of(run.energy_balance());
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

void add_growth(PostMortem& found, const std::string& period) {
  if (!found.row.empty())
    found.words.push_back(fmt::format("Largest growth in the energy balance: row '{}', {} J{}",
                                      found.row, short_number_text(found.row_growth), period));
}

std::string limit_text(const StabilityViolation& s, const char* relation) {
  return fmt::format("{}: omega h = {:.4g} {} the stability limit {:.4g} ({}, at the start pose)",
                     s.name, s.product, relation, s.limit, s.scheme);
}

// The likely cause and its fix, or a limit that is near: the limits are those of the initial state.
std::vector<std::string> violation_text(const std::vector<StabilityViolation>& violations,
                                        double h) {
  std::vector<std::string> text;
  for (const StabilityViolation& s : violations)
    if (s.step > s.max_step)
      text.insert(text.end(), {"Likely cause: " + limit_text(s, "exceeds"), s.fix});
  if (text.empty() && !violations.empty() &&
      violations.front().step > 0.5 * violations.front().max_step)
    text.push_back(
        fmt::format("Near its limit: {}; the limit decreases where the apparent inertia "
                    "is smaller or several couplings act together. Suggested step: {} s",
                    limit_text(violations.front(), "is close to"), short_number_text(0.5 * h)));
  return text;
}

void add_violations(PostMortem& found, double h, const std::optional<PassedRadius>& passed) {
  if (passed) {
    const PassedRadius& p = *passed;
    found.words.push_back(fmt::format(
        "Likely cause: coupling '{}', an implicit point spring, exceeded its geometric limit at "
        "step {}, t = {} s: target {:.4g} m from the axis of joint '{}', stable up to {:.4g} m for "
        "a point at {:.4g} m and this step (h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b))",
        p.coupling, p.step, short_number_text(p.time), p.radius.R_K, p.joint, p.radius.largest,
        p.radius.r));
    found.words.emplace_back(
        "Use a smoother target, couple more links, or type = \"torsional\"; for a stiff spring the "
        "limit is twice the point's radius at any stiffness");
  }
  const std::vector<std::string> text = violation_text(found.violations, h);
  found.words.insert(found.words.end(), text.begin(), text.end());
  if (!passed && text.empty())
    found.words.emplace_back(
        "No coupling or joint damper exceeds its stability limit about the initial state: check "
        "the step, contacts and actuators");
}

void add_first_words(const SimulatePlan& prepared, SimulateResult& result) {
  PostMortem& found = *result.post_mortem;
  if (found.by_energy)
    found.words.push_back(
        fmt::format("Fastest joint at the stop: {} (body {})", found.joint, found.body));
  else if (!found.field.empty())
    found.words.push_back(fmt::format(
        "First non-finite quantity: '{}' of body '{}' (joint '{}'), {}", found.field, found.body,
        found.joint,
        found.pass > 0 ? fmt::format("in pass {}", found.pass) : "an input of the passes"));
  if (result.alarm)
    found.words.push_back(fmt::format("Energy alarm at t = {} s: row '{}' reached {} J",
                                      short_number_text(result.alarm->t), result.alarm->row,
                                      short_number_text(result.alarm->work)));
  found.violations = find_violations(prepared);
}

}  // namespace

std::string alarm_words(const Alarm& alarm, const SimulatePlan& prepared) {
  std::string words = fmt::format(
      "Energy error: row '{}' reached {} J at t = {} s, more than the kinetic energy at {} s, and "
      "keeps growing",
      alarm.row, short_number_text(alarm.work), short_number_text(alarm.t),
      short_number_text(alarm.since));
  const double h = prepared.run.step;
  std::vector<StabilityViolation> violations = find_violations(prepared);
  if (!violations.empty()) violations.resize(1);
  const std::vector<std::string> text = violation_text(violations, h);
  for (const std::string& part : text) words += "; " + part;
  if (!text.empty()) return words;
  return words +
         (prepared.run.is_adaptive()
              ? "; use a smaller --tolerance"
              : fmt::format("; use a step below {} s, or --integrator dopri5 without contacts",
                            short_number_text(h)));
}

void explain_at_once(const SimulatePlan& prepared, const SteppedRun& run,
                     const std::vector<EnergyRow>& before, SimulateResult& result) {
  PostMortem& found = *result.post_mortem;
  add_first_words(prepared, result);
  add_violations(found, prepared.run.step, passed_radius(prepared, run));
  if (!before.empty()) find_row(works_of(before), works_of(result.energy_balance), found);
  add_growth(found, "");
}

void explain(const SimulatePlan& prepared, RecordingHeader header,
             const std::filesystem::path& file, SimulateResult& result) {
  PostMortem& found = *result.post_mortem;
  add_first_words(prepared, result);
  std::optional<LastSteps> again;
  std::string write_error;
  try {
    again = run_again(prepared, std::move(header), file, result);
  } catch (const InputError& error) {
    write_error = error.what();
  }
  add_violations(found, prepared.run.step, again ? again->passed : std::nullopt);
  if (!again) {
    found.words.push_back("Could not write the last steps: " + write_error);
    return;
  }
  find_row(again->before, again->after, found);
  add_growth(found, " in the last " + again->text());
  found.recording = file.string();
  found.words.push_back(
      fmt::format("Recording of the last {}: {}; see `twinarm inspect {} --at {}`", again->text(),
                  found.recording, found.recording, number_text(found.time)));
}

}  // namespace twinarm
