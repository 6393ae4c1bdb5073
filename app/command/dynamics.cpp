#include <fmt/format.h>

#include "app/command/command.h"
#include "app/data/tables.h"
#include "app/robot/dynamics.h"
#include "app/robot/robot_input.h"
#include "app/robot/robot_output.h"
#include "app/support/files.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr Eigen::Index kMaxPrintedColumns = 12;  // wider mass matrices are in the JSON only

std::string xyz(const Vector3& v) {
  return fmt::format("({}, {}, {})", cell(v.x()), cell(v.y()), cell(v.z()));
}

// One row per coordinate; a quaternion's x, y, z are in the rows of the angular velocity.
std::string joint_table(const RobotInput& input, const Dynamics& d) {
  const JointUnits units(input.coordinates);
  TextTable table({"joint", "q [" + units.q + "]", "qd [" + units.qd + "]",
                   "given tau [" + units.tau + "]", "qdd [" + units.qdd + "]",
                   "given qdd [" + units.qdd + "]", "tau [" + units.tau + "]",
                   "bias [" + units.tau + "]", "gravity [" + units.tau + "]"});
  for (const NamedJoint& joint : input.coordinates.all()) {
    const std::vector<double> q = coordinates_of(joint, input.state.x);
    const std::vector<double> qd = from_solver(joint, input.state.x, input.state.x.qd);
    for (const JointComponent& c : joint.components()) {
      std::vector<std::string> row{component_name(input.coordinates, joint, c),
                                   cell(q[static_cast<std::size_t>(c.q)])};
      if (c.v >= 0) {
        const auto r = static_cast<Eigen::Index>(joint.row) + c.v;
        row.push_back(cell(qd[static_cast<std::size_t>(c.v)]));
        for (const Eigen::VectorXd* rows :
             {&input.state.tau, &d.qdd, &input.state.qdd, &d.tau_inverse, &d.bias, &d.gravity})
          row.push_back(cell((*rows)[r]));
      }
      table.add(std::move(row));
    }
  }
  return table.str();
}

std::string link_table(const RobotInput& input) {
  const Kinematics k = kinematics_at(input.model, input.state.x);
  TextTable table({"link", "x [m]", "y [m]", "z [m]", "vx [m/s]", "vy [m/s]", "vz [m/s]",
                   "wx [rad/s]", "wy [rad/s]", "wz [rad/s]"});
  for (std::size_t i = 1; i < input.model.parent.size(); ++i) {
    std::vector<std::string> row{input.model.body_name[i]};
    for (const Vector3* v : {&k.X_WL[i].p, &k.v_WLo[i], &k.w_WL[i]})
      for (const double number : *v) row.push_back(cell(number));
    table.add(std::move(row));
  }
  return table.str();
}

void write_dynamics(JsonWriter& json, const Coordinates& coordinates, const Dynamics& d) {
  const bool floats = coordinates.floating();
  const Vector3 still = Vector3::Zero();
  write_by_joint(json.key("qdd"), coordinates, d.qdd);
  json.key("base_acceleration")
      .object({{"linear", floats ? Vector3(d.qdd.head<3>()) : still},
               {"angular", floats ? Vector3(d.qdd.segment<3>(3)) : still}});
  write_by_joint(json.key("tau_inverse"), coordinates, d.tau_inverse);
  json.key("base_wrench").object({{"force", d.base_force}, {"torque", d.base_torque}});
  json.members({{"mass_matrix", d.mass_matrix},
                {"bias", d.bias},
                {"gravity", d.gravity},
                {"kinetic_energy", d.kinetic_energy},
                {"potential_energy", d.potential_energy},
                {"mass", d.mass},
                {"com", d.com},
                {"linear_momentum", d.linear_momentum},
                {"angular_momentum", d.angular_momentum}});
}

// `d` null: the kinematics alone.
std::string dynamics_json(const RobotInput& input, const Dynamics* d) {
  return answer_text([&](JsonWriter& json) {
    json.put("joints", input.coordinates.names());
    if (d) write_dynamics(json, input.coordinates, *d);
    write_links(json.key("links"), input.model, kinematics_at(input.model, input.state.x));
    json.put("warnings", input.warnings);
  });
}

