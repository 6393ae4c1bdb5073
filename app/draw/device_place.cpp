// Where the hand device is drawn.
#include "app/draw/scene_view.h"
#include "coupling/device/omni.h"

namespace twinarm {

Vector3 device_shoulder() {
  const OmniFigures omni;
  return {0, omni.lift, -omni.back};
}

void place_device(Stage& stage) {
  // Device axes: x right, y up, z to the user, who sits at the world's -y.
  Pose X_WD;
  for (int c = 0; c < 3; ++c) X_WD.R.col(c) = world_from_device(Vector3::Unit(c));
  const Vector3 foot = device_shoulder() - Vector3(0, kDeviceShoulder, 0);
  const Vector3 place(stage.extent.low().x() - 0.2, stage.extent.low().y(),
                      stage.list.ground.height);
  X_WD.p = place - X_WD.R * foot;
  stage.X_WDevice = X_WD;
  if (!stage.frames_device) return;
  for (const double x : {-0.13, 0.13})
    for (const double y : {0.0, 0.4})
      for (const double z : {-0.09, 0.3}) stage.extent.add(X_WD * (foot + Vector3(x, y, z)));
}

}  // namespace twinarm
