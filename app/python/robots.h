// A robot, or the bodies of a scene, with workspaces for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/robot/robot_input.h"
#include "app/run/run.h"
#include "solver/model/configuration.h"
#include "solver/model/workspace.h"

namespace twinarm::python {

class Robot : public OnlyConstructed {
 public:
  explicit Robot(RobotInput read);
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  RobotInput input;
  Model<double>& model = input.model;
  // Of the last call. aba() has its own workspace, for model.workspace().
  State<double> x;
  std::vector<double> q_python;  // with prescribed motions
  Forces<double> forces;         // of aba(); its wrenches of rnea() too
  Workspace<double> of_aba, w;
  std::optional<MatrixWorkspace<double>> matrices;  // of minv() and aba_derivatives()
  std::vector<double> qdd;                          // of rnea()
  bool has_run_aba = false;
  std::vector<std::size_t> quaternions;  // their start indices in q

  // In Python q includes prescribed joints: q_with_prescribed().
  std::size_t nq() const { return model.nq + model.np; }
  std::size_t iq(std::size_t i) const { return model.iq[i] + model.ip[i]; }
  // Throws ValueError if a length is not 1 to 1e-6.
  void check_quaternions(const std::vector<double>& q, const char* function) const;
  // Index of a link; ValueError if there is none.
  std::size_t body(const std::string& name) const;
  std::string size_of_q() const { return "nq = " + std::to_string(nq()); }
  std::string size_of_qd() const { return "nv = " + std::to_string(model.nv); }
};

// Options of simulate(), SceneSimulation and predict_couplings(). `set`: None, or changes of the
// scene before it is read, a dict by path ("coupling.pull.stiffness") of numbers, texts, booleans
// or lists of numbers. TypeError for other values, ValueError if the file is not a scene.
SimulateOptions run_options(const pybind11::object& file, const std::optional<double>& step,
                            const std::string& integrator, const pybind11::object& state,
                            const std::string& contact, bool friction, bool armature,
                            const pybind11::object& set);
pybind11::dict work_by_row(const std::vector<EnergyRow>& rows);
pybind11::dict momentum_by_row(const std::vector<MomentumRow>& rows);

// `before` with other coordinates and velocities (None: the same) at the time t.
State<double> state_of(const Robot& robot, const pybind11::object& q, const pybind11::object& qd,
                       double t, const State<double>& before);

}  // namespace twinarm::python
