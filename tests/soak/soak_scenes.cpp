#include "tests/soak/soak_scenes.h"

#include <filesystem>

#include "app/scene/read/read_scene.h"

namespace twinarm::soak {
namespace {

const std::filesystem::path kRoot = TWINARM_SOURCE_DIR;

SoakScene from_file(const char* name, Chance& chance) {
  SoakScene scene;
  scene.description = read_scene(kRoot / "assets" / "scenes" / (std::string(name) + ".toml"));
  const double friction = chance.uniform(0.2, 1);
  const double restitution = chance.below(2) == 0 ? 0 : chance.uniform(0, 0.8);
  for (BodyDescription& body : scene.description.bodies) {
    body.surface.friction = friction;
    body.surface.restitution = restitution;
  }
  return scene;
}

ShapeDescription some_shape(std::size_t kind, Chance& chance) {
  const auto size = [&] { return chance.uniform(0.04, 0.08); };
  switch (kind % 5) {
    case 0:
      return Sphere{size()};
    case 1:
      return Capsule{0.6 * size(), 2 * size()};
    case 2:
      return Cylinder{size(), 2 * size()};
    case 3:
      return Box{2 * Vector3(size(), size(), size())};
    default:
      return Ellipsoid{Vector3(size(), size(), size())};
  }
}

Matrix3 some_turn(Chance& chance) {
  return Eigen::AngleAxisd(chance.uniform(0, 3), chance.direction()).toRotationMatrix();
}

// 20 bodies of all kinds in a closed box of 1 m x 1 m x 1.2 m, with a step in a corner.
SoakScene mixed(Chance& chance) {
  SoakScene scene;
  scene.low = {-0.5, -0.5, 0}, scene.high = {0.5, 0.5, 1.2};
  scene.push = 3;
  const auto obstacle = [&](const std::string& name, const ShapeDescription& shape, const Pose& X) {
    BodyDescription body;
    body.name = name, body.shape = shape, body.X_WB = X, body.fixed = true;
    body.surface.friction = chance.uniform(0, 1);
    body.surface.restitution = chance.uniform(0, 1);
    scene.description.bodies.push_back(body);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 n = Vector3::Unit(axis);
    obstacle("low" + std::to_string(axis), HalfSpace{n, scene.low[axis]}, {});
    obstacle("high" + std::to_string(axis), HalfSpace{-n, -scene.high[axis]}, {});
  }
  MeshGeometry step;
  step.name = "step.obj";
  step.file = kRoot / "tests/soak/step.obj";
  step.convex = false;
  obstacle("step", step, {Matrix3::Identity(), {-0.3, -0.3, 0.001}});
  for (std::size_t b = 0; b < 20; ++b) {
    BodyDescription body;
    body.name = "body" + std::to_string(b);
    body.shape = some_shape(b, chance);
    body.density = chance.uniform(300, 3000);
    const std::size_t place = b % 9;
    body.X_WB = {
        some_turn(chance),
        {0.3 * double(place % 3) - 0.3, 0.3 * double(place / 3) - 0.3, 0.35 + 0.3 * double(b / 9)}};
    body.linear_velocity = chance.uniform(0, 3) * chance.direction();
    body.angular_velocity = chance.uniform(0, 10) * chance.direction();
    body.surface.friction = chance.uniform(0, 1.2);
    body.surface.restitution = chance.uniform(0, 1);
    if (b % 7 == 0) body.surface.rolling_friction = 0.002, body.surface.torsional_friction = 0.003;
    scene.description.bodies.push_back(body);
  }
  return scene;
}

}  // namespace

const std::vector<std::string>& scene_names() {
  static const std::vector<std::string> names{"stack", "pyramid", "arm", "mixed"};
  return names;
}

SoakScene make_scene(const std::string& name, Chance& chance) {
  if (name == "stack") return from_file("box_stack", chance);
  if (name == "pyramid") return from_file("pyramid", chance);
  if (name == "arm") return from_file("robot_beside_obstacles", chance);
  return mixed(chance);
}

}  // namespace twinarm::soak
