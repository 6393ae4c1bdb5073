// `twinarm modes`: small motions about a state, of a robot or of the robots of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "app/commands.h"
#include "app/dynamics/robot_table.h"
#include "app/inspect/command/sheet.h"
#include "app/inspect/linear_system.h"
#include "app/json_writer.h"
#include "app/simulate/given_forces.h"
#include "app/simulate/simulate_input.h"
#include "app/text_table.h"
#include "solver/forward_dynamics.h"
#include "solver/spring.h"

namespace twinarm {
namespace {

// Everything smooth that pushes: given torques and wrenches, dampers of joints, couplings with
// their kinematic side held still, and what keeps followers to their leaders at the state.
class Pushing {
 public:
  explicit Pushing(SimulateInput& input)
      : input_(input),
        model_(input.robot.model),
        torques_(model_, input.robot.coordinates, input.robot.state.tau),
        mimic_(model_.nv) {
    Kinematics k(model_);
    forward_kinematics(model_, input.robot.state.x, k);
    for (const Wrench& wrench : input.robot.state.wrenches) wrenches_.emplace_back(wrench, k);
    Forces<double> forces(model_);
    push(input.robot.state.x, k, forces);
    ForwardDynamics dynamics(model_);
    dynamics.set_friction(false);
    Workspace<double> w(model_);
    dynamics(input.robot.state.x, forces, w);
    if (!model_.mimics.empty()) mimic_ = dynamics.mimic_force();
  }

  void push(const State<double>& x, const Kinematics& k, Forces<double>& forces) {
    torques_.add_forces(x, k, forces);
    for (GivenWrench& wrench : wrenches_) wrench.add_forces(x, k, forces);
    for (std::size_t dof = 0; dof < model_.nv; ++dof)
      forces.tau[dof] += mimic_[dof] - model_.damping[dof] * x.qd[dof];
    if (!input_.couplings) return;
    for (std::size_t c = 0; c < input_.couplings->size(); ++c) add_coupling(c, x, k, forces);
  }

 private:
  void add_coupling(std::size_t c, const State<double>& x, const Kinematics& k,
                    Forces<double>& forces) {
    const SceneCoupling& spec = input_.couplings->spec(c);
    const CouplingEnds ends = input_.couplings->ends(c, x, k);
    const Vector3 pull = spec.spring.k * ends.offset - spec.spring.b * ends.velocity;
    const int body = spec.spring.body;
    if (spec.type == CouplingDescription::Type::linear)
      add_point_force(k, body, k.position(body, spec.spring.p_L), pull, forces);
    else if (spec.measure == Measure::world)
      add_couple(k, body, pull, forces);
    else
      forces.tau[model_.iv[static_cast<std::size_t>(body)]] += pull.x();
  }

