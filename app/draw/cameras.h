// Where to look from: named cameras, and the distance from which all of a run fits the picture.
#pragma once

#include <string>
#include <vector>

#include "app/draw/scene_meshes.h"
#include "app/draw/snapshot.h"
#include "app/render/list/draw_list.h"

namespace twinarm {

inline constexpr double kFrameMargin = 1.18;  // of the picture around what is seen

// Points that bound what was on stage, at one instant or many.
class Extent {
 public:
  void add(const SceneMeshes& cast, const Snapshot& moment);
  void add(const Extent& other);
  void add(const Vector3& p_W);
  double reach(const Vector3& p_W) const;  // of the farthest point from there [m]; of none 0
  bool empty() const { return points_.empty(); }
  const std::vector<Vector3>& points() const { return points_; }
  Vector3 center() const { return 0.5 * (low_ + high_); }
  double radius() const;  // of the ball about the centre that holds the box [m]; at least 1 mm
  const Vector3& low() const { return low_; }
  const Vector3& high() const { return high_; }

 private:
  std::vector<Vector3> points_;
  Vector3 low_ = Vector3::Constant(1e300), high_ = Vector3::Constant(-1e300);
};

// How far from the middle of the first instant bodies still count as part of the scene [m]: four
// times as far as in three quarters of the run. A run that diverges throws them away in its last
// moments, and would be seen from so far that nothing is left of it.
double max_of_interest(const std::vector<Extent>& instants);

struct CameraWish {
  double azimuth = -52, elevation = 22;  // of the eye about the target [degrees], x axis, horizon
  double distance = 0;                   // [m]; 0: so that all fits
  int follow = -1;                       // body that stays in the middle
};

// "auto", "front", "side", "top", "iso", "follow:BODY", "AZIMUTH,ELEVATION[,DISTANCE]" in degrees
// and metres. Throws InputError.
CameraWish parse_camera(const std::string& text, const Model<double>& model);

// `aspect` is width over height.
Camera make_camera(const CameraWish& wish, const Extent& extent, double aspect);
// The same, moved along: the body at `target_W`. closeup() is the distance at which a body fills
// about a third of the picture's height.
double closeup(const SceneMeshes& cast, int body);
Camera follow(Camera camera, const Vector3& target_W);

// 1, 2 or 5 times a power of ten, the nearest below.
double round_down(double value);

}  // namespace twinarm
