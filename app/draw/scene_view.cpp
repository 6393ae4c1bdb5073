#include "app/draw/scene_view.h"

#include <fmt/format.h>

#include "app/draw/palette.h"
#include "coupling/device/omni.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

bool is_level(const ScenePlane& plane) {
  return plane.body == 0 && plane.normal_L.z() > 1 - 1e-9;
}

// Height of the highest level floor of the scene.
std::optional<double> level_floor(const SceneView& view) {
  std::optional<double> height;
  for (const ScenePlane& plane : view.cast.planes)
    if (is_level(plane)) height = std::max(height.value_or(-1e300), plane.offset);
  return height;
}

void draw_planes(SceneView& view, const Snapshot& snapshot) {
  const double reach = 3.2 * view.extent.radius(), thick = 0.02 * view.extent.radius();
  const Vector3 center = view.extent.empty() ? Vector3(Vector3::Zero()) : view.extent.center();
  for (const ScenePlane& plane : view.cast.planes) {
    if (is_level(plane)) continue;  // drawn as the ground
    const Pose& X_WL = snapshot.k.X_WL[plane.body];
    const Vector3 n = X_WL.R * plane.normal_L;
    const double offset = plane.offset + n.dot(X_WL.p);
    const Vector3 middle = center - (n.dot(center) - offset) * n;
    const OfBody mark(view.list, plane.body);
    add_box(view.list, {rotation_taking_z_to(n), middle - 0.5 * thick * n}, {reach, reach, thick},
            plane.color);
  }
}

// Fixed obstacles have the same colour in all variants.
Color variant_color(const ScenePart& part, std::size_t lane) {
  if (part.body == 0 && part.robot < 0) return part.color;
  Color color = palette::lane(lane);
  color.a = part.color.a;
  return color;
}

void draw_lines(SceneView& view, const std::vector<Pose>& X_WL, const Vector3& offset_W) {
  for (const TieLine& line : view.cast.ties) {
    const Vector3 a_W = offset_W + X_WL[line.a] * line.p_La,
                  b_W = offset_W + X_WL[line.b] * line.p_Lb;
    if (line.is_spring)
      add_spring(view.list, a_W, b_W, 0.02 * view.extent.radius(), palette::kConstraint);
    else
      add_rod(view.list, a_W, b_W, 0.004 * view.extent.radius(), palette::kConstraint);
  }
}

void draw_first_variant(SceneView& view, const Snapshot& snapshot) {
  for (const ScenePart& part : view.cast.parts) {
    const OfBody mark(view.list, part.body);
    const std::size_t before = view.list.instances.size();
    const bool has_variants = !snapshot.variants.empty();
    add_mesh_instance(view.list, part.mesh, snapshot.k.X_WL[part.body] * part.X_LM,
                      has_variants ? variant_color(part, 0) : part.color, part.scale);
    if (view.list.instances.size() > before && !has_variants)
      view.list.instances.back().texture = part.texture;
  }
  draw_lines(view, snapshot.k.X_WL, Vector3::Zero());
}

// The other variants, each in its colour; names of all.
void draw_other_variants(SceneView& view, const Snapshot& snapshot) {
  DrawList& list = view.list;
  for (std::size_t i = 0; i < snapshot.variants.size(); ++i) {
    const ShownVariant& lane = snapshot.variants[i];
    add_label(list, lane.above_W, lane.name, {6, -14});
    list.legend.push_back({palette::lane(i), lane.name});
    if (i == 0) continue;  // drawn by draw_first_variant()
    for (const ScenePart& part : view.cast.parts) {
      Pose X_WM = lane.X_WL[part.body] * part.X_LM;
      X_WM.p += lane.offset_W;
      add_mesh_instance(list, part.mesh, X_WM, variant_color(part, i), part.scale);
    }
    draw_lines(view, lane.X_WL, lane.offset_W);
  }
}

void widen_to(double& largest, double value) {
  if (std::isfinite(value)) largest = std::max(largest, value);
}

