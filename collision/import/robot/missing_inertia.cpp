#include "collision/import/robot/missing_inertia.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/import/robot/robot_model.h"

namespace twinarm {
namespace {

template <class Part>
void add_solids(const std::vector<Part>& parts, double density, std::vector<MassProperties>& all) {
  for (const Part& part : parts) {
    const MassProperties solid = mass_properties(collision_shape(part.geometry), density);
    const Pose X = part.X_LG();
    all.push_back({solid.mass, X * solid.com, X.R * solid.inertia * X.R.transpose()});
  }
}

void add_from_shapes(LinkDescription& link, double density) {
  std::vector<MassProperties> solids;
  if (link.collisions.empty())
    add_solids(link.visuals, density, solids);
  else
    add_solids(link.collisions, density, solids);
  if (solids.empty()) return;
  MassProperties all = combine(solids);
  if (link.mass > 0)
    all = with_mass(all, link.mass);
  else
    link.com = all.com;
  link.has_inertia = true;
  link.mass = all.mass;
  link.inertia = 0.5 * (all.inertia + all.inertia.transpose());
}

void make_ball(LinkDescription& link, double min_mass) {
  constexpr double kWater = 1000;  // [kg/m^3]
  link.has_inertia = true;
  link.mass = std::max(link.mass, min_mass);
  if (!link.inertia.isZero(0)) return;
  const double r = std::cbrt(3 * link.mass / (4 * std::numbers::pi * kWater));
  link.inertia = 0.4 * link.mass * r * r * Matrix3::Identity();
}

}  // namespace

void add_missing_inertia(RobotDescription& robot, const MissingInertia& missing) {
  DiagnosticList faults;
  const auto check = [&](const char* option, const std::optional<double>& value) {
    if (value && !(*value > 0 && std::isfinite(*value)))
      faults.add(option, "must be positive and finite", "", "option.not-positive");
  };
  check("--density", missing.density);
  check("--min-mass", missing.min_mass);
  faults.check();
  for (LinkDescription& link : robot.links) {
    const auto is_complete = [&] { return link.mass > 0 && !link.inertia.isZero(0); };
    if (is_complete()) continue;
    if (missing.density) try {
        add_from_shapes(link, *missing.density);
      } catch (const InputError& error) {
        const Diagnostic& fault = error.faults().front();
        faults.add({robot.file.string(), link.line, "link '" + link.name + "', --density",
                    fault.problem, fault.fix, fault.code});
      }
    if (missing.min_mass && !is_complete()) make_ball(link, *missing.min_mass);
  }
  faults.check();
  // Of joints that still move no inertia the model's builder reports an error.
  if (missing.any())
    std::erase_if(robot.warnings, [](const Diagnostic& d) { return d.code == "robot.no-mass"; });
}

}  // namespace twinarm
