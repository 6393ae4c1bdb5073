// Named cameras, and the distance at which a whole run fits the picture.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "app/draw/scene_meshes.h"
#include "app/draw/snapshot.h"
#include "app/render/list/draw_list.h"

namespace twinarm {

inline constexpr double kFrameMargin = 1.18;  // picture size over scene size

// Bounding points of the scene at one or many instants.
class Extent {
 public:
  void add(const SceneMeshes& meshes, const Snapshot& snapshot);
  void add(const Extent& other);
  void add(const Vector3& p_W);
  double reach(const Vector3& p_W) const;  // largest distance of a point from p_W [m]
  bool empty() const { return points_.empty(); }
  const std::vector<Vector3>& points() const { return points_; }
  Vector3 center() const { return box_.center(); }
  double radius() const;  // of the sphere about the bounding box [m]; at least 1 mm
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

}  // namespace twinarm
