// The stage: one DrawList that is kept for all pictures of a scene; bodies, twins and floor, then
// whatever overlays are asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/draw/cameras.h"
#include "app/draw/scene_meshes.h"
#include "app/draw/snapshot.h"
#include "app/render/list/draw_list.h"

namespace twinarm {

// What overlays measure by; the same for all pictures of a film.
struct Scales {
  double length = 1;         // half the extent of what is seen [m]
  double contact_force = 0;  // the largest to be shown, of all points of a pair [N]
  double force = 0;          // of a coupling [N]
  double couple = 0;         // [N m]
  double momentum = 0;       // [kg m/s]
  double angular = 0;        // [kg m^2/s]
  double kinetic = 0;        // the largest energies [J]
  double elastic = 0;
  double lowest_potential = 0, highest_potential = 0;
  bool has_moment = false;
  void widen_run(const Model<double>& model, const Snapshot& moment);  // all but contact forces
  void widen_contacts(const Snapshot& moment);
  void widen(const Scales& other);
  double radius() const { return 0.006 * length; }  // of rods and arrows [m]
  // A round number of metres per newton, by which the largest is drawn as a third of the scene.
  double metres_per(double largest) const;
};

struct Trace {          // where bodies went, by instant and body
  double span = 1e300;  // before the moment that is shown [s]: only this is drawn of it
  std::vector<double> t;
  std::vector<std::vector<Vector3>> p_Wc;  // centres of mass; of the world zero
};

struct SceneView {
  const Model<double>* model = nullptr;
  const SceneModel* scene = nullptr;  // null for a robot alone
  SceneMeshes cast;
  DrawList list;
  std::vector<Extent> instants;  // counted, of the run and of what is shown of it
  bool has_hand = false;         // at one of them
  Extent extent;                 // of all that are of interest
  double farthest = 1e300;       // see cameras.h
  Scales scales;
  Trace trace;
  std::string name;
  bool frames_device = false;     // set before set_view(): the hand device is part of the view
  std::optional<Pose> X_WDevice;  // where it stands, if a hand is seen
};

SceneView make_stage(const SceneModel& scene);
SceneView make_stage(const RobotDescription& robot, const Model<double>& model);

// Before the first picture, in this order: look_ahead() at moments of the whole run, for framing
// and trails, look_at() those of the pictures; settle(); measure() both, for the scales;
// set_view().
void look_ahead(SceneView& stage, const Snapshot& moment);
void look_at(SceneView& stage, const Snapshot& moment);
void settle(SceneView& stage);
// Contact forces by what is shown alone: an impact that is not must not make all others small. All
// else by the whole run. What lies too far counts for neither.
enum class Measured { of_run, of_picture };
void measure(SceneView& stage, const Snapshot& moment, Measured measured);
// Camera, floor and grid. Notes where the floor is only drawn.
void set_view(SceneView& stage, const CameraWish& wish, double aspect);
// The hand device stands on the ground, in front of all that is seen and to its left.
void place_device(SceneView& stage);
// Its shoulder in device axes, and how high that is above the ground [m]: the case is on a block,
// because at zero the stylus is below the foot of the case.
Vector3 device_shoulder();
inline constexpr double kDeviceShoulder = 0.21;

// Clears stage.list and adds the planes and the bodies of all variants.
void draw_bodies(SceneView& stage, const Snapshot& moment);

}  // namespace twinarm
