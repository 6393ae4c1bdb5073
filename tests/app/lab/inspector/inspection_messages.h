// Frames of runs, and the inspector's messages.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/lab/inspector/body_inspector.h"
#include "app/run/stepped_run.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm::testing {

inline SimulatePlan plan_of_asset(const std::string& file, double duration) {
  SimulateOptions options;
  options.robot.model = std::string(TWINARM_SOURCE_DIR "/assets/") + file;
  options.integrator = "semi-implicit";
  options.contact = options.robot.model.extension() == ".toml" ? "rigid" : "";
  options.duration = duration;
  return prepare_simulation(options);
}

// A frame after some steps, and results of the next step.
struct RunSample {
  LabFrame frame;
  std::vector<std::string> energy_balance;
  std::vector<double> qdd;     // of the next step
  std::vector<Vector3> force;  // of its contacts
};
inline RunSample sample_of(SimulatePlan plan, long steps) {
  RunSample sample;
  RunWatch watch;
  watch.warn = [](const std::string&) {};
  watch.look = [&](SteppedRun& view) {
    if (view.step() == steps) {
      RecordedFrame& recorded = sample.frame.recorded;
      recorded.step = steps;
      recorded.t = view.simulation().state().t;
      recorded.memory = view.memory();
      for (const EnergyRow& row : view.energy_balance()) {
        recorded.rows.push_back(static_cast<std::uint32_t>(sample.energy_balance.size()));
        recorded.works.push_back(row.work);
        sample.energy_balance.push_back(row.name);
      }
    }
    if (view.step() != steps + 1) return;
    sample.qdd = view.simulation().mechanism().w.qdd;
    if (view.contacts() && view.contacts()->contacts())
      for (const ContactPoint& p : view.contacts()->contacts()->points())
        if (!p.force_W.isZero(0)) sample.force.push_back(p.force_W);
  };
  plan.run.times.clear();
  plan.run.duration = static_cast<double>(steps + 2) * plan.run.step;
  run_plan(plan.input, plan.run, watch);
  REQUIRE(!sample.qdd.empty());
  return sample;
}
inline RunSample sample_of(const std::string& file, long steps) {
  return sample_of(plan_of_asset(file, 1), steps);
}

inline Value parsed(const std::string& message) {
  const TemporaryFolder folder;
  return read_json(folder.write("inspection.json", message));
}
inline const Value& at(const Value& value, const std::string& name) {
  const Value* found = value.find(name);
  REQUIRE_MESSAGE(found, name);
  return *found;
}
inline Vector3 vector_of(const Value& list) {
  REQUIRE(list.items.size() == 3);
  return {list.items[0].number, list.items[1].number, list.items[2].number};
}

// The sample with an inspector of its file.
struct InspectedRun : RunSample {
  InspectedRun(const std::string& file, long steps)
      : RunSample(sample_of(file, steps)),
        plan(plan_of_asset(file, 1)),
        inspector(plan_of_asset(file, 1)) {}
  const Model<double>& model() const { return plan.input.robot.model; }
  std::string text(const LabFrame& of, std::size_t body, bool paused) {
    return inspector.message(of, {body, paused, 1, &energy_balance});
  }
  Value message(std::size_t body, bool paused) { return parsed(text(frame, body, paused)); }

  SimulatePlan plan;
  BodyInspector inspector;
};

}  // namespace twinarm::testing
