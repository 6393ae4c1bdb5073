// Simulation: a robot step by step.

#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "app/python/signals.h"
#include "app/support/text.h"

namespace twinarm::python {
namespace {

struct RobotInMotion : OnlyConstructed {
  Robot& robot;
  std::vector<double> tau;  // constant until set again
  ForceLaw forces{[this](const auto&, const auto&, Forces<double>& all) {
    for (std::size_t k = 0; k < tau.size(); ++k) all.tau[k] += tau[k];
  }};
  Simulation simulation;
  double h;
  long steps = 0, unsolved = 0;

  RobotInMotion(Robot& r, State<double> start, double step, bool friction)
      : robot(r),
        tau(r.model.nv),
        simulation(r.model, std::move(start), {.joint_friction = friction}),
        h(step) {
    simulation.add(forces);
  }
};

using SimulationClass = py::class_<RobotInMotion, std::shared_ptr<RobotInMotion>>;

Integrator integrator_of(const std::string& name) {
  if (const auto found = find_integrator(name)) return *found;
  throw py::value_error("there is no integrator '" + name + "'; " +
                        name_remedy(name, names_of(all_integrators), "integrators"));
}

std::shared_ptr<RobotInMotion> start(Robot& robot, const py::object& q, const py::object& qd,
                                     const std::string& integrator, double h, double tolerance,
                                     bool friction) {
  const auto check = [](const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value))
      throw py::value_error(std::string(name) + " must be positive, is " + number_text(value));
  };
  check("h", h);
  check("tolerance", tolerance);
  const Integrator chosen = integrator_of(integrator);
  auto made = std::make_shared<RobotInMotion>(robot, state_of(robot, q, qd, 0, robot.input.state.x),
                                              h, friction);
  made->simulation.set_integrator(chosen, tolerance);
  return made;
}

void one_step(RobotInMotion& moving) {
  const double t = moving.simulation.state().t;
  const StepReport report = moving.simulation.step(moving.h);
  ++moving.steps;
  if (!report.converged) ++moving.unsolved;
  if (report.finite && report.reached) return;
  const std::string where =
      "step " + std::to_string(moving.steps) + ", from t = " + short_number_text(t) + " s: ";
  if (report.finite)
    throw std::runtime_error(
        where + "step-size underflow: no substep meets the tolerance; give a larger one");
  const std::string what =
      where + "'" + (report.nonfinite_field ? report.nonfinite_field : "q") + "' of body '" +
      moving.robot.model.body_name[static_cast<std::size_t>(report.nonfinite_body)] +
      "' is not finite; use a shorter h or another integrator";
  PyErr_SetString(PyExc_FloatingPointError, what.c_str());
  throw py::error_already_set();
}

void step(RobotInMotion& moving, long count) {
  if (count < 0) throw py::value_error("count must not be negative");
  for (long n = 0; n < count; ++n) {
    one_step(moving);
    check_signals();
  }
}

// The states at the start and after every `every` steps.
py::tuple run(RobotInMotion& moving, long count, long every) {
  if (every < 1) throw py::value_error("every must be 1 step or more");
  if (count < 0 || count % every != 0)
    throw py::value_error("count must be a multiple of every, and not negative");
  const auto rows = static_cast<py::ssize_t>(count / every + 1);
  const auto nq = static_cast<py::ssize_t>(moving.robot.nq()),
             nv = static_cast<py::ssize_t>(moving.robot.model.nv);
  Array t = zeros({rows}), q = zeros({rows, nq}), qd = zeros({rows, nv});
  for (py::ssize_t r = 0; r < rows; ++r) {
    if (r > 0) step(moving, every);
    const State<double>& x = moving.simulation.state();
    *t.mutable_data(r) = x.t;
    const std::vector<double> row = q_with_prescribed(moving.robot.model, x);
    std::ranges::copy(row, q.mutable_data() + r * nq);
    std::ranges::copy(x.qd, qd.mutable_data() + r * nv);
  }
  return py::make_tuple(t, q, qd);
}

py::list integrators() {
  py::list all;
  for (const IntegratorFacts& facts : all_integrators) {
    py::dict row;
    row["name"] = facts.name;
    row["order"] = facts.order;
    row["solves"] = facts.solves;
    all.append(row);
  }
  return all;
}

