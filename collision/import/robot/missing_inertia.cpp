#include "collision/import/robot/missing_inertia.h"

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

void set(LinkDescription& link, const MassProperties& solid) {
  link.has_inertia = true;
  link.mass = solid.mass;
  link.com = solid.com;
  link.inertia = 0.5 * (solid.inertia + solid.inertia.transpose());
}

void add_from_shapes(LinkDescription& link, double density) {
  std::vector<MassProperties> solids;
  if (link.collisions.empty())
    add_solids(link.visuals, density, solids);
  else
    add_solids(link.collisions, density, solids);
  if (!solids.empty()) set(link, combine(solids));
}

MassProperties ball(double mass) {
  constexpr double kWater = 1000;  // [kg/m^3]
  const double r = std::cbrt(3 * mass / (4 * std::numbers::pi * kWater));
  const double I = 0.4 * mass * r * r;
  return centred_solid(mass, I, I, I);
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
    if (link.mass != 0 || !link.inertia.isZero(0)) continue;
    if (missing.density) try {
        add_from_shapes(link, *missing.density);
      } catch (const InputError& error) {
        const Diagnostic& fault = error.faults().front();
        faults.add({robot.file.string(), link.line, "link '" + link.name + "', --density",
                    fault.problem, fault.fix, fault.code});
      }
    if (missing.min_mass && link.mass == 0) set(link, ball(*missing.min_mass));
  }
  faults.check();
  // Of joints that still move no inertia the model's builder reports an error.
  if (missing.density || missing.min_mass)
    std::erase_if(robot.warnings, [](const Diagnostic& d) { return d.code == "robot.no-mass"; });
}

}  // namespace twinarm
