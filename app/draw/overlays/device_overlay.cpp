// The hand device: a Phantom Omni in its true size, of rods and balls, in the posture of the hand.
//
// Its joints are a function of time (coupling/device/omni.h); the sizes of its parts, but for the
// two links, are taken by eye.
#include "coupling/device/omni.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

const Color kCase{0.23f, 0.24f, 0.27f, 1.0f}, kArm{0.66f, 0.68f, 0.71f, 1.0f},
    kStylus{0.16f, 0.33f, 0.62f, 1.0f}, kPressed{0.86f, 0.42f, 0.12f, 1.0f},
    kBlockColor{0.78f, 0.76f, 0.72f, 1.0f};
constexpr double kShoulder = kDeviceShoulder, kBlock = 0.085;
constexpr double kNextDevice = 0.35;                        // to the left of the one before [m]
constexpr double kFeltLength = 0.165, kFeltRadius = 0.007;  // of the peak force's arrow [m]
constexpr double kMinFelt = 0.01;                           // that is drawn [N]

void draw_device(DrawList& list, const Pose& X_WD, const ShownHand& hand) {
  const OmniParameters omni;
  const Vector3 shoulder = device_shoulder(), elbow = omni_elbow(omni, hand.theta);
  const Pose X_WS = X_WD * omni_stylus(omni, hand.theta);
  const Matrix3 waist = Eigen::AngleAxisd(-hand.theta[0], Vector3::UnitY()).toRotationMatrix();
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
  const Color& grip = hand.button ? kPressed : kStylus;
  add_rod(list, X_WS * Vector3(0, 0, -0.02), X_WS * Vector3(0, 0, 0.11), 0.0085, grip);
  const Vector3 tip = X_WS * Vector3(0, 0, -0.045), neck = X_WS * Vector3(0, 0, -0.02);
  add_mesh_instance(list, list.unit_mesh(UnitShape::cone), {rotation_taking_z_to(tip - neck), neck},
                    kCase, Vector3(0.0085, 0.0085, (tip - neck).norm()));
}

void show_device(SceneView& stage, const Snapshot& moment) {
  if (moment.hands.empty() || !stage.X_WDevice) return;
  Pose X_WD = *stage.X_WDevice;
  for (const ShownHand& hand : moment.hands) {
    draw_device(stage.list, X_WD, hand);
    X_WD.p.x() -= kNextDevice;
  }
  stage.list.legend.push_back({kStylus, "hand device (Phantom Omni), true size"});
}

// From the stylus' point, beside all that the device can do: a full arrow is its peak force. At
// that limit the colour changes.
void show_felt(SceneView& stage, const Snapshot& moment) {
  if (moment.hands.empty() || !stage.X_WDevice) return;
  const OmniParameters omni;
  const double most = omni.peak_force;
  Pose X_WD = *stage.X_WDevice;
  for (const ShownHand& hand : moment.hands) {
    const Vector3 p_W = X_WD * omni_position(omni, hand.theta);
    X_WD.p.x() -= kNextDevice;
    const double size = hand.force_W.norm();
    if (!(size > kMinFelt) || !(size < 1e6)) continue;
    const Vector3 along = hand.force_W / size, tip = p_W + (kFeltLength * size / most) * along;
    const bool is_most = size > 0.99 * most;
    add_arrow(stage.list, p_W, tip, kFeltRadius, is_most ? palette::kFeltMost : palette::kFelt);
    if (!is_most)
      add_arrow(stage.list, tip, p_W + kFeltLength * along, 0.6 * kFeltRadius, palette::kFeltRest);
    add_label(stage.list, p_W, fmt::format("{:.2f} of {:.1f} N", size, most), {26, -30});
  }
  stage.list.legend.push_back(
      {palette::kFelt, "force on the hand", scale_words(kFeltLength / most, 0.2, "N")});
  stage.list.legend.push_back(
      {palette::kFeltMost, "at the device's limit", ": " + with_unit(most, "N")});
}

}  // namespace

Overlays device_overlay() {
  return {{.place = 20,
           .name = "device",
           .what = "the hand device that moves the twin",
           .add = show_device,
           .seen_through = false},
          {.place = 210,
           .name = "felt",
           .what = "the force that the hand device puts on the hand",
           .add = show_felt,
           .is_live = true}};
}

}  // namespace twinarm
