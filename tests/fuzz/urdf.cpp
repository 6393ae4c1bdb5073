// A robot's file: read, made a model of, and written; what was written is read again.
#include "collision/import/urdf/urdf.h"

#include "collision/import/robot/robot_model.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void urdf(Bytes bytes) {
  const RobotFileOptions options{.geometry = RobotFileOptions::Geometry::optional};
  goes_through([&] {
    const RobotDescription robot = read_urdf(folder().write("robot.urdf", bytes), options);
    ModelOptions how;
    for (const bool floating : {false, true}) {
      how.floating = floating;
      goes_through([&] { build_model(robot, how); });
    }
    const std::string text = urdf_text(robot, folder().path());
    const bool is_read =
        goes_through([&] { read_urdf(folder().write("again.urdf", text), options); });
    require(is_read, "what was written of a robot is not read again");
  });
}

}  // namespace twinarm::fuzz
