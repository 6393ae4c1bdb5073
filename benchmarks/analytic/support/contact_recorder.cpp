#include "benchmarks/analytic/support/contact_recorder.h"

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {

void ContactRecorder::add(const ContactScene& scene, double energy) {
  ContactRun& run = runs.back();
  run.t.push_back(scene.t());
  run.energy.push_back(energy);
  const std::vector<double> values = look(scene);
  run.seen.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) run.seen[i].push_back(values[i]);
}

void ContactRecorder::begin(const ContactScene& scene) {
  if (!look) return;
  if (!search && runs.size() == count) throw Enough{};
  active_ = ++begun_ % every == 0;
  if (!active_) return;
  runs.emplace_back();
  steps_ = 0;
  stride_ = 1;
  add(scene, scene.energy());
}

void ContactRecorder::note(const ContactScene& scene, double energy) {
  if (!active_) return;
  if (scene.t() > until) {
    if (!search && runs.size() == count) throw Enough{};
    return;
  }
  if (++steps_ % stride_ != 0) return;
  add(scene, energy);
  constexpr std::size_t kMost = 1200;
  ContactRun& run = runs.back();
  if (run.t.size() <= kMost) return;
  // Every other one goes; the first stays.
  const auto halve = [](std::vector<double>& values) {
    for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
    values.resize((values.size() + 1) / 2);
  };
  halve(run.t);
  halve(run.energy);
  for (auto& values : run.seen) halve(values);
  stride_ *= 2;
}

void ContactRecorder::outcome(double tried, bool holds) {
  if (!active_) return;  // a limit that is computed, without scenes
  active_ = false;
  runs.back().tried = tried;
  runs.back().holds = holds;
  if (runs.size() < 2) return;
  if (runs[0].holds == holds)
    runs.pop_back();
  else
    throw Enough{};
}

}  // namespace twinarm
