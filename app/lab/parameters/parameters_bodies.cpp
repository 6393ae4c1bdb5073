// Parameters of surfaces and masses. Many bodies with the same value share one parameter.

#include "app/lab/parameters/parameter_makers.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm::parameter_makers {
namespace {

constexpr std::size_t kManyBodies = 8;

void add_surface(const SceneDescription& scene, const SurfaceKey& key,
                 std::vector<LabParameter>& parameters) {
  const auto add = [&](std::string path, const auto& owner, const std::string& group) {
    parameters.push_back(
        slider(std::move(path), key.slider, owner.surface.*key.member, key.unit, group));
  };
  for (std::size_t i = 0; i < scene.robots.size(); ++i)
    if (scene.robots[i].collide)
      add(item("robot", i, key.key), scene.robots[i], scene.robots[i].name);
  const auto& bodies = scene.bodies;
  const bool agree = std::ranges::all_of(bodies, [&](const BodyDescription& body) {
    return body.surface.*key.member == bodies[0].surface.*key.member;
  });
  if (bodies.size() > 1 && agree)
    add(std::string("body.") + key.key, bodies[0], "all bodies");
  else if (bodies.size() <= kManyBodies)
    for (std::size_t i = 0; i < bodies.size(); ++i)
      add(item("body", i, key.key), bodies[i], bodies[i].name);
}

// A factor for each link that has mass, with mass and moments of inertia of the robot's file and
// the warnings about them.
void add_link_masses(const RobotInScene& robot, const std::string& own,
                     std::vector<LabParameter>& parameters) {
  if (robot.description.links.size() > kManyLinks) return;
  for (const LinkDescription& link : robot.description.links) {
    if (!is_path_part(link.name) || !(link.mass > 0)) continue;
    const auto scale = robot.mass_scale.find(link.name);
    const Eigen::VectorXd moments = symmetric_eigenvalues(link.inertia);
    std::string meaning =
        "Factor of the link's mass and inertia; 1: " + short_number_text(link.mass) +
        " kg, principal moments of inertia " + short_number_text(moments[0]) + ", " +
        short_number_text(moments[1]) + ", " + short_number_text(moments[2]) + " kg m².";
    for (const Diagnostic& warning : robot.description.warnings)
      if (warning.where == link_called(link.name)) meaning += " Warning: " + warning.problem + ".";
    const SliderRow row{link.name.c_str(), 0.05, 20, meaning.c_str()};
    parameters.push_back(slider(own + "mass_scale." + link.name, row,
                                scale == robot.mass_scale.end() ? 1 : scale->second, "times",
                                robot.name + ": masses"));
    parameters.back().is_folded = scale == robot.mass_scale.end();
  }
}

}  // namespace

void add_surfaces(const SceneModel& model, std::vector<LabParameter>& parameters) {
  const SceneDescription& scene = model.description;
  const bool is_compliant = scene.contact == ContactMode::compliant;
  for (const SurfaceKey& key : surface_keys())
    if (key.slider.label && (is_compliant || !key.is_of_compliant))
      add_surface(scene, key, parameters);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const PairDescription& pair = scene.pairs[i];
    for (const SurfaceKey& key : surface_keys())
      if (key.slider.label && key.of_pair && !key.is_of_compliant && pair.*key.of_pair)
        parameters.push_back(slider(item("pair", i, key.key), key.slider, *(pair.*key.of_pair),
                                    key.unit, pair.a + " on " + pair.b));
  }
}

void add_masses(const SceneDescription& scene, std::vector<LabParameter>& parameters) {
  const auto put = [&](std::string path, const std::string& label, double value, const char* unit,
                       double low, double high, const std::string& group, const char* meaning) {
    parameters.push_back(
        slider(std::move(path), {label.c_str(), low, high, meaning}, value, unit, group));
  };
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    const RobotInScene& robot = scene.robots[i];
    const std::string own = "robot[" + std::to_string(i) + "].";
    for (std::size_t p = 0; p < robot.payloads.size(); ++p)
      put(own + item("payload", p, "mass"), "added mass on " + robot.payloads[p].link,
          robot.payloads[p].mass, "kg", 1e-3, 10, robot.name,
          "Particle fixed to the link: increases the inertia at the coupling.");
    add_link_masses(robot, own, parameters);
  }
  std::size_t free = 0;
  for (const BodyDescription& body : scene.bodies) free += body.is_free() && body.mass;
  if (free > kManyBodies) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyDescription& body = scene.bodies[i];
    if (body.is_free() && body.mass && !body.inertia)
      put(item("body", i, "mass"), "mass", *body.mass, "kg", 1e-2, 100, body.name,
          "Mass of the uniform solid; its inertia is proportional.");
  }
}

}  // namespace twinarm::parameter_makers
