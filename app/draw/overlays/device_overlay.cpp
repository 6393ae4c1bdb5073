// Input device: a Phantom Omni in true size, in its pose (coupling/device/omni.h). Only the lengths
// of its two links are exact.
#include "coupling/device/omni.h"

#include <fmt/format.h>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

const Color kCase{0.23f, 0.24f, 0.27f, 1.0f}, kArm{0.66f, 0.68f, 0.71f, 1.0f},
    kStylus{0.16f, 0.33f, 0.62f, 1.0f}, kPressed{0.86f, 0.42f, 0.12f, 1.0f},
    kBlockColor{0.78f, 0.76f, 0.72f, 1.0f};
constexpr double kShoulder = kDeviceShoulder, kBlock = 0.085;
constexpr double kNextDevice = 0.35;                          // distance of devices [m]
constexpr double kForceLength = 0.165, kForceRadius = 0.007;  // of the peak force's arrow [m]
constexpr double kMinShownForce = 0.01;                       // that is drawn [N]

void draw_device(DrawList& list, const Pose& X_WD, const ShownDevice& device) {
  const OmniParameters omni;
  const Vector3 shoulder = device_shoulder(), elbow = omni_elbow(omni, device.theta);
  const Pose X_WS = X_WD * omni_stylus(omni, device.theta);
  const Matrix3 waist = Eigen::AngleAxisd(-device.theta[0], Vector3::UnitY()).toRotationMatrix();
  const Vector3 up = Vector3::UnitY();
  add_box(list, {X_WD.R, X_WD * (shoulder - (kShoulder - 0.5 * kBlock) * up)}, {0.16, kBlock, 0.19},
          kBlockColor);
  add_box(list, {X_WD.R, X_WD * (shoulder - (kShoulder - kBlock - 0.03) * up)}, {0.14, 0.06, 0.17},
          kCase);
  add_rod(list, X_WD * (shoulder - 0.07 * up), X_WD * shoulder, 0.035, kCase);
  const Vector3 across = 0.036 * waist.col(0);
  add_rod(list, X_WD * (shoulder - across), X_WD * (shoulder + across), 0.03, kStylus);
  add_rod(list, X_WD * shoulder, X_WD * elbow, 0.011, kArm);
  add_sphere(list, X_WD * elbow, 0.016, kCase);
  add_rod(list, X_WD * elbow, X_WS.p, 0.008, kArm);
  add_sphere(list, X_WS.p, 0.013, kCase);
  const Color& grip_color = device.button ? kPressed : kStylus;
  add_rod(list, X_WS * Vector3(0, 0, -0.02), X_WS * Vector3(0, 0, 0.11), 0.0085, grip_color);
  const Vector3 tip = X_WS * Vector3(0, 0, -0.045), neck = X_WS * Vector3(0, 0, -0.02);
  add_mesh_instance(list, list.unit_mesh(UnitShape::cone), {rotation_taking_z_to(tip - neck), neck},
                    kCase, Vector3(0.0085, 0.0085, (tip - neck).norm()));
}

void show_device(SceneView& view, const Snapshot& snapshot) {
  if (snapshot.devices.empty() || !view.X_WDevice) return;
  Pose X_WD = *view.X_WDevice;
  for (const ShownDevice& device : snapshot.devices) {
    draw_device(view.list, X_WD, device);
    X_WD.p.x() -= kNextDevice;
  }
  view.list.legend.push_back({kStylus, "input device (Phantom Omni), true size"});
}

// Force at the stylus beside the device's peak force; another colour at that limit.
void show_device_force(SceneView& view, const Snapshot& snapshot) {
  if (snapshot.devices.empty() || !view.X_WDevice) return;
  const OmniParameters omni;
  const double peak = omni.peak_force;
  Pose X_WD = *view.X_WDevice;
  for (const ShownDevice& device : snapshot.devices) {
    const Vector3 p_W = X_WD * omni_position(omni, device.theta);
    X_WD.p.x() -= kNextDevice;
    const double size = device.force_W.norm();
    if (!(size > kMinShownForce) || !(size < 1e6)) continue;
    const Vector3 along = device.force_W / size, tip = p_W + (kForceLength * size / peak) * along;
    const bool is_limit = size > 0.99 * peak;
    add_arrow(view.list, p_W, tip, kForceRadius,
              is_limit ? palette::kDeviceForceLimit : palette::kDeviceForce);
    if (!is_limit)
      add_arrow(view.list, tip, p_W + kForceLength * along, 0.6 * kForceRadius,
                palette::kDeviceForceRest);
    add_label(view.list, p_W, fmt::format("{:.2f} of {:.1f} N", size, peak), {26, -30});
  }
  view.list.legend.push_back(
      {palette::kDeviceForce, "force feedback", scale_words(kForceLength / peak, 0.2, "N")});
  view.list.legend.push_back(
      {palette::kDeviceForceLimit, "at the device's limit", ": " + with_unit(peak, "N")});
}

}  // namespace

Overlays device_overlay() {
  return {{20,
           "device",
           "input device that moves the target robot",
           show_device,
           {.seen_through = false}},
          {210,
           "device-force",
           "force feedback of the input device",
           show_device_force,
           {.is_live = true}}};
}

}  // namespace twinarm
