// Scenes, and a run with its history.
#pragma once

#include "app/lab/run/history.h"
#include "app/lab/run/input_override.h"
#include "app/lab/run/lab_inputs.h"
#include "app/lab/run/lab_run.h"
#include "app/record/record_run.h"
#include "coupling/device/virtual_omni.h"
#include "solver/dynamics/energy_momentum.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {

inline const std::string kArm = test_data("app/lab/run/arm.toml");

inline const std::string kFreeBox = test_data("app/lab/run/free_box.toml");

inline std::string arm_with(const std::string& target) {
  std::string text = kArm;
  for (std::size_t at; (at = text.find("TARGET")) != std::string::npos;)
    text.replace(at, 6, target);
  return text;
}

inline SimulateOptions options_of(const TemporaryFolder& folder, const std::string& text) {
  SimulateOptions options;
  options.robot.model = folder.write("test.toml", text);
  return options;
}

inline LabScene lab_scene(const std::string& text) {
  const TemporaryFolder folder;  // removed when the scene runs
  return LabScene(options_of(folder, text));
}

// A run with its history: a frame each 16 steps.
struct Session {
  explicit Session(const std::string& text) : scene(lab_scene(text)) {
    run = std::make_unique<LabRun>(scene.plan(), hand);
    history.begin_segment({});
    history.add(run->frame(names));
  }
  void step(long steps) {
    for (long n = 0; n < steps; ++n) {
      REQUIRE(run->step());
      history.add(run->input());
      if (run->view().step() % 16 == 0) history.add(run->frame(names));
    }
  }
  void change(const std::vector<Change>& changes) {
    const auto frame = history.add(run->frame(names));
    run = std::make_unique<LabRun>(scene.plan(changes), hand, frame.get());
    history.begin_segment(changes);
    history.add(run->frame(names));
  }
  LabScene scene;
  OperatorInput hand;
  LabNames names;
  LabHistory history;
  std::unique_ptr<LabRun> run;
};

inline double work_of(const std::vector<EnergyRow>& rows, const std::string& name) {
  for (const EnergyRow& row : rows)
    if (row.name == name) return row.work;
  FAIL("no row " << name);
  return 0;
}
inline MomentumRow momentum_of(const std::vector<MomentumRow>& rows, const std::string& name) {
  for (const MomentumRow& row : rows)
    if (row.name == name) return row;
  FAIL("no row " << name);
  return {};
}

// Driven joints of the target robot at the start of the last step.
inline std::vector<double> kvr_of(const LabRun& run) {
  const SimulateInput& input = run.prepared().input;
  std::vector<double> q;
  for (const int body : run.input_override().driven())
    q.push_back(
        input.couplings->kvr(0).start().x.q[input.robot.model.iq[static_cast<std::size_t>(body)]]);
  return q;
}

}  // namespace twinarm