std::string dynamics_table(const RobotInput& input, const Dynamics& d) {
  const auto& g = input.model.gravity;
  std::string text =
      fmt::format("{}: {} links, {} degrees of freedom, {}; gravity {} m/s^2\n\n", input.robot.name,
                  input.robot.links.size(), d.bias.size(),
                  input.coordinates.floating() ? "floating (base in world axes)" : "fixed base",
                  xyz({g.x, g.y, g.z}));
  text += joint_table(input, d) + "\n";
  if (d.mass_matrix.rows() > 0 && d.mass_matrix.rows() <= kMaxPrintedColumns)
    text += matrix_table("mass matrix [SI]", row_names(input.coordinates), d.mass_matrix) + "\n";
  text += link_table(input) + "\n";
  text += fmt::format(
      "mass {} kg, centre of mass {} m\n"
      "kinetic energy {} J, potential energy {} J (0 at the world's origin)\n"
      "momentum {} N s, angular momentum {} N m s about the world's origin\n"
      "wrench on the root link (inverse dynamics): force {} N, torque {} N m about its origin\n",
      cell(d.mass), xyz(d.com), cell(d.kinetic_energy), cell(d.potential_energy),
      xyz(d.linear_momentum), xyz(d.angular_momentum), xyz(d.base_force), xyz(d.base_torque));
  return text;
}

struct DynamicsOptions {
  RobotOptions robot;
  bool json = false;
};

void add_options(const OptionAdder& add, DynamicsOptions& options) {
  add.robot(options.robot, "robot (URDF)");
  add.group("Output");
  add("--kinematics", options.robot.kinematic,
      "print only positions and velocities of the links; the robot needs no masses");
  add.json(options.json);
}

// The largest input, with its name: the usual cause of overflow.
std::string max_input(const RobotInput& input) {
  std::string name = "gravity";
  double max = to_eigen(input.model.gravity).lpNorm<Eigen::Infinity>();
  const auto look = [&](const std::string& of, double value) {
    if (std::abs(value) > max) max = std::abs(value), name = of;
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
  return name + ", " + short_number_text(max);
}

// Throws if a result is not finite.
void check_finite(const std::string& file, const RobotInput& input, const Dynamics& d) {
  std::string names;
  for (const auto& [name, is_finite] : {std::pair{"qdd", d.qdd.allFinite()},
                                        {"tau_inverse", d.tau_inverse.allFinite()},
                                        {"base_wrench", (d.base_force + d.base_torque).allFinite()},
                                        {"mass_matrix", d.mass_matrix.allFinite()},
                                        {"bias", d.bias.allFinite()},
                                        {"gravity", d.gravity.allFinite()},
                                        {"kinetic_energy", std::isfinite(d.kinetic_energy)},
                                        {"potential_energy", std::isfinite(d.potential_energy)},
                                        {"com", d.com.allFinite()},
                                        {"linear_momentum", d.linear_momentum.allFinite()},
                                        {"angular_momentum", d.angular_momentum.allFinite()}})
    if (!is_finite) names += (names.empty() ? "" : ", ") + std::string(name);
  if (names.empty()) return;
  const std::string first = d.first_bad.empty() ? "" : "; the first is " + d.first_bad;
  throw InputError({{file, 0, "", "not finite in this state: " + names + first,
                     "the largest input is " + max_input(input) +
                         ": give numbers whose squares and products stay below 1e308",
                     "state.not-finite"}});
}

int run_dynamics(const DynamicsOptions& options) {
  RobotInput input = read_robot_input(options.robot);
  if (input.model.nv > kMaxDense)
    input.warnings.push_back(
        fmt::format("the mass matrix is left out: it has {} rows, more than {}",
                    input.coordinates.rows(), kMaxDense));
  print_warnings(input.warnings, options.json);
  if (options.robot.kinematic) {
    fmt::print("{}", options.json ? dynamics_json(input, nullptr) + "\n" : link_table(input));
    return 0;
  }
  const Dynamics dynamics = compute_dynamics(input);
  check_finite(options.robot.model.string(), input, dynamics);
  fmt::print("{}\n",
             options.json ? dynamics_json(input, &dynamics) : dynamics_table(input, dynamics));
  return 0;
}

}  // namespace

Command dynamics_command() {
  return {20, "dynamics",
          "Compute forward and inverse dynamics, mass matrix and energies of a robot in a state\n\n"
          "Examples:\n"
          "  twinarm dynamics assets/robots/puma560/puma560.urdf\n"
          "  twinarm dynamics assets/robots/puma560/puma560.urdf --state "
          "assets/states/puma_qn.json",
          add_options, run_dynamics};
}

}  // namespace twinarm
