// A robot, or the bodies of a scene, with workspaces for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <vector>

#include "app/robot/robot_input.h"
#include "app/run/simulate_input.h"
#include "solver/model/configuration.h"
#include "solver/model/workspace.h"

namespace twinarm::python {

class Robot {
 public:
  explicit Robot(RobotInput read);
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  RobotInput input;
  Model<double>& model = input.model;
  // Of the last call. aba() has its own workspace, for model.workspace().
  State<double> x;
  std::vector<double> q_python;  // with prescribed motions
  Forces<double> forces;         // of aba()
  Workspace<double> of_aba, w;
  std::vector<double> qdd;           // of rnea()
  std::vector<Force<double>> f_ext;  // of rnea()
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

// Adds set={"coupling.pull.stiffness": 800}, changes of a scene before it is read, to options with
// a model. `set`: None, or a dict by path of numbers, texts, booleans or lists of numbers.
// TypeError for other values, ValueError if the model is not a scene.
void change_scene(const pybind11::object& set, SimulateOptions& options);

}  // namespace twinarm::python
