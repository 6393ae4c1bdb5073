// A robot, or a scene's bodies, as Python holds them, with room for what the passes leave.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/robot/robot_input.h"
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
  // Of the last call. aba() has a workspace of its own, so that what it left can be looked at.
  State<double> x;
  std::vector<double> q_python;  // with what is prescribed
  Forces<double> forces;         // of aba()
  Workspace<double> of_aba, w;
  std::vector<double> qdd;           // of rnea()
  std::vector<Force<double>> f_ext;  // likewise
  bool has_run_aba = false;
  std::vector<std::size_t> quaternions;  // where in q they begin

  // In Python q has the motion of prescribed joints too: q_with_prescribed().
  std::size_t nq() const { return model.nq + model.np; }
  std::size_t iq(std::size_t i) const { return model.iq[i] + model.ip[i]; }
  // Throws ValueError where one has not length 1, to 1e-6.
  void check_quaternions(const std::vector<double>& q, const char* function) const;
  // By the name of a link; ValueError where there is none.
  std::size_t body(const std::string& name) const;
  std::string size_of_q() const { return "nq = " + std::to_string(nq()); }
  std::string size_of_qd() const { return "nv = " + std::to_string(model.nv); }
};

}  // namespace twinarm::python
