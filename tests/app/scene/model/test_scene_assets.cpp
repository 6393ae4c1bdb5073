// The committed scenes: each can be read and built, starts finite, as its comments say.
#include <algorithm>
#include <cmath>

#include "app/scene/model/scene_model.h"
#include "collision/detection/collision_world.h"
#include "solver/dynamics/dynamics.h"
#include "solver/stepping/simulation.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

const fs::path kScenes = fs::path(TWINARM_SOURCE_DIR) / "assets" / "scenes";

std::vector<fs::path> all_scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kScenes))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool is_known_to_contacts(const ShapeDescription& shape) {
  try {
    collision_shape(shape);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST_CASE("scenes: every committed scene reads, builds and steps once with finite numbers") {
  const auto files = all_scenes();
  CHECK(files.size() >= 12);
  for (const fs::path& file : files) {
    INFO(file.string());
    const SceneModel scene = build_scene(read_scene(file));
    for (const std::string& warning : scene.description.warnings)  // its published numbers
      CHECK(warning.find("puma560.urdf:") != std::string::npos);
    CHECK(scene.description.duration);
    Simulation simulation(scene.model, scene.start);
    for (const SceneMotion& motion : scene.motions) simulation.prescribe(motion.body, motion.law);
    const StepReport report = simulation.step(scene.description.step);
    CHECK(report.finite);
    for (const double q : simulation.state().q) CHECK(std::isfinite(q));
  }
}

TEST_CASE("scenes: initial penetration is at most 2 mm") {
  for (const fs::path& file : all_scenes()) {
    INFO(file.string());
    const SceneModel scene = build_scene(read_scene(file));
    Kinematics k(scene.model);
    forward_kinematics(scene.model, scene.start, k);
    CollisionWorld world;
    std::vector<Pose> X_WG;
    std::vector<int> known;  // geometries whose shape contacts know
    for (std::size_t g = 0; g < scene.geometries.size(); ++g) {
      const SceneGeometry& geometry = scene.geometries[g];
      if (!is_known_to_contacts(geometry.shape)) continue;
      known.push_back(static_cast<int>(g));
      const int half = std::holds_alternative<HalfSpace>(geometry.shape) ? 1 : 0;
      world.add({geometry.name, collision_shape(geometry.shape), half});
      X_WG.push_back(k.X_WL[static_cast<std::size_t>(geometry.body)] * geometry.X_LG);
    }
    world.set_pair_filter([&](int a, int b) {
      return scene.is_apart(known[static_cast<std::size_t>(a)], known[static_cast<std::size_t>(b)]);
    });
    std::vector<Contact> contacts;
    world.detect(X_WG, 0, contacts);
    for (const Contact& contact : contacts) {
      INFO(world.geometry(contact.a).name << " and " << world.geometry(contact.b).name);
      CHECK(contact.depth < 0.002);
    }
  }
}

TEST_CASE("scenes: initial velocities satisfy the constraints") {
  for (const fs::path& file : all_scenes()) {
    INFO(file.string());
    const SceneModel scene = build_scene(read_scene(file));
    Kinematics k(scene.model);
    forward_kinematics(scene.model, scene.start, k);
    for (const SceneConstraint& c : scene.constraints) {
      INFO(c.name);
      if (c.type == SceneConstraint::Type::gear) continue;
      const Vector3 p_A = k.position(c.a, c.X_AC.p), p_B = k.position(c.b, c.X_BC.p);
      const Vector3 slip = k.velocity(c.b, p_B) - k.velocity(c.a, p_A);
      const Vector3 turn =
          k.w_WL[static_cast<std::size_t>(c.b)] - k.w_WL[static_cast<std::size_t>(c.a)];
      if (c.type == SceneConstraint::Type::distance) {
        CHECK(std::abs(slip.dot(p_B - p_A)) < 1e-12);
        continue;
      }
      CHECK(slip.norm() < 1e-12);
      const Vector3 axis = k.X_WL[static_cast<std::size_t>(c.a)].R * c.X_AC.R.col(2);
      if (c.type == SceneConstraint::Type::hinge) CHECK(axis.cross(turn).norm() < 1e-12);
      if (c.type == SceneConstraint::Type::weld) CHECK(turn.norm() < 1e-12);
    }
  }
}

// The lowest point of a body on the plane z = 0, relative to its origin, world axes.
Vector3 lowest_point(const ShapeDescription& shape, const Matrix3& R) {
  const Vector3 down = R.transpose() * -Vector3::UnitZ();
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
    const Vector3 scaled = ellipsoid->semi_axes.cwiseProduct(down);
    return R * ellipsoid->semi_axes.cwiseProduct(scaled) / scaled.norm();
  }
  return R * support(collision_shape(shape), down);
}

TEST_CASE("scenes: coin, rattleback and the ball on the turntable start rolling on z = 0") {
  struct Case {
    const char *scene, *body, *ground;
    double slip;  // [m/s]; of the coin: w times half its thickness
  };
  for (const Case& c :
       {Case{"spinning_coin", "coin", "", 1.4e-4}, Case{"rattleback", "stone", "", 1e-12},
        Case{"turntable", "ball", "table", 1e-12}}) {
    INFO(c.scene);
    const SceneModel scene = build_scene(read_scene(kScenes / (std::string(c.scene) + ".toml")));
    Kinematics k(scene.model);
    forward_kinematics(scene.model, scene.start, k);
    const int body = scene.model.find_body(c.body);
    const auto i = static_cast<std::size_t>(body);
    const auto shape = std::find_if(scene.geometries.begin(), scene.geometries.end(),
                                    [&](const SceneGeometry& g) { return g.body == body; });
    const Vector3 p_WC = k.X_WL[i].p + lowest_point(shape->shape, k.X_WL[i].R);
    CHECK(std::abs(p_WC.z()) < 1e-12);
    const int ground = *c.ground ? scene.model.find_body(c.ground) : 0;
    CHECK((k.velocity(body, p_WC) - k.velocity(ground, p_WC)).norm() < c.slip);
  }
}

}  // namespace
}  // namespace twinarm
