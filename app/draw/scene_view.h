// DrawList of a scene for all of its pictures: bodies and floor, then overlays.
#pragma once

#include "app/draw/scene_meshes.h"
#include "app/draw/snapshot.h"

namespace twinarm {

// Named cameras, and the distance at which a whole run fits the picture.

inline constexpr double kFrameMargin = 1.18;  // picture size over scene size

// Bounding points of the scene at one or many instants.
class Extent {
 public:
  void add(const SceneMeshes& meshes, const Snapshot& snapshot);
  void add(const Extent& other) {
    for (const Vector3& p : other.points()) add(p);
  }
  void add(const Vector3& p_W);
  double reach(const Vector3& p_W) const;  // largest distance of a point from p_W [m]
  bool empty() const { return points_.empty(); }
  const std::vector<Vector3>& points() const { return points_; }
  Vector3 center() const { return box_.center(); }
  // Of the sphere about the bounding box [m]; at least 1 mm.
  double radius() const { return empty() ? 1.0 : std::max(1e-3, 0.5 * box_.sizes().norm()); }
  const Vector3& low() const { return box_.min(); }
  const Vector3& high() const { return box_.max(); }

 private:
  std::vector<Vector3> points_;
  Eigen::AlignedBox3d box_;
};

// Distance from the centre of the first instant beyond which instants are ignored for framing [m]:
// four times the distance of three quarters of the run. Bodies of a diverged run may be far away.
double max_distance_of_interest(const std::vector<Extent>& instants);

struct CameraWish {
  double azimuth = -52, elevation = 22;  // of the eye about the target [degrees], x axis, horizon
  double distance = 0;                   // [m]; 0: the whole scene fits
  int follow = -1;                       // body in the centre of the picture
  double field_of_view = Camera{}.field_of_view;  // vertical [rad]
};

// "auto", "front", "side", "top", "iso", "follow:BODY", "AZIMUTH,ELEVATION[,DISTANCE]" in degrees
// and metres. Throws InputError.
CameraWish parse_camera(const std::string& text, const Model<double>& model);

// `aspect` is width over height.
Camera make_camera(const CameraWish& wish, const Extent& extent, double aspect);
// follow() translates the camera to `target_W`. closeup() is the distance at which a body fills
// about a third of the picture's height.
double closeup(const SceneMeshes& meshes, int body, double field_of_view);
Camera follow(Camera camera, const Vector3& target_W);

// 1, 2 or 5 times a power of ten, the nearest below.
double round_down(double value);

// Scales of overlays: the maxima over all pictures of a film.
struct Scales {
  double length = 1;         // radius of the scene [m]
  double contact_force = 0;  // of a pair of geometries [N]
  double force = 0;          // of a coupling [N]
  double couple = 0;         // torque of a coupling [N m]
  double momentum = 0;       // [kg m/s]
  double kinetic = 0;        // [J]
  double elastic = 0;
  double lowest_potential = 0, highest_potential = 0;
  bool has_potential = false;
  void widen_run(const Model<double>& model, const Snapshot& snapshot);  // all but contact forces
  void widen_contacts(const Snapshot& snapshot);
  void widen(const Scales& other);
  double radius() const { return 0.006 * length; }  // of rods and arrows [m]
  // A round number of metres per unit; the largest arrow is about a third of the scene.
  double metres_per(double largest) const {
    return largest > 0 ? round_down(0.4 * length / largest) : 0;
  }
};

struct Trace {          // paths of bodies
  double span = 1e300;  // time before the snapshot that is drawn [s]
  std::vector<double> t;
  std::vector<std::vector<Vector3>> p_Wc;  // centres of mass, by instant and body
  void add(const Model<double>& model, const Snapshot& snapshot);
};

struct SceneView {
  const Model<double>* model = nullptr;
  const SceneModel* scene = nullptr;  // null for a robot alone
  SceneMeshes cast;
  DrawList list;
  std::vector<Extent> instants;  // of the run and of its pictures
  bool has_operator = false;     // an input device at one of them
  Extent extent;                 // of all within `farthest`
  double farthest = 1e300;       // max_distance_of_interest()
  Scales scales;
  Trace trace;
  std::string name;
  bool frames_device = false;     // set before set_view(): the input device is in the picture
  std::optional<Pose> X_WDevice;  // of the input device, if there is one
};

SceneView make_scene_view(const SceneModel& scene);
SceneView make_scene_view(const RobotDescription& robot, const Model<double>& model);

// Before the first picture, in this order: look_ahead() with snapshots of the whole run (framing,
// trails), look_at() with those of the pictures; settle(); measure() with both (scales);
// set_view().
void look_ahead(SceneView& view, const Snapshot& snapshot);
void look_at(SceneView& view, const Snapshot& snapshot);
void settle(SceneView& view);
// Contact forces are scaled by the pictures, so that an impact between two pictures has no effect;
// the rest by the whole run. Instants beyond `farthest` are ignored.
enum class Measured { of_run, of_picture };
void measure(SceneView& view, const Snapshot& snapshot, Measured measured);
// Camera, floor and grid. A note if the floor is not part of the scene.
void set_view(SceneView& view, const CameraWish& wish, double aspect);
// Places the input device on the ground, to the left and in front of the scene.
void place_device(SceneView& view);
// Its shoulder in device axes, and the height above the ground [m]: the case is on a block because
// the stylus reaches below the case.
Vector3 device_shoulder();
inline constexpr double kDeviceShoulder = 0.21;

// Clears stage.list and adds the planes and the bodies of all variants.
void draw_bodies(SceneView& view, const Snapshot& snapshot);

}  // namespace twinarm
