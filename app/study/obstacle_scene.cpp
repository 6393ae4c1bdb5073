#include "app/study/obstacle_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "collision/import/robot/mesh_geometry.h"

namespace twinarm {
namespace {

const Color kGhost{0.25f, 0.50f, 0.95f, 0.30f};
const Color kSpring{0.86f, 0.62f, 0.10f, 1.0f};
const Color kCouple{0.80f, 0.16f, 0.14f, 1.0f};
const Color kObstacle{0.36f, 0.52f, 0.42f, 1.0f};

}  // namespace

RobotScene::RobotScene(const RobotDescription& description, const Model<double>& model) {
  for (const LinkDescription& link : description.links)
    for (const VisualPart& visual : link.visuals) {
      const auto* mesh = std::get_if<MeshGeometry>(&visual.geometry);
      if (!mesh) continue;
      const Eigen::Vector4f c = visual.color.cast<float>();
      parts_.push_back({static_cast<std::size_t>(model.find_body(link.name)),
                        list_.register_mesh(load_mesh(*mesh)),
                        visual.X_LG(),
                        {c(0), c(1), c(2), c(3)}});
    }
  list_.ground.cell = 0.1;
  look(-52, 22, 2.35, {0.24, 0, 0.42});
}

void RobotScene::add_robot(const Kinematics& k) {
  for (const Part& part : parts_)
    add_mesh_instance(list_, part.mesh, k.X_WL[part.body] * part.X_LG, part.color);
  list_.legend.push_back({{0.90f, 0.86f, 0.74f, 1.0f}, "DVR: dynamic robot, has mass, collides"});
}

void RobotScene::add_ghost(const Kinematics& k) {
  for (const Part& part : parts_)
    if (part.body > 1)  // the base is the same in both
      add_mesh_instance(list_, part.mesh, k.X_WL[part.body] * part.X_LG, kGhost);
  list_.legend.push_back({{0.45f, 0.62f, 0.95f, 1.0f}, "KVR: kinematic robot, moved by the hand"});
}

void RobotScene::add_springs(const std::vector<SpringReading>& readings, const std::string& unit) {
  for (const SpringReading& reading : readings) {
    add_spring(list_, reading.p_D, reading.p_K, 0.012, kSpring);
    add_sphere(list_, reading.p_D, 0.014, kSpring);
    add_sphere(list_, reading.p_K, 0.014, {0.25f, 0.50f, 0.95f, 1.0f});
    add_label(list_, 0.5 * (reading.p_D + reading.p_K),
              fmt::format("{:.0f} {}", reading.size, unit), {24, -40});
  }
  list_.legend.push_back({kSpring, "spring-damper between the added masses"});
}

void RobotScene::add_couples(const std::vector<SpringReading>& readings) {
  constexpr double kMetresPerNewtonMetre = 0.002;
  const Vector3 above(0, 0, 0.40);  // the joint, clear of the arm [m]
  for (const SpringReading& reading : readings) {
    // The whole arrow stands above the joint, whichever way it points.
    const Vector3 arrow = kMetresPerNewtonMetre * reading.pull;
    const Vector3 low = reading.p_D + above, from = arrow.z() < 0 ? Vector3(low - arrow) : low;
    add_arrow(list_, from, from + arrow, 0.008, kCouple);
    add_label(list_, low, fmt::format("{:.0f} N m", reading.pull.z()), {24, -10});
  }
  list_.legend.push_back({kCouple, "couple of the torsional spring-damper on the link"});
}

void RobotScene::add_obstacle(const Pose& X_WB, const Vector3& size) {
  add_box(list_, X_WB, size, kObstacle);
  list_.legend.push_back({kObstacle, "obstacle"});
}

void RobotScene::look(double azimuth_deg, double elevation_deg, double distance,
                      const Vector3& target) {
  constexpr double degree = std::numbers::pi / 180;
  const double a = azimuth_deg * degree, e = elevation_deg * degree;
  list_.camera.target = target;
  list_.camera.eye = target + distance * Vector3(std::cos(e) * std::cos(a),
                                                 std::cos(e) * std::sin(a), std::sin(e));
}

}  // namespace twinarm
