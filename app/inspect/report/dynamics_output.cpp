#include "app/inspect/report/dynamics_output.h"

#include <fmt/format.h>

#include "app/data/tables.h"
#include "app/robot/robot_output.h"

namespace twinarm {
namespace {

constexpr Eigen::Index kWidestMatrix = 12;  // wider ones are for machines

std::string xyz(const Vector3& v) {
  return fmt::format("({}, {}, {})", cell(v.x()), cell(v.y()), cell(v.z()));
}

// A row for each number of a joint; those of a quaternion stand beside the rates about its axes.
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
  Kinematics k(input.model);
  forward_kinematics(input.model, input.state.x, k);
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

std::string matrix_table(const Coordinates& coordinates, const Eigen::MatrixXd& M) {
  const std::vector<std::string> names = row_names(coordinates);
  std::vector<std::string> headings{"mass matrix [SI]"};
  headings.insert(headings.end(), names.begin(), names.end());
  TextTable table(std::move(headings));
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    std::vector<std::string> row{names[static_cast<std::size_t>(i)]};
    for (Eigen::Index j = 0; j < M.cols(); ++j) row.push_back(cell(M(i, j)));
    table.add(std::move(row));
  }
  return table.str();
}

}  // namespace

std::string dynamics_json(const RobotInput& input, const Dynamics& d) {
  const Coordinates& coordinates = input.coordinates;
  Kinematics k(input.model);
  forward_kinematics(input.model, input.state.x, k);
  const bool floats = coordinates.floating();
  const Vector3 still = Vector3::Zero();

  return json_text([&](JsonWriter& json) {
    json.put("joints", coordinates.names());
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
    write_links(json.key("links"), input.model, k);
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
  if (d.mass_matrix.rows() > 0 && d.mass_matrix.rows() <= kWidestMatrix)
    text += matrix_table(input.coordinates, d.mass_matrix) + "\n";
  text += link_table(input) + "\n";
  text += fmt::format(
      "mass {} kg, centre of mass {} m\n"
      "kinetic energy {} J, potential energy {} J (0 at the world's origin)\n"
      "momentum {} N s, angular momentum {} N m s about the world's origin\n"
      "on the root link, for the inverse's qdd: force {} N, torque {} N m about its origin\n",
      cell(d.mass), xyz(d.com), cell(d.kinetic_energy), cell(d.potential_energy),
      xyz(d.linear_momentum), xyz(d.angular_momentum), xyz(d.base_force), xyz(d.base_torque));
  for (const std::string& warning : input.warnings) text += "\nwarning: " + warning;
  return text;
}

}  // namespace twinarm