// "box_stack" -> "box stack".
std::string words_of(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace

void Scales::widen_contacts(const Snapshot& snapshot) {
  for (const PairForce& pair : pair_forces(snapshot)) widen_to(contact_force, pair.force.norm());
}

void Scales::widen_run(const Model<double>& model, const Snapshot& snapshot) {
  for (const ShownCouplingForce& coupling : snapshot.coupling_forces)
    widen_to(coupling.kind == ShownCouplingForce::Kind::force ? force : couple,
             coupling.force_W.norm());
  widen_to(momentum, total_motion(model, snapshot.k).linear.norm());
  widen_to(kinetic, snapshot.kinetic);
  widen_to(elastic, snapshot.elastic);
  if (!std::isfinite(snapshot.potential)) return;
  if (!has_potential) lowest_potential = highest_potential = snapshot.potential;
  lowest_potential = std::min(lowest_potential, snapshot.potential);
  widen_to(highest_potential, snapshot.potential);
  has_potential = true;
}

void Scales::widen(const Scales& other) {
  for (double Scales::*maximum : {&Scales::contact_force, &Scales::force, &Scales::couple,
                                  &Scales::momentum, &Scales::kinetic, &Scales::elastic})
    widen_to(this->*maximum, other.*maximum);
  if (!other.has_potential) return;
  lowest_potential =
      has_potential ? std::min(lowest_potential, other.lowest_potential) : other.lowest_potential;
  highest_potential = has_potential ? std::max(highest_potential, other.highest_potential)
                                    : other.highest_potential;
  has_potential = true;
}

SceneView make_scene_view(const SceneModel& scene) {
  SceneView view;
  view.model = &scene.model;
  view.scene = &scene;
  view.cast = make_scene_meshes(scene, view.list);
  view.name = words_of(scene.description.file.stem().string());
  return view;
}

SceneView make_scene_view(const RobotDescription& robot, const Model<double>& model) {
  SceneView view;
  view.model = &model;
  view.cast = make_scene_meshes(robot, model, view.list);
  view.name = words_of(robot.name);
  return view;
}

void look_at(SceneView& view, const Snapshot& snapshot) {
  view.instants.emplace_back().add(view.cast, snapshot);
  view.has_operator = view.has_operator || !snapshot.devices.empty();
}

void look_ahead(SceneView& view, const Snapshot& snapshot) {
  look_at(view, snapshot);
  view.trace.add(*view.model, snapshot);
}

void Trace::add(const Model<double>& model, const Snapshot& snapshot) {
  t.push_back(snapshot.x.t);
  std::vector<Vector3>& places = p_Wc.emplace_back(model.parent.size(), Vector3::Zero());
  for (std::size_t i = 1; i < places.size(); ++i) places[i] = com_of(model, snapshot.k, i);
}

void settle(SceneView& view) {
  view.farthest = max_distance_of_interest(view.instants);
  double beyond = 0;
  for (const Extent& instant : view.instants) {
    const double reach = instant.reach(view.instants.front().center());
    if (reach > view.farthest)
      beyond = std::max(beyond, reach);
    else
      view.extent.add(instant);
  }
  if (beyond > 0)
    view.cast.notes.push_back(fmt::format(
        "bodies up to {:.3g} m away are ignored for the camera's distance; give one by --camera",
        beyond));
}

void measure(SceneView& view, const Snapshot& snapshot, Measured measured) {
  Extent instant;
  instant.add(view.cast, snapshot);
  if (instant.reach(view.instants.front().center()) > view.farthest) return;
  view.scales.widen_run(*view.model, snapshot);
  if (measured == Measured::of_picture) view.scales.widen_contacts(snapshot);
}

void set_view(SceneView& view, const CameraWish& wish, double aspect) {
  view.scales.length = view.extent.radius();
  Ground& ground = view.list.ground;
  const bool has_slope = std::ranges::any_of(
      view.cast.planes, [](const ScenePlane& plane) { return !is_level(plane); });
  const double radius = view.extent.radius();
  ground.cell = round_down(0.3 * radius);
  const double lead = ground.cell / std::pow(10.0, std::floor(std::log10(1.001 * ground.cell)));
  ground.cells_per_major = lead > 4 ? 2 : 5;
  if (const auto height = level_floor(view)) {
    ground.height = *height;
  } else if (has_slope) {
    ground.visible = false;
  } else {
    // No floor in the scene: at 0 or below the lowest point, never through a body.
    const double lowest = view.extent.empty() ? 0 : view.extent.low().z();
    const bool is_near_zero = lowest > -0.02 * radius && lowest < 2 * radius;
    ground.height = is_near_zero ? std::min(lowest, 0.0) : lowest - 0.05 * radius;
    view.cast.notes.push_back(
        "the scene has no floor: the floor in the picture is only drawn, without contact");
  }
  if (view.has_operator) place_device(view);
  view.list.camera = make_camera(wish, view.extent, aspect);
}

Vector3 device_shoulder() {
  const OmniParameters omni;
  return {0, omni.lift, -omni.back};
}

void place_device(SceneView& view) {
  // Device axes: x right, y up, z to the user, who sits at the world's -y.
  Pose X_WD;
  for (int c = 0; c < 3; ++c) X_WD.R.col(c) = world_from_device(Vector3::Unit(c));
  const Vector3 foot = device_shoulder() - Vector3(0, kDeviceShoulder, 0);
  const Vector3 place(view.extent.low().x() - 0.2, view.extent.low().y(), view.list.ground.height);
  X_WD.p = place - X_WD.R * foot;
  view.X_WDevice = X_WD;
  if (!view.frames_device) return;
  for (const double x : {-0.13, 0.13})
    for (const double y : {0.0, 0.4})
      for (const double z : {-0.09, 0.3}) view.extent.add(X_WD * (foot + Vector3(x, y, z)));
}

void draw_bodies(SceneView& view, const Snapshot& snapshot) {
  view.list.clear_frame();
  draw_planes(view, snapshot);
  draw_first_variant(view, snapshot);
  draw_other_variants(view, snapshot);
}

}  // namespace twinarm
