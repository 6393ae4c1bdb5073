// Kinematics in world axes; forward dynamics with friction and mimic joints.
#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"
#include "solver/model/mimic.h"

namespace twinarm::python {
namespace {

// Sets the state; the kinematics are in robot.w.
void set_state(Robot& robot, const py::object& q, const py::object& qd, const char* function) {
  const std::string name = std::string(function) + "(): ";
  robot.q_python = vector_of(q, robot.nq(), name + "q", robot.size_of_q());
  robot.check_quaternions(robot.q_python, function);
  set_q_with_prescribed(robot.model, robot.q_python, robot.x);
  if (qd.is_none())
    robot.x.qd.assign(robot.model.nv, 0);
  else
    robot.x.qd = vector_of(qd, robot.model.nv, name + "qd", robot.size_of_qd());
  kinematics(robot.model, robot.x, robot.w);
}

// Of each body, R_WL = R_WB R_BL.
Array poses(Robot& robot, const py::object& q) {
  set_state(robot, q, py::none(), "poses");
  const auto n = static_cast<py::ssize_t>(robot.model.parent.size());
  Array all = zeros({n, 4, 4});
  for (py::ssize_t i = 0; i < n; ++i) {
    const auto body = static_cast<std::size_t>(i);
    const Mat3<double>& R_BL = robot.model.R_BL[body];
    double* X = all.mutable_data(i, 0, 0);
    const Vec3<double> columns[3] = {{R_BL.r0.x, R_BL.r1.x, R_BL.r2.x},
                                     {R_BL.r0.y, R_BL.r1.y, R_BL.r2.y},
                                     {R_BL.r0.z, R_BL.r1.z, R_BL.r2.z}};
    for (int c = 0; c < 3; ++c) {
      const Vec3<double> column = to_world(robot.w, body, columns[c]);
      X[c] = column.x, X[4 + c] = column.y, X[8 + c] = column.z;
    }
    const Vec3<double>& p = robot.w.X0[body].r;
    X[3] = p.x, X[7] = p.y, X[11] = p.z, X[15] = 1;
  }
  return all;
}

Array velocities(Robot& robot, const py::object& q, const py::object& qd) {
  set_state(robot, q, qd, "velocities");
  const auto n = static_cast<py::ssize_t>(robot.model.parent.size());
  Array all = zeros({n, 6});
  for (py::ssize_t i = 1; i < n; ++i) {
    store(angular_velocity(robot.w, static_cast<std::size_t>(i)), all.mutable_data(i, 0));
    store(point_velocity(robot.w, static_cast<std::size_t>(i), {}), all.mutable_data(i, 3));
  }
  return all;
}

Array body_jacobian(Robot& robot, const py::object& q, const std::string& body,
                    const py::object& point) {
  set_state(robot, q, py::none(), "jacobian");
  const std::size_t i = robot.body(body);
  Vec3<double> p_B;
  if (!point.is_none()) {
    const auto p = vector_of(point, 3, "jacobian(): point", "x, y, z in link axes [m]");
    p_B = robot.model.R_BL[i] * Vec3<double>{p[0], p[1], p[2]};
  }
  std::vector<Motion<double>> columns(robot.model.nv);
  jacobian(robot.model, robot.w, i, p_B, columns);
  Array J = zeros({6, static_cast<py::ssize_t>(robot.model.nv)});
  for (py::ssize_t c = 0; c < J.shape(1); ++c) {
    double six[6];
    store(columns[static_cast<std::size_t>(c)].w, six);
    store(columns[static_cast<std::size_t>(c)].v, six + 3);
    for (py::ssize_t r = 0; r < 6; ++r) *J.mutable_data(r, c) = six[r];
  }
  return J;
}

py::tuple energy(Robot& robot, const py::object& q, const py::object& qd) {
  set_state(robot, q, qd, "energy");
  return py::make_tuple(kinetic_energy(robot.model, robot.x, robot.w),
                        potential_energy(robot.model, robot.w));
}

Array momentum_of(Robot& robot, const py::object& q, const py::object& qd) {
  set_state(robot, q, qd, "momentum");
  const Force<double> sum = momentum(robot.model, robot.w);
  Array six = zeros({6});
  store(sum.n, six.mutable_data(0));
  store(sum.f, six.mutable_data(3));
  return six;
}

py::tuple mass_and_com(Robot& robot, const py::object& q) {
  set_state(robot, q, py::none(), "mass_and_com");
  const MassAndCom<double> all = mass_and_com(robot.model, robot.w);
  return py::make_tuple(all.mass, array_of({all.com.x, all.com.y, all.com.z}));
}

Array all_forward_dynamics(Robot& robot, const py::object& q, const py::object& qd,
                           const py::object& tau) {
  set_state(robot, q, qd, "forward_dynamics");
  Forces<double> forces(robot.model);
  forces.tau = vector_of(tau, robot.model.nv, "forward_dynamics(): tau", robot.size_of_qd());
  apply_mimics(robot.model, robot.x);
  ForwardDynamics dynamics(robot.model);
  dynamics(robot.x, forces, robot.w);
  return array_of(robot.w.qdd);
}

}  // namespace

void add_motion(py::module_& m) {
  const auto model = py::arg("model"), q = py::arg("q");
  m.def(
      "poses", poses, model, q,
      "X_WL (bodies, 4, 4): the pose of every link in the world, its axes in the columns and its\n"
      "origin in the last [1, m]. q (nq,) [rad, m].");
  m.def("velocities", velocities, model, q, py::arg("qd"),
        "(bodies, 6): angular velocity of every link and velocity of its origin, world axes\n"
        "[rad/s, m/s]. q (nq,) [rad, m], qd (nv,) [rad/s, m/s].");
  m.def(
      "jacobian", body_jacobian, model, q, py::arg("body"), py::arg("point") = py::none(),
      "J (6, nv): angular velocity of the link and velocity of its point, world axes, for each\n"
      "unit of qd [1, m]. q (nq,) [rad, m]; body is the link's name; point (3,) in link axes from\n"
      "its origin [m], the origin if left out.");
  m.def(
      "energy", energy, model, q, py::arg("qd"),
      "(kinetic, potential) [J]: of bodies and rotors; in the field of gravity, 0 at the world's\n"
      "origin. q (nq,) [rad, m], qd (nv,) [rad/s, m/s].");
  m.def("momentum", momentum_of, model, q, py::arg("qd"),
        "(6,): angular momentum about the world's origin, linear momentum, world axes\n"
        "[N m s, N s]; of bodies, rotors have none. q (nq,) [rad, m], qd (nv,) [rad/s, m/s].");
  m.def("mass_and_com", mass_and_com, model, q,
        "(mass, p): [kg], and where its centre is (3,), world axes [m]. q (nq,) [rad, m].");
  m.def("forward_dynamics", all_forward_dynamics, model, q, py::arg("qd"), py::arg("tau"),
        "qdd (nv,) [rad/s^2, m/s^2] as of `twinarm dynamics`: aba() with joint damping, Coulomb\n"
        "friction and mimic joints, whose positions are set first. q (nq,) [rad, m], qd (nv,)\n"
        "[rad/s, m/s], tau (nv,) [N m, N].");
}

}  // namespace twinarm::python
