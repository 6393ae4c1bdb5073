#include "app/draw/scene_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/draw/palette.h"
#include "coupling/device/omni.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

bool is_level(const ScenePlane& plane) {
  return plane.body == 0 && plane.normal_L.z() > 1 - 1e-9;
}

// The highest level floor that nothing of the scene lies under, if there is one.
std::optional<double> level_floor(const SceneView& stage) {
  std::optional<double> height;
  for (const ScenePlane& plane : stage.cast.planes)
    if (is_level(plane)) height = std::max(height.value_or(-1e300), plane.offset);
  return height;
}

void draw_planes(SceneView& stage, const Snapshot& moment) {
  const double reach = 3.2 * stage.extent.radius(), thick = 0.02 * stage.extent.radius();
  const Vector3 center = stage.extent.empty() ? Vector3(Vector3::Zero()) : stage.extent.center();
  for (const ScenePlane& plane : stage.cast.planes) {
    if (is_level(plane)) continue;  // that is the ground
    const Pose& X_WL = moment.k.X_WL[plane.body];
    const Vector3 n = X_WL.R * plane.normal_L;
    const double offset = plane.offset + n.dot(X_WL.p);
    const Vector3 middle = center - (n.dot(center) - offset) * n;
    const OfBody mark(stage.list, plane.body);
    add_box(stage.list, {rotation_taking_z_to(n), middle - 0.5 * thick * n}, {reach, reach, thick},
            plane.color);
  }
}

// What stands fixed beside the robots looks alike in all.
Color lane_color(const ScenePart& part, std::size_t lane) {
  if (part.body == 0 && part.robot < 0) return part.color;
  Color color = palette::lane(lane);
  color.a = part.color.a;
  return color;
}

void draw_first_variant(SceneView& stage, const Snapshot& moment) {
  for (const ScenePart& part : stage.cast.parts) {
    const OfBody mark(stage.list, part.body);
    const std::size_t before = stage.list.instances.size();
    const bool has_lanes = !moment.lanes.empty();
    add_mesh_instance(stage.list, part.mesh, moment.k.X_WL[part.body] * part.X_LM,
                      has_lanes ? lane_color(part, 0) : part.color, part.scale);
    if (stage.list.instances.size() > before && !has_lanes)
      stage.list.instances.back().texture = part.texture;
  }
  const double thin = 0.004 * stage.extent.radius();
  for (const DistanceConstraintLine& tie : stage.cast.ties)
    add_rod(stage.list, moment.k.X_WL[tie.a] * tie.p_La, moment.k.X_WL[tie.b] * tie.p_Lb, thin,
            palette::kConstraint);
}

// Runs side by side: the same cast once for each, in one colour each, with its name above it.
void draw_lanes(SceneView& stage, const Snapshot& moment) {
  DrawList& list = stage.list;
  for (std::size_t i = 0; i < moment.lanes.size(); ++i) {
    const ShownVariant& lane = moment.lanes[i];
    add_label(list, lane.above_W, lane.name, {6, -14});
    list.legend.push_back({palette::lane(i), lane.name});
    if (i == 0) continue;  // has been drawn: it is the run itself
    for (const ScenePart& part : stage.cast.parts) {
      Pose X_WM = lane.X_WL[part.body] * part.X_LM;
      X_WM.p += lane.offset_W;
      add_mesh_instance(list, part.mesh, X_WM, lane_color(part, i), part.scale);
    }
    for (const DistanceConstraintLine& tie : stage.cast.ties)
      add_rod(list, lane.offset_W + lane.X_WL[tie.a] * tie.p_La,
              lane.offset_W + lane.X_WL[tie.b] * tie.p_Lb, 0.004 * stage.extent.radius(),
              palette::kConstraint);
  }
}

void widen_to(double& largest, double value) {
  if (std::isfinite(value)) largest = std::max(largest, value);
}