void add_motion(SimulationClass& simulation) {
  simulation.def(py::init(&start), py::arg("model"), py::arg("q") = py::none(),
                 py::arg("qd") = py::none(), py::kw_only(), py::arg("integrator") = "semi-implicit",
                 py::arg("h") = 0.001, py::arg("tolerance") = 1e-9, py::arg("friction") = true,
                 py::keep_alive<1, 2>(),
                 "  q (nq,), qd (nv,)  the start [rad, m; rad/s, m/s]; default: the model's\n"
                 "  integrator         one of integrators()\n"
                 "  h                  the step [s]\n"
                 "  tolerance          of dopri5, relative and absolute\n"
                 "  friction           False: ignore joint damping and friction");
  simulation.def(
      "step", step, py::arg("count") = 1,
      "Takes `count` steps of h. Raises FloatingPointError with the first quantity that is not\n"
      "finite; the state is then invalid until set_state().");
  simulation.def(
      "run", run, py::arg("count"), py::arg("every") = 1,
      "Takes `count` steps. Returns (t, q, qd) at the start and after every `every` steps:\n"
      "(N,) [s], (N, nq) [rad, m], (N, nv) [rad/s, m/s]. Raises as step().");
  simulation.def(
      "set_state",
      [](RobotInMotion& moving, const py::object& q, const py::object& qd, double t) {
        moving.simulation.set_state(state_of(moving.robot, q, qd, t, moving.simulation.state()));
      },
      py::arg("q") = py::none(), py::arg("qd") = py::none(), py::arg("t") = 0.0,
      "Sets q (nq,) [rad, m], qd (nv,) [rad/s, m/s] and the time t [s]; default of q and qd:\n"
      "unchanged. Mimic joints are set from the joints that they mimic.");
}

void add_readings(SimulationClass& simulation) {
  simulation.def_property_readonly(
      "t", [](const RobotInMotion& moving) { return moving.simulation.state().t; }, "time [s]");
  simulation.def_property_readonly(
      "q",
      [](const RobotInMotion& moving) {
        return frozen(q_with_prescribed(moving.robot.model, moving.simulation.state()));
      },
      "(nq,) coordinates [rad, m]; a copy, set by set_state()");
  simulation.def_property_readonly(
      "qd", [](const RobotInMotion& moving) { return frozen(moving.simulation.state().qd); },
      "(nv,) velocities [rad/s, m/s]; a copy, set by set_state()");
  simulation.def_property(
      "tau", [](const RobotInMotion& moving) { return frozen(moving.tau); },
      [](RobotInMotion& moving, const py::object& tau) {
        moving.tau = vector_of(tau, moving.robot.model.nv, "tau", moving.robot.size_of_qd());
      },
      "(nv,) joint forces [N m, N], constant until set again: sim.tau = [..]");
  simulation.def_readonly("h", &RobotInMotion::h, "the step [s]");
  simulation.def_property_readonly(
      "integrator",
      [](const RobotInMotion& moving) { return integrator_name(moving.simulation.integrator()); },
      "its name");
  simulation.def_readonly("steps", &RobotInMotion::steps, "number of steps taken");
  simulation.def_readonly("unsolved", &RobotInMotion::unsolved,
                          "number of steps whose implicit equation did not converge to rounding");
  simulation.def(
      "energy",
      [](const RobotInMotion& moving) {
        const State<double>& x = moving.simulation.state();
        return py::make_tuple(kinetic_energy(moving.robot.model, x),
                              potential_energy(moving.robot.model, x));
      },
      "(kinetic, potential) [J]");
}

}  // namespace

State<double> state_of(const Robot& robot, const py::object& q, const py::object& qd, double t,
                       const State<double>& where_left_out) {
  State<double> x = where_left_out;
  if (!q.is_none())
    set_q_with_prescribed(robot.model, vector_of(q, robot.nq(), "q", robot.size_of_q()), x);
  if (!qd.is_none()) x.qd = vector_of(qd, robot.model.nv, "qd", robot.size_of_qd());
  if (!std::isfinite(t)) throw py::value_error("t must be a finite number of seconds");
  x.t = t;
  robot.check_quaternions(q_with_prescribed(robot.model, x), "Simulation");
  return x;
}

void add_simulation(py::module_& m) {
  SimulationClass simulation(m, "Simulation",
                             "A robot with gravity, joint friction, and joint forces.\n"
                             "Without contacts and position limits: for those simulate() "
                             "a scene.");
  add_motion(simulation);
  add_readings(simulation);

  m.def("integrators", integrators,
        "A row for each: name; order of accuracy; solves, whether an equation is solved in each\n"
        "step.");
}

}  // namespace twinarm::python
