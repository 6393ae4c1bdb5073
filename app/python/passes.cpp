
#include "app/python/fast_arguments.h"
#include "app/python/signals.h"
#include "solver/dynamics/derivatives.h"

namespace twinarm::python {
namespace {

// f(robot, i) for i < count. Many calls work on a copy, so that other threads of Python may use the
// robot meanwhile.
template <class F>
void for_calls(Robot& robot, std::size_t count, F f) {
  constexpr std::size_t kMany = 256;
  if (count < kMany) {
    for (std::size_t i = 0; i < count; ++i) f(robot, i);
    return;
  }
  Robot own(robot.input);
  own.forces = robot.forces;
  {
    const py::gil_scoped_release other_threads;
    for (std::size_t i = 0; i < count; ++i) {
      f(own, i);
      check_signals();
    }
  }
  std::swap(robot.x, own.x);
  std::swap(robot.of_aba, own.of_aba);
  robot.has_run_aba |= own.has_run_aba;
}

void take_q(const char* function, const Rows& q, std::size_t call, Robot& robot) {
  q.copy(call, robot.q_python);
  if (!robot.quaternions.empty()) robot.check_quaternions(robot.q_python, function);
  set_q_with_prescribed(robot.model, robot.q_python, robot.x);
}

MatrixWorkspace<double>& matrices_of(Robot& robot) {
  if (!robot.matrices) robot.matrices.emplace(robot.model);
  return *robot.matrices;
}

// Wrenches from link axes to body axes; zero if none are given.
void take_wrenches(const char* function, PyObject* given, Robot& robot) {
  std::vector<Force<double>>& f_ext = robot.forces.f_ext;
  std::ranges::fill(f_ext, Force<double>{});
  if (!given) return;
  const std::string what = std::string(function) + "(): f_ext";
  const Array numbers = numbers_of(given, what);
  if (numbers.ndim() != 2 || static_cast<std::size_t>(numbers.shape(0)) != f_ext.size() ||
      numbers.shape(1) != 6)
    throw py::value_error(what + " has shape " + shape_text(numbers) + ", must have (" +
                          std::to_string(f_ext.size()) +
                          ", 6): torque and force on each body, the base first");
  check_finite(numbers.data(), static_cast<std::size_t>(numbers.size()), what);
  for (std::size_t i = 1; i < f_ext.size(); ++i) {
    const double* of = numbers.data() + 6 * i;
    const Mat3<double>& R_BL = robot.model.R_BL[i];
    f_ext[i] = {R_BL * Vec3<double>{of[0], of[1], of[2]}, R_BL * Vec3<double>{of[3], of[4], of[5]}};
  }
}

// f(robot, place of the result) for every state, with its joint forces or accelerations, the
// argument `third`, in the vector that third_of(robot) gives.
template <class ThirdOf, class F>
PyObject* call_by_state(const char* function, const char* third, PyObject* const* given,
                        Py_ssize_t count, PyObject* keywords, ThirdOf third_of, F f) {
  return guarded([&] {
    const std::array names{"model", "q", "qd", third, "f_ext", "out"};
    const Arguments<names.size()> a(function, names, 4, given, count, keywords);
    Robot& robot = robot_of(function, a.at[0]);
    const std::size_t nv = robot.model.nv;
    const Rows q(function, "q", a.at[1], robot.nq(), robot), qd(function, "qd", a.at[2], nv, robot),
        thirds(function, third, a.at[3], nv, robot);
    const Calls calls(function, {&q, &qd, &thirds});
    Output out(function, a.at[5], calls, {nv});
    take_wrenches(function, a.at[4], robot);
    for_calls(robot, calls.count, [&](Robot& of, std::size_t i) {
      take_q(function, q, i, of);
      qd.copy(i, of.x.qd);
      thirds.copy(i, third_of(of));
      f(of, out.row(i));
    });
    return out.release();
  });
}
PyObject* call_aba(PyObject*, PyObject* const* given, Py_ssize_t count, PyObject* keywords) {
  const auto tau_of = [](Robot & robot) -> auto& {
    return robot.forces.tau;
  };
  return call_by_state("aba", "tau", given, count, keywords, tau_of, [](Robot& of, double* qdd) {
    aba(of.model, of.x, of.forces, of.of_aba);
    std::ranges::copy(of.of_aba.qdd, qdd);
    of.has_run_aba = true;
  });
}
PyObject* call_rnea(PyObject*, PyObject* const* given, Py_ssize_t count, PyObject* keywords) {
  const auto qdd_of = [](Robot & robot) -> auto& {
    return robot.qdd;
  };
  return call_by_state("rnea", "qdd", given, count, keywords, qdd_of, [](Robot& of, double* tau) {
    rnea(of.model, of.x, of.qdd, of.forces.f_ext, of.w);
    std::ranges::copy(of.w.tau, tau);
  });
}

constexpr std::array kDerivatives{"model", "q", "qd", "tau", "f_ext"};
PyObject* call_aba_derivatives(PyObject*, PyObject* const* given, Py_ssize_t count,
                               PyObject* keywords) {
  constexpr const char* kName = "aba_derivatives";
  return guarded([&] {
    const Arguments<kDerivatives.size()> a(kName, kDerivatives, 4, given, count, keywords);
    Robot& robot = robot_of(kName, a.at[0]);
    const std::size_t nv = robot.model.nv;
    const Rows q(kName, "q", a.at[1], robot.nq(), robot), qd(kName, "qd", a.at[2], nv, robot),
        tau(kName, "tau", a.at[3], nv, robot);
    const Calls calls(kName, {&q, &qd, &tau});
    Output by_q(kName, nullptr, calls, {nv, nv}), by_qd(kName, nullptr, calls, {nv, nv}),
        by_tau(kName, nullptr, calls, {nv, nv});
    take_wrenches(kName, a.at[4], robot);
    AbaDerivatives<double> all(robot.model);
    for_calls(robot, calls.count, [&](Robot& of, std::size_t i) {
      take_q(kName, q, i, of);
      qd.copy(i, of.x.qd);
      tau.copy(i, of.forces.tau);
      aba(of.model, of.x, of.forces, of.w);
      aba_derivatives(of.model, of.x, of.forces, of.w, matrices_of(of), all);
      for (std::size_t k = 0; k < nv; ++k) {
        std::copy_n(&all.dqdd[2 * nv * k], nv, by_q.row(i) + nv * k);
        std::copy_n(&all.dqdd[2 * nv * k + nv], nv, by_qd.row(i) + nv * k);
      }
      std::ranges::copy(all.Minv, by_tau.row(i));
    });
    return PyTuple_Pack(3, by_q.get(), by_qd.get(), by_tau.get());
  });
}

constexpr std::array kByQ{"model", "q", "out"};
// f(robot, nv x nv numbers to write) for every q.
template <class F>
PyObject* call_by_q(const char* function, PyObject* const* given, Py_ssize_t count,
                    PyObject* keywords, F f) {
  return guarded([&] {
    const Arguments<kByQ.size()> a(function, kByQ, 2, given, count, keywords);
    Robot& robot = robot_of(function, a.at[0]);
    const Rows q(function, "q", a.at[1], robot.nq(), robot);
    const Calls calls(function, {&q});
    Output out(function, a.at[2], calls, {robot.model.nv, robot.model.nv});
    for_calls(robot, calls.count, [&](Robot& of, std::size_t i) {
      take_q(function, q, i, of);
      f(of, out.row(i));
    });
    return out.release();
  });
}
PyObject* call_crba(PyObject*, PyObject* const* given, Py_ssize_t count, PyObject* keywords) {
  return call_by_q("crba", given, count, keywords, [](Robot& robot, double* M) {
    crba(robot.model, robot.x, robot.w, {M, robot.model.nv * robot.model.nv});
  });
}
PyObject* call_minv(PyObject*, PyObject* const* given, Py_ssize_t count, PyObject* keywords) {
  return call_by_q("minv", given, count, keywords, [](Robot& robot, double* M_inverse) {
    const std::size_t nv = robot.model.nv;
    minv_matrix(robot.model, robot.x, robot.w, matrices_of(robot), {M_inverse, nv * nv});
  });
}

template <class F>
PyCFunction as_method(F* f) {
  return reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(f));
}
constexpr int kFast = METH_FASTCALL | METH_KEYWORDS;

PyMethodDef methods[] = {
    {"aba", as_method(call_aba), kFast,
     "aba(model, q, qd, tau, f_ext=None, out=None)\n--\n\n"
     "Forward dynamics by the articulated-body algorithm, RBDA table 7.1, in O(n).\n\n"
     "  q      (nq,)  joint coordinates [rad, m]; or (N, nq): N states in one call\n"
     "  qd     (nv,) or (N, nv)  joint velocities [rad/s, m/s]\n"
     "  tau    (nv,) or (N, nv)  joint forces [N m, N]\n"
     "  f_ext  (bodies, 6)  external torque and force [N m, N] on each body, the base first, in\n"
     "         link axes about the link's origin; the same for all states\n"
     "  out    (nv,) or (N, nv)  array for the result; default: a new one\n\n"
     "Returns qdd (nv,) or (N, nv) [rad/s^2, m/s^2], without joint damping, friction and mimic\n"
     "joints (see forward_dynamics()). Quantities of the last state: model.workspace()."},
    {"aba_derivatives", as_method(call_aba_derivatives), kFast,
     "aba_derivatives(model, q, qd, tau, f_ext=None)\n--\n\n"
     "Derivatives of aba(), analytic (Singh, Russell and Wensing 2022), in O(n d).\n\n"
     "  q, qd, tau, f_ext  as of aba(); one state or N\n\n"
     "Returns (dqdd_dq, dqdd_dqd, dqdd_dtau), each (nv, nv) or (N, nv, nv): row k is joint force "
     "or\n"
     "acceleration k. dqdd_dq is along the velocities of the joints (the angular velocity of a "
     "ball\n"
     "joint, not its quaternion) [1/s^2]; dqdd_dqd [1/s]; dqdd_dtau is M^-1 [1/(kg m^2), 1/kg]."},
    {"rnea", as_method(call_rnea), kFast,
     "rnea(model, q, qd, qdd, f_ext=None, out=None)\n--\n\n"
     "Inverse dynamics by the recursive Newton-Euler algorithm, RBDA table 5.1, in O(n).\n\n"
     "  q      (nq,) or (N, nq)  joint coordinates [rad, m]\n"
     "  qd     (nv,) or (N, nv)  joint velocities [rad/s, m/s]\n"
     "  qdd    (nv,) or (N, nv)  joint accelerations [rad/s^2, m/s^2]\n"
     "  f_ext  (bodies, 6)  as of aba() [N m, N]\n"
     "  out    (nv,) or (N, nv)  array for the result; default: a new one\n\n"
     "Returns tau (nv,) or (N, nv) [N m, N], gravity and rotors included, friction not."},
    {"crba", as_method(call_crba), kFast,
     "crba(model, q, out=None)\n--\n\n"
     "The mass matrix by the composite-rigid-body algorithm, RBDA table 6.2.\n\n"
     "  q    (nq,) or (N, nq)  joint coordinates [rad, m]\n"
     "  out  (nv, nv) or (N, nv, nv)  array for the result; default: a new one\n\n"
     "Returns M (nv, nv) or (N, nv, nv) [kg m^2, kg m, kg], rotors on the diagonal included."},
    {"minv", as_method(call_minv), kFast,
     "minv(model, q, out=None)\n--\n\n"
     "The inverse of the mass matrix from the articulated-body inertias (Carpentier 2018), "
     "O(n^2).\n\n"
     "  q    (nq,) or (N, nq)  joint coordinates [rad, m]\n"
     "  out  (nv, nv) or (N, nv, nv)  array for the result; default: a new one\n\n"
     "Returns M^-1 (nv, nv) or (N, nv, nv) [1/(kg m^2), 1/(kg m), 1/kg]."},
    {nullptr, nullptr, 0, nullptr}};

}  // namespace

void add_passes(py::module_& m) {
  if (PyModule_AddFunctions(m.ptr(), methods) != 0) throw py::error_already_set();
}

}  // namespace twinarm::python
