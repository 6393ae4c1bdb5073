#include "app/modes/linear_system.h"

#include <fmt/format.h>

#include "app/data/json_writer.h"
#include "app/data/tables.h"
#include "app/scene/forces/add_contacts.h"
#include "app/scene/forces/given_forces.h"

namespace twinarm {
namespace {

// "base" for the free joint of a floating base.
std::string name_of_part(const SimulateInput& input, const NamedJoint& joint) {
  const Coordinates& coordinates = input.robot.coordinates;
  const bool is_base = coordinates.floating() && joint.body == coordinates.base().body;
  return is_base ? "base" : joint.name;
}

// Of the joint's velocities times s.
const char* unit_of(const NamedJoint& joint) {
  const std::vector<JointComponent> all = joint.components();
  const auto angles = std::ranges::count_if(all, &JointComponent::is_angle);
  if (angles == 0) return "m";
  return angles == std::ssize(all) ? "rad" : "(rad, m)";
}

// The mode's components of a joint's velocities, in the coordinates of the command line.
std::vector<double> shape_part(const SimulateInput& input, const NamedJoint& joint,
                               const Eigen::VectorXd& by_velocity) {
  return from_solver(joint, input.robot.state.x,
                     {by_velocity.data(), by_velocity.data() + by_velocity.size()});
}

// Loops of the scene's constraints; projects the input's velocities on them.
std::vector<LoopClosure> take_loops(SimulateInput& input) {
  if (!input.scene || input.scene->constraints.empty()) return {};
  Simulation sim(input.robot.model, input.robot.state.x);
  const SceneContacts contacts(*input.scene, sim);
  input.robot.state.x = sim.state();
  return sim.mechanism().dynamics.bilateral().loops().loops();
}

// Free bodies of the scene with a constraint or spring; the others are left out.
std::vector<NamedJoint> constrained_bodies(const SimulateInput& input,
                                           const std::vector<LoopClosure>& loops) {
  std::set<int> bodies;
  for (const LoopClosure& loop : loops) bodies.insert({loop.body_a, loop.body_b});
  for (const PointSpring& spring : input.robot.springs)
    bodies.insert({spring.a.body, spring.b.body});
  std::vector<NamedJoint> constrained;
  const Model<double>& model = input.robot.model;
  for (const int body : bodies) {
    const auto i = static_cast<std::size_t>(body);
    if (!input.scene || body <= input.scene->robot_bodies) continue;
    if (model.joint[i] == JointType::free)
      constrained.push_back(
          {model.body_name[i], i, model.joint[i], 7, 6, model.iq[i], model.iv[i], 0});
  }
  return constrained;
}

// Of a joint's velocities in the solver's order: a free one has (w; v), w in the child's axes.
std::vector<std::string> names_of_velocities(const std::string& name, const NamedJoint& joint) {
  std::vector<std::string> names(joint.nv);
  for (const JointComponent& c : joint.components()) {
    if (c.v < 0) continue;
    const auto v = static_cast<std::size_t>(c.v);
    names[joint.type == JointType::free ? (v + 3) % 6 : v] = *c.label ? name + "/" + c.label : name;
  }
  return names;
}

std::vector<std::string> warnings_of(const SimulateInput& input,
                                     const std::vector<NamedJoint>& joints,
                                     const std::vector<double>& qdd) {
  std::vector<std::string> warnings = input.robot.warnings;
  const Model<double>& model = input.robot.model;
  const auto is_positive = [](double limit) { return limit > 0; };
  if (std::ranges::any_of(model.coulomb_plus, is_positive) ||
      std::ranges::any_of(model.coulomb_minus, is_positive))
    warnings.emplace_back("Coulomb friction of joints has no linear part and is left out");
  if (input.scene && input.scene->may_touch())
    warnings.emplace_back("contacts, and free bodies without constraints or springs, are left out");
  constexpr double kEquilibrium = 1e-6;  // [rad/s^2, m/s^2]
  double largest = 0;
  std::string where;
  std::string unit;
  for (const NamedJoint& joint : joints)
    for (std::size_t v = joint.iv; v < joint.iv + joint.nv; ++v)
      if (std::abs(qdd[v]) > largest)
        largest = std::abs(qdd[v]), where = name_of_part(input, joint), unit = unit_of(joint);
  if (largest > kEquilibrium)
    warnings.push_back(
        fmt::format("not an equilibrium: '{}' accelerates by {} {}/s^2; the modes describe small "
                    "deviations from the motion for a short time only",
                    where, cell(largest), unit));
  return warnings;
}

// Differentiable applied forces: given torques and wrenches, joint damping, and couplings with
// fixed targets.
class SmoothForces {
 public:
  explicit SmoothForces(SimulateInput& input)
      : input_(input), model_(input.robot.model), given_(input.robot) {}
  void operator()(const State<double>& x, const Kinematics& k, Forces<double>& forces) {
    given_.add_forces(x, k, forces);
    for (std::size_t dof = 0; dof < model_.nv; ++dof)
      forces.tau[dof] -= model_.damping[dof] * x.qd[dof];
    if (!input_.couplings) return;
    for (std::size_t c = 0; c < input_.couplings->size(); ++c)
      input_.couplings->hold_still(c, x, k, forces);
  }

