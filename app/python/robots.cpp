// load() and the class Model.

#include "app/python/robots.h"

#include <pybind11/stl.h>

#include "app/python/arrays.h"
#include "app/support/text.h"

namespace twinarm::python {
namespace {

std::shared_ptr<Robot> load(const py::object& file, bool floating, bool friction, bool armature,
                            std::optional<double> density, std::optional<double> min_mass) {
  SimulateOptions options;
  options.robot.model = path_of(file);
  options.robot.floating = floating;
  options.robot.friction = friction;
  options.robot.armature = armature;
  options.robot.missing = {density, min_mass};
  options.duration = 1;  // not used
  return std::make_shared<Robot>(prepare_simulation(options).input.robot);
}

// By coordinate; `none` for joints without limits.
Array limits(const Robot& robot, double JointDescription::*limit, double none) {
  std::vector<double> all(robot.nq(), none);
  for (const JointDescription& joint : robot.input.robot.joints) {
    const int body = robot.model.find_joint(joint.name);
    if (body > 0 && joint.is_limited())
      all[robot.iq(static_cast<std::size_t>(body))] = joint.*limit;
  }
  return frozen(all);
}
// By velocity, for joints with one degree of freedom; inf if the file has none.
Array max_of(const Robot& robot, double JointDescription::*limit) {
  std::vector<double> all(robot.model.nv, std::numeric_limits<double>::infinity());
  for (const JointDescription& joint : robot.input.robot.joints) {
    const int body = robot.model.find_joint(joint.name);
    if (body <= 0 || joint.*limit <= 0) continue;
    const auto i = static_cast<std::size_t>(body);
    if (robot.model.dofs(i) == 1) all[robot.model.iv[i]] = joint.*limit;
  }
  return frozen(all);
}

std::vector<std::string> joint_types(const Robot& robot) {
  std::vector<std::string> names;
  for (const JointType type : robot.model.joint) names.emplace_back(name_of(type));
  names.front() = "";  // the base has none
  return names;
}

py::slice slice_of(std::size_t begin, std::size_t count) {
  return py::slice(static_cast<py::ssize_t>(begin), static_cast<py::ssize_t>(begin + count), 1);
}
std::size_t count_of_q(const Robot& robot, std::size_t i) {
  return (i + 1 < robot.model.iq.size() ? robot.iq(i + 1) : robot.nq()) - robot.iq(i);
}
// {joint: slice of q, or of qd}
py::dict places(const Robot& robot, bool of_q) {
  py::dict all;
  for (std::size_t i = 1; i < robot.model.parent.size(); ++i) {
    const std::size_t count = of_q ? count_of_q(robot, i) : robot.model.dofs(i);
    if (count == 0) continue;
    all[py::str(robot.model.joint_name[i])] =
        slice_of(of_q ? robot.iq(i) : robot.model.iv[i], count);
  }
  return all;
}

void set_gravity(Robot& robot, const py::object& given) {
  const std::vector<double> g = vector_of(given, 3, "gravity", "x, y, z in world axes [m/s^2]");
  robot.model.gravity = {g[0], g[1], g[2]};
}

using ModelClass = py::class_<Robot, std::shared_ptr<Robot>>;

void add_names_and_places(ModelClass& model) {
  model.def_property_readonly(
      "name", [](const Robot& r) { return r.input.robot.name; }, "of the robot in its file");
  model.def_property_readonly(
      "bodies", [](const Robot& r) { return r.model.body_name; },
      "names of the links, the base first");
  model.def_property_readonly(
      "joints", [](const Robot& r) { return r.model.joint_name; },
      "names of the joints, by body; '' for the base");
  model.def_property_readonly("joint_types", joint_types,
                              "by body: 'fixed', 'revolute', 'prismatic', ...; '' for the base");
  model.def_property_readonly(
      "parent", [](const Robot& r) { return r.model.parent; },
      "by body: index of its parent; -1 for the base");
  model.def_property_readonly(
      "nq", [](const Robot& r) { return r.nq(); }, "number of coordinates q");
  model.def_property_readonly(
      "nv", [](const Robot& r) { return r.model.nv; }, "number of velocities qd");
  model.def_property_readonly(
      "q_of", [](const Robot& r) { return places(r, true); },
      "{joint: slice}: its coordinates in q");
  model.def_property_readonly(
      "qd_of", [](const Robot& r) { return places(r, false); },
      "{joint: slice}: its velocities in qd");
}

void add_numbers(ModelClass& model) {
  model.def_property_readonly(
      "q", [](const Robot& r) { return frozen(q_with_prescribed(r.model, r.input.state.x)); },
      "(nq,) start position: zero, or the scene's [rad, m]");
  model.def_property_readonly(
      "qd", [](const Robot& r) { return frozen(r.input.state.x.qd); },
      "(nv,) start velocity [rad/s, m/s]");
  model.def_property_readonly(
      "lower",
      [](const Robot& r) {
        return limits(r, &JointDescription::lower, -std::numeric_limits<double>::infinity());
      },
      "(nq,) lower limits of q [rad, m]; -inf if none");
  model.def_property_readonly(
      "upper",
      [](const Robot& r) {
        return limits(r, &JointDescription::upper, std::numeric_limits<double>::infinity());
      },
      "(nq,) upper limits of q [rad, m]; inf if none");
  model.def_property_readonly(
      "largest_speed", [](const Robot& r) { return max_of(r, &JointDescription::velocity); },
      "(nv,) velocity limits of the file [rad/s, m/s]; inf if none; not enforced");
  model.def_property_readonly(
      "largest_effort", [](const Robot& r) { return max_of(r, &JointDescription::effort); },
      "(nv,) effort limits of the file [N m, N]; inf if none; not enforced");
  model.def_property(
      "gravity",
      [](const Robot& r) {
        const Vec3<double>& g = r.model.gravity;
        return frozen({g.x, g.y, g.z});
      },
      set_gravity, "(3,) in world axes [m/s^2]; can be set");
  model.def_property_readonly(
      "warnings", [](const Robot& r) { return r.input.warnings; }, "warnings of the file");
  model.def("__repr__", [](const Robot& r) {
    return "<twinarm.Model '" + r.input.robot.name +
           "': " + std::to_string(r.model.parent.size() - 1) + " bodies, " + r.size_of_q() + ", " +
           r.size_of_qd() + ">";
  });
}

}  // namespace

void add_robots(py::module_& m) {
  ModelClass model(m, "Model", py::is_final(),
                   "A mechanism: bodies, joints, inertias. Made by load(). Body 0 is the base;\n"
                   "body i is the child of joint i, and its parent has a lower index.");
  add_names_and_places(model);
  add_numbers(model);

  m.def("load", load, py::arg("file"), py::kw_only(), py::arg("floating") = false,
        py::arg("friction") = true, py::arg("armature") = true, py::arg("density") = py::none(),
        py::arg("min_mass") = py::none(),
        "Reads a robot (URDF), or the bodies of a scene (TOML) without contacts, couplings and\n"
        "constraints (see simulate()).\n\n"
        "  floating  floating base (URDF)\n"
        "  friction  False: ignore joint damping and friction\n"
        "  armature  False: ignore rotor inertia\n"
        "  density   of links without inertia [kg/m^3]: it is taken from their shapes (URDF)\n"
        "  min_mass  of links that then have none [kg]: small balls (URDF)\n\n"
        "Raises InputError with all errors and their lines.");
}

Robot::Robot(RobotInput read)
    : input(std::move(read)),
      x(input.state.x),
      q_python(nq()),
      forces(input.model),
      of_aba(input.model),
      w(input.model),
      qdd(input.model.nv) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const int at = facts_of(model.joint[i]).quaternion;
    if (at >= 0) quaternions.push_back(iq(i) + static_cast<std::size_t>(at));
  }
}

void Robot::check_quaternions(const std::vector<double>& q, const char* function) const {
  constexpr double kUnitTolerance = 1e-6;  // as in a state file
  for (const std::size_t at : quaternions) {
    double square = 0;
    for (std::size_t k = at; k < at + 4; ++k) square += q[k] * q[k];
    if (std::abs(std::sqrt(square) - 1) <= kUnitTolerance) continue;
    const std::string place = "q[" + std::to_string(at) + ":" + std::to_string(at + 4) + "]";
    throw pybind11::value_error(std::string(function) + "(): " + place +
                                " must be a unit quaternion (w, x, y, z), has length " +
                                short_number_text(std::sqrt(square)) + "; normalise it");
  }
}

std::size_t Robot::body(const std::string& name) const {
  const int found = model.find_body(name);
  if (found >= 0) return static_cast<std::size_t>(found);
  throw pybind11::value_error("there is no body '" + name + "'; " +
                              name_remedy(name, model.body_name, "bodies"));
}

}  // namespace twinarm::python