  SimulateInput& input_;
  const Model<double>& model_;
  GivenTorques torques_;
  std::vector<GivenWrench> wrenches_;
  std::vector<double> mimic_;
};

struct Found {
  LinearSystem system;
  std::vector<Mode> modes;
  std::vector<std::string> names;  // of the rows of dq
  std::vector<std::string> warnings;
};

// The mode's part of a joint's velocities, as the command line has them.
Eigen::VectorXd shape_of(const RobotInput& input, const LinearSystem& system,
                         const Eigen::VectorXd& by_dof) {
  std::vector<double> full(input.model.nv);
  for (std::size_t r = 0; r < system.dofs.size(); ++r)
    full[system.dofs[r]] = by_dof[static_cast<Eigen::Index>(r)];
  Eigen::VectorXd rows(input.coordinates.rows());
  for (const NamedJoint& joint : input.coordinates.all()) {
    const std::vector<double> values = from_solver(joint, input.state.x, full);
    for (std::size_t k = 0; k < joint.nv; ++k)
      rows[static_cast<Eigen::Index>(joint.row + k)] = values[k];
  }
  return rows;
}

std::vector<std::string> warnings_of(const SimulateInput& input) {
  std::vector<std::string> warnings = input.robot.warnings;
  const Model<double>& model = input.robot.model;
  const auto is_positive = [](double limit) { return limit > 0; };
  if (std::any_of(model.coulomb_plus.begin(), model.coulomb_plus.end(), is_positive) ||
      std::any_of(model.coulomb_minus.begin(), model.coulomb_minus.end(), is_positive))
    warnings.emplace_back("Coulomb friction of joints has no linear part: it is left out");
  if (input.scene && input.scene->may_touch())
    warnings.emplace_back("contacts are left out, and free bodies with them");
  return warnings;
}

void write_shape(JsonWriter& json, const RobotInput& input, const Eigen::VectorXd& rows) {
  json.begin_object();
  for (const NamedJoint& joint : input.coordinates.all()) {
    const bool is_base = input.coordinates.floating() && &joint == &input.coordinates.base();
    const double* first = rows.data() + joint.row;
    json.key(is_base ? "base" : joint.name).number_or_list({first, first + joint.nv});
  }
  json.end_object();
}

std::string modes_json(const RobotInput& input, const Found& found) {
  JsonWriter json;
  json.begin_object();
  json.key("modes").begin_array();
  for (const Mode& mode : found.modes) {
    json.begin_object();
    json.key("frequency").number(mode.frequency());
    json.key("damping_ratio").number(mode.damping_ratio());
    json.key("eigenvalue").numbers({mode.eigenvalue.real(), mode.eigenvalue.imag()});
    write_shape(json.key("shape"), input, shape_of(input, found.system, mode.shape.real()));
    write_shape(json.key("shape_imaginary"), input,
                shape_of(input, found.system, mode.shape.imag()));
    json.end_object();
  }
  json.end_array();
  json.key("rows").texts(found.names);
  json.key("A").matrix(found.system.A);
  json.key("B").matrix(found.system.B);
  json.key("warnings").texts(found.warnings);
  json.end_object();
  return json.str();
}

const char* word_for(const Mode& mode) {
  constexpr double kNothing = 1e-9;
  const double part = mode.damping_ratio();
  if (mode.eigenvalue == 0.0) return "drifts";
  if (part < -kNothing) return mode.eigenvalue.imag() > 0 ? "swings, growing" : "grows";
  return mode.eigenvalue.imag() > 0 ? "swings" : "decays";
}

constexpr std::size_t kModesInTable = 7;

std::string shape_table(const RobotInput& input, const Found& found, std::size_t first) {
  const std::vector<std::string> names = row_names(input.coordinates);
  const std::size_t last = std::min(first + kModesInTable, found.modes.size());
  std::vector<std::string> headings{"joint"};
  for (std::size_t k = first; k < last; ++k) headings.push_back("mode " + std::to_string(k + 1));
  TextTable table(headings);
  for (std::size_t row = 0; row < names.size(); ++row) {
    std::vector<std::string> line{names[row]};
    for (std::size_t k = first; k < last; ++k) {
      const Mode& mode = found.modes[k];
      const auto r = static_cast<Eigen::Index>(row);
      const double re = shape_of(input, found.system, mode.shape.real())[r];
      const double im = shape_of(input, found.system, mode.shape.imag())[r];
      const double size = std::hypot(re, im), degrees = 180 / std::numbers::pi * std::atan2(im, re);
      if (size < 5e-5)
        line.emplace_back("0");
      else
        line.push_back(std::abs(im) < 1e-6 * size ? fmt::format("{:.4f}", re)
                                                  : fmt::format("{:.3f}/{:.0f}", size, degrees));
    }
    table.add(line);
  }
  return table.str();
}

std::string modes_table(const RobotInput& input, const Found& found) {
  std::string text = fmt::format("{}: small motions about {}\n\n", input.robot.name,
                                 "the state: x' = A x + B tau, x = exp(lambda t)");
  TextTable table(
      {"mode", "frequency [rad/s]", "[Hz]", "period [s]", "damping ratio", "lambda [1/s]", "it"});
  const auto clean = [](double value) { return cell(std::abs(value) < 1e-12 ? 0 : value); };
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    const Mode& mode = found.modes[k];
    const double w = mode.frequency(), turn = 2 * std::numbers::pi;
    const double swing = mode.eigenvalue.imag();
    table.add({std::to_string(k + 1), cell(w), cell(w / turn), swing > 0 ? cell(turn / swing) : "-",
               clean(mode.damping_ratio()),
               swing > 0 ? fmt::format("{} +- {}i", clean(mode.eigenvalue.real()), cell(swing))
                         : clean(mode.eigenvalue.real()),
               word_for(mode)});
  }
  text +=
      table.str() + "\nshapes, the largest part 1 (where parts are out of phase: size/degrees):\n";
  for (std::size_t first = 0; first < found.modes.size(); first += kModesInTable)
    text += shape_table(input, found, first) + "\n";
  for (const std::string& warning : found.warnings) text += wrapped("warning: " + warning) + "\n";
  return text;
}

void refuse(const SimulateInput& input, FaultList& faults) {
  if (!input.scene) return;
  for (const SceneConstraint& constraint : input.scene->constraints)
    faults.add({input.scene->description.file.string(), constraint.line,
                "constraint '" + constraint.name + "'", "closed loops are not linearised",
                "ask for the modes of the scene without it"});
  if (input.robot.coordinates.all().empty())
    faults.add({input.scene->description.file.string(), 0, "scene",
                "it has no robot with a joint, and modes are those of robots", ""});
}

}  // namespace

int run_modes(const ModesOptions& options) {
  FaultList faults;
  SimulateOptions simulate;
  simulate.robot = options.robot;
  simulate.duration = 1;
  simulate.integrator = "semi-implicit";
  auto prepared = attempt(faults, [&] { return prepare_simulation(simulate); });
  if (prepared) refuse(prepared->input, faults);
  faults.check();

  SimulateInput& input = prepared->input;
  const RobotInput& robot = input.robot;
  Pushing pushing(input);
  std::size_t dof_count = 0;
  for (const NamedJoint& joint : robot.coordinates.all())
    dof_count = std::max(dof_count, joint.iv + joint.nv);
  Found found;
  found.system = linearise(
      robot.model, robot.state.x,
      [&](const State<double>& x, const Kinematics& k, Forces<double>& forces) {
        pushing.push(x, k, forces);
      },
      dof_count);
  found.modes = modes_of(found.system.A);
  found.names = row_names(robot.coordinates);
  found.warnings = warnings_of(input);
  fmt::print("{}\n", options.json ? modes_json(robot, found) : modes_table(robot, found));
  return 0;
}

}  // namespace twinarm