 private:
  SimulateInput& input_;
  const Model<double>& model_;
  GivenForces given_;
};

void write_shape(JsonWriter& json, const SimulateInput& input, const ModesOf& found,
                 const Eigen::VectorXd& by_velocity) {
  json.object([&] {
    for (const NamedJoint& joint : found.joints)
      json.key(name_of_part(input, joint)).number_or_list(shape_part(input, joint, by_velocity));
  });
}

const char* kind_of(const Mode& mode) {
  constexpr double kRounding = 1e-9;
  if (mode.eigenvalue == 0.0) return "drift";
  const bool oscillates = mode.eigenvalue.imag() > 0;
  if (mode.damping_ratio() < -kRounding) return oscillates ? "unstable oscillation" : "unstable";
  return oscillates ? "oscillation" : "decay";
}

// A number, or amplitude/phase where it is out of phase with the largest component.
std::string shape_cell(double re, double im) {
  const double size = std::hypot(re, im), degrees = 180 / std::numbers::pi * std::atan2(im, re);
  if (size < 5e-5) return "0";
  return std::abs(im) < 1e-6 * size ? fmt::format("{:.4f}", re)
                                    : fmt::format("{:.3f}/{:.0f}", size, degrees);
}

constexpr std::size_t kModesInTable = 7;

std::string shape_table(const SimulateInput& input, const ModesOf& found, std::size_t first) {
  const std::size_t last = std::min(first + kModesInTable, found.modes.size());
  std::vector<std::string> headings{"joint"};
  for (std::size_t k = first; k < last; ++k) headings.push_back("mode " + std::to_string(k + 1));
  TextTable table(headings);
  for (const NamedJoint& joint : found.joints)
    for (const JointComponent& c : joint.components()) {
      if (c.v < 0) continue;
      const std::string name = name_of_part(input, joint);
      std::vector<std::string> line{*c.label ? name + "/" + c.label : name};
      const auto v = static_cast<std::size_t>(c.v);
      for (std::size_t k = first; k < last; ++k) {
        const Mode& mode = found.modes[k];
        line.push_back(shape_cell(shape_part(input, joint, mode.shape.real())[v],
                                  shape_part(input, joint, mode.shape.imag())[v]));
      }
      table.add(line);
    }
  return table.str();
}

}  // namespace

ModesOf find_modes(SimulateInput& input) {
  const std::vector<LoopClosure> loops = take_loops(input);
  ModesOf found;
  found.joints = input.robot.coordinates.all();
  for (NamedJoint& body : constrained_bodies(input, loops)) found.joints.push_back(std::move(body));
  const Model<double>& model = input.robot.model;
  std::vector<std::string> name_of(model.nv);
  for (const NamedJoint& joint : found.joints) {
    const std::vector<std::string> names = names_of_velocities(name_of_part(input, joint), joint);
    std::ranges::copy(names, name_of.begin() + static_cast<std::ptrdiff_t>(joint.iv));
  }
  std::vector<char> is_mimic(model.nv);
  for (const Mimic& mimic : model.mimics) is_mimic[mimic.follower] = 1;
  std::vector<std::size_t> still;
  for (std::size_t dof = 0; dof < model.nv; ++dof)
    if (name_of[dof].empty() && !is_mimic[dof]) still.push_back(dof);

  SmoothForces push(input);
  found.looped = linearise_with_loops(model, input.robot.state.x, std::ref(push), loops, still);
  if (!found.looped.system.A.allFinite())
    throw InputError({{input.robot.robot.file.string(), 0, "",
                       "the linearised system is not finite in this state",
                       "see `twinarm inspect`; give smaller numbers", "state.not-finite"}});
  for (const Mode& mode : modes_of(found.looped.system.A))
    found.modes.push_back(by_all_velocities(found.looped, mode));
  for (const std::size_t dof : found.looped.system.dofs) found.rows.push_back(name_of[dof]);
  found.warnings = warnings_of(input, found.joints, found.looped.qdd);
  return found;
}

std::string modes_json(const SimulateInput& input, const ModesOf& found) {
  return answer_text([&](JsonWriter& json) {
    const auto write_mode = [&](const Mode& mode) {
      json.object(
          {{"frequency", mode.frequency()},
           {"damping_ratio", mode.damping_ratio()},
           {"eigenvalue", std::array{mode.eigenvalue.real(), mode.eigenvalue.imag()}},
           {"shape", [&] { write_shape(json, input, found, mode.shape.real()); }},
           {"shape_imaginary", [&] { write_shape(json, input, found, mode.shape.imag()); }}});
    };
    json.members({{"modes", [&] { json.list(found.modes, write_mode); }},
                  {"rows", found.rows},
                  {"A", found.looped.system.A},
                  {"B", found.looped.system.B},
                  {"warnings", found.warnings}});
  });
}

std::string modes_table(const SimulateInput& input, const ModesOf& found) {
  std::string text = fmt::format(
      "{}: linearised system x' = A x + B tau, modes x = exp(lambda t)\n", input.robot.robot.name);
  if (input.scene && !input.scene->constraints.empty())
    text += wrapped(fmt::format("with constraints; {} independent velocities: {}",
                                found.rows.size(), fmt::join(found.rows, ", "))) +
            "\n";
  text += "\n";
  TextTable table(
      {"mode", "frequency [rad/s]", "[Hz]", "period [s]", "damping ratio", "lambda [1/s]", "type"});
  const auto clean = [](double value) { return cell(std::abs(value) < 1e-12 ? 0 : value); };
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    const Mode& mode = found.modes[k];
    const double w = mode.frequency(), two_pi = 2 * std::numbers::pi;
    const double w_d = mode.eigenvalue.imag();
    table.add({std::to_string(k + 1), cell(w), cell(w / two_pi), w_d > 0 ? cell(two_pi / w_d) : "-",
               clean(mode.damping_ratio()),
               w_d > 0 ? fmt::format("{} +- {}i", clean(mode.eigenvalue.real()), cell(w_d))
                       : clean(mode.eigenvalue.real()),
               kind_of(mode)});
  }
  text += table.str() +
          "\nmode shapes, largest component 1 (out of phase: amplitude/phase [degrees]):\n";
  for (std::size_t first = 0; first < found.modes.size(); first += kModesInTable)
    text += shape_table(input, found, first) + "\n";
  return text;
}

}  // namespace twinarm