// "box_stack" reads better as two words.
std::string words_of(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace

void Scales::widen_contacts(const Snapshot& moment) {
  for (const PairForce& pair : pair_forces(moment)) widen_to(contact_force, pair.force.norm());
}

void Scales::widen_run(const Model<double>& model, const Snapshot& moment) {
  for (const ShownCouplingForce& pull : moment.pulls)
    widen_to(pull.kind == ShownCouplingForce::Kind::force ? force : couple, pull.pull_W.norm());
  const TotalMotion total = total_motion(model, moment.k);
  widen_to(momentum, total.linear.norm());
  widen_to(angular, total.angular.norm());
  widen_to(kinetic, moment.kinetic);
  widen_to(elastic, moment.elastic);
  if (!std::isfinite(moment.potential)) return;
  if (!has_moment) lowest_potential = highest_potential = moment.potential;
  lowest_potential = std::min(lowest_potential, moment.potential);
  widen_to(highest_potential, moment.potential);
  has_moment = true;
}

void Scales::widen(const Scales& other) {
  for (double Scales::*most :
       {&Scales::contact_force, &Scales::force, &Scales::couple, &Scales::momentum,
        &Scales::angular, &Scales::kinetic, &Scales::elastic})
    widen_to(this->*most, other.*most);
  if (!other.has_moment) return;
  lowest_potential =
      has_moment ? std::min(lowest_potential, other.lowest_potential) : other.lowest_potential;
  highest_potential =
      has_moment ? std::max(highest_potential, other.highest_potential) : other.highest_potential;
  has_moment = true;
}

double Scales::metres_per(double largest) const {
  return largest > 0 ? round_down(0.4 * length / largest) : 0;
}

SceneView make_stage(const SceneModel& scene) {
  SceneView stage;
  stage.model = &scene.model;
  stage.scene = &scene;
  stage.cast = cast_of(scene, stage.list);
  stage.name = words_of(scene.description.file.stem().string());
  return stage;
}

SceneView make_stage(const RobotDescription& robot, const Model<double>& model) {
  SceneView stage;
  stage.model = &model;
  stage.cast = cast_of(robot, model, stage.list);
  stage.name = words_of(robot.name);
  return stage;
}

void look_at(SceneView& stage, const Snapshot& moment) {
  stage.instants.emplace_back().add(stage.cast, moment);
  stage.has_hand = stage.has_hand || !moment.hands.empty();
}

void look_ahead(SceneView& stage, const Snapshot& moment) {
  look_at(stage, moment);
  stage.trace.t.push_back(moment.x.t);
  std::vector<Vector3> places(stage.model->parent.size(), Vector3::Zero());
  for (std::size_t i = 1; i < places.size(); ++i) places[i] = com_of(*stage.model, moment.k, i);
  stage.trace.p_Wc.push_back(std::move(places));
}

void settle(SceneView& stage) {
  stage.farthest = max_of_interest(stage.instants);
  double beyond = 0;
  for (const Extent& instant : stage.instants) {
    const double reach = instant.reach(stage.instants.front().center());
    if (reach > stage.farthest)
      beyond = std::max(beyond, reach);
    else
      stage.extent.add(instant);
  }
  if (beyond > 0)
    stage.cast.notes.push_back(
        fmt::format("bodies fly up to {:.3g} m away in the run: the camera does not go so far, "
                    "unless --camera gives a distance",
                    beyond));
}

void measure(SceneView& stage, const Snapshot& moment, Measured measured) {
  Extent instant;
  instant.add(stage.cast, moment);
  if (instant.reach(stage.instants.front().center()) > stage.farthest) return;
  stage.scales.widen_run(*stage.model, moment);
  if (measured == Measured::of_picture) stage.scales.widen_contacts(moment);
}

void set_view(SceneView& stage, const CameraWish& wish, double aspect) {
  stage.scales.length = stage.extent.radius();
  Ground& ground = stage.list.ground;
  const bool has_slope = std::ranges::any_of(
      stage.cast.planes, [](const ScenePlane& plane) { return !is_level(plane); });
  const double radius = stage.extent.radius();
  ground.cell = round_down(0.3 * radius);
  const double lead = ground.cell / std::pow(10.0, std::floor(std::log10(1.001 * ground.cell)));
  ground.cells_per_major = lead > 4 ? 2 : 5;
  if (const auto height = level_floor(stage)) {
    ground.height = *height;
  } else if (has_slope) {
    ground.visible = false;
  } else {
    // None that anything touches: at 0, where robots stand, or under what reaches lower. Never
    // through a body: a face in its plane would show it in stripes.
    const double lowest = stage.extent.empty() ? 0 : stage.extent.low().z();
    const bool stands = lowest > -0.02 * radius && lowest < 2 * radius;
    ground.height = stands ? std::min(lowest, 0.0) : lowest - 0.05 * radius;
    stage.cast.notes.push_back(
        "the scene has no floor: the one in the picture is only drawn, nothing touches it");
  }
  if (stage.has_hand) place_device(stage);
  stage.list.camera = make_camera(wish, stage.extent, aspect);
}

Vector3 device_shoulder() {
  const OmniParameters omni;
  return {0, omni.lift, -omni.back};
}

void place_device(SceneView& stage) {
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

void draw_bodies(SceneView& stage, const Snapshot& moment) {
  stage.list.clear_frame();
  draw_planes(stage, moment);
  draw_first_variant(stage, moment);
  draw_lanes(stage, moment);
}

}  // namespace twinarm
