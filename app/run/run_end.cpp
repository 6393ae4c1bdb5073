#include "app/run/run_end.h"

#include <algorithm>
#include <cmath>

#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/non_finite.h"

namespace twinarm {

double weight_of(const Model<double>& model) {
  double mass = 0;
  for (const auto& inertia : model.I) mass += inertia.m;
  return mass * to_eigen(model.gravity).norm();
}

double default_energy_bound(const Model<double>& model, const State<double>& x) {
  return RunPlan::kGrowth * std::max({1.0, kinetic_energy(model, x), weight_of(model)});
}

PostMortem examine_end(const StepReport& report, const Simulation& simulation,
                       const State<double>& last, double t, long step) {
  const Model<double>& model = simulation.mechanism().model;
  PostMortem found;
  found.kinetic_energy = kinetic_energy(model, last);
  found.time = t;
  found.step = step;
  double fastest = 0;
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + model.dofs(i); ++dof)
      if (std::abs(last.qd[dof]) > fastest) {
        fastest = std::abs(last.qd[dof]);
        found.fastest_joint = model.joint_name[i];
        found.joint = model.joint_name[i];
        found.body = model.body_name[i];
      }
  if (!report.finite && report.bad_field) {
    const auto body = static_cast<std::size_t>(report.bad_body);
    found.body = model.body_name[body];
    found.joint = model.joint_name[body];
    found.field = report.bad_field;
    found.pass =
        first_bad_quantity(model, simulation.mechanism().forces, simulation.mechanism().w).pass;
  }
  found.reason = report.finite ? "no substep however short meets the tolerance"
                               : "a number is not finite: the run diverged";
  return found;
}

}  // namespace twinarm
