// `twinarm dynamics`.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <cmath>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/inspect/report/dynamics_output.h"
#include "app/robot/robot_input.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

struct DynamicsOptions {
  RobotOptions robot;
  bool json = false;
};

void add_options(CLI::App& command, DynamicsOptions& options) {
  add_robot_options(command, options.robot, "the robot's URDF");
  add_json_option(command, options.json);
}

// The number of the state that is furthest from 1: where results overflow it mostly is behind it.
std::string largest_input(const RobotInput& input) {
  std::string name = "gravity";
  double largest = to_eigen(input.model.gravity).lpNorm<Eigen::Infinity>();
  const auto look = [&](const std::string& of, double value) {
    if (std::abs(value) > largest) largest = std::abs(value), name = of;
  };
  for (const NamedJoint& joint : input.coordinates.all()) {
    const std::string of = joint.name.empty() ? " of the base" : " of joint '" + joint.name + "'";
    for (const double q : coordinates_of(joint, input.state.x)) look("q" + of, q);
    for (const double qd : from_solver(joint, input.state.x, input.state.x.qd)) look("qd" + of, qd);
    for (std::size_t c = 0; c < joint.nv; ++c) {
      const auto row = static_cast<Eigen::Index>(joint.row + c);
      look("tau" + of, input.state.tau[row]);
      look("qdd" + of, input.state.qdd[row]);
    }
  }
  return name + ", " + short_number_text(largest);
}

// No result is printed that is not a number.
void check_finite(const std::string& file, const RobotInput& input, const Dynamics& d) {
  std::string names;
  const auto look = [&](const char* name, const auto& values) {
    if (!values.array().isFinite().all()) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  const auto one = [](double value) { return Eigen::Matrix<double, 1, 1>(value); };
  look("qdd", d.qdd);
  look("tau_inverse", d.tau_inverse);
  look("base_wrench", d.base_force + d.base_torque);
  look("mass_matrix", d.mass_matrix);
  look("bias", d.bias);
  look("gravity", d.gravity);
  look("kinetic_energy", one(d.kinetic_energy));
  look("potential_energy", one(d.potential_energy));
  look("com", d.com);
  look("linear_momentum", d.linear_momentum);
  look("angular_momentum", d.angular_momentum);
  if (names.empty()) return;
  const std::string first = d.first_bad.empty() ? "" : "; the first is " + d.first_bad;
  throw InputError({{file, 0, "", "not finite in this state: " + names + first,
                     "the largest number that was given is " + largest_input(input) +
                         ": give numbers whose squares and products stay below 1e308",
                     "state.not-finite"}});
}

int run_dynamics(const DynamicsOptions& options) {
  const RobotInput input = read_robot_input(options.robot);
  const Dynamics dynamics = compute_dynamics(input);
  check_finite(options.robot.model.string(), input, dynamics);
  fmt::print("{}\n",
             options.json ? dynamics_json(input, dynamics) : dynamics_table(input, dynamics));
  return 0;
}

}  // namespace

Command dynamics_command() {
  return {20, "dynamics",
          "Forward and inverse dynamics, mass matrix, energies of a robot in one state\n\n"
          "Example:  twinarm dynamics assets/robots/puma560/puma560.urdf --state "
          "assets/states/puma_qn.json",
          add_options, run_dynamics};
}

}  // namespace twinarm
