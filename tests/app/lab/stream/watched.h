// A run of the lab and a view of it, whose frames are decoded by the protocol's table.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>

#include "app/lab/run/lab_run.h"
#include "app/lab/stream/lab_view.h"
#include "tests/app/lab/stream/frame_reader.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {

inline const std::string kBoxes = test_data("app/lab/stream/boxes.toml");

struct Watched {
  std::unique_ptr<LabScene> scene;
  OperatorInput hand;
  std::unique_ptr<LabRun> run;
  std::shared_ptr<const LabScene::Plan> plan;
  std::unique_ptr<LabView> view;
  LabNames names;
  RecordingHeader header;

  explicit Watched(const fs::path& file) {
    SimulateOptions options;
    options.robot.model = file;
    scene = std::make_unique<LabScene>(options);
    run = std::make_unique<LabRun>(scene->plan(), hand);
    plan = scene->plan();
    header = scene->header({}, {});
    view = std::make_unique<LabView>(7, std::shared_ptr<const SimulatePlan>(plan, &plan->prepared),
                                     header, SceneWords{});
  }
  LabFrame after(int steps) {
    for (int i = 0; i < steps; ++i) REQUIRE(run->step());
    LabFrame frame = run->frame(names);
    view->name_rows(names.rows);
    return frame;
  }
  std::size_t place_of(const char* list, const char* key, const std::string& name) const {
    const auto all = texts_in(view->scene_message(), list, key);
    const auto found = std::find(all.begin(), all.end(), name);
    REQUIRE_MESSAGE(found != all.end(), name);
    return static_cast<std::size_t>(found - all.begin());
  }
  std::size_t layer(const std::string& name) const { return place_of("layers", "name", name); }
};

inline Watched watched_boxes() {
  const TemporaryFolder folder;
  return Watched(folder.write("boxes.toml", kBoxes));
}
inline Watched watched_arm() {
  return Watched(fs::path(TWINARM_SOURCE_DIR) / "assets/scenes/hand_and_obstacles.toml");
}

inline std::vector<std::string> all_layers(const Watched& watched) {
  return texts_in(watched.view->scene_message(), "layers", "name");
}

inline Vector3 position_of(const ReadFrame& read, std::size_t i) {
  return {read.position[3 * i], read.position[3 * i + 1], read.position[3 * i + 2]};
}
inline Matrix3 rotation_of(const ReadFrame& read, std::size_t i) {
  const auto part = [&](std::size_t c) { return read.turn[4 * i + c] / 32767.0; };
  return Eigen::Quaterniond(part(3), part(0), part(1), part(2)).toRotationMatrix();
}

}  // namespace twinarm
