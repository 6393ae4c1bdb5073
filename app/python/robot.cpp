#include "app/python/robot.h"

#include <pybind11/pybind11.h>

#include <cmath>
#include <utility>

#include "app/support/nearest_name.h"
#include "solver/support/number_text.h"

namespace twinarm::python {

Robot::Robot(RobotInput read)
    : input(std::move(read)),
      x(input.state.x),
      q_python(nq()),
      forces(input.model),
      of_aba(input.model),
      w(input.model),
      qdd(input.model.nv),
      f_ext(input.model.parent.size()) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const int at = facts_of(model.joint[i]).quaternion;
    if (at >= 0) quaternions.push_back(iq(i) + static_cast<std::size_t>(at));
  }
}

void Robot::check_quaternions(const std::vector<double>& q, const char* function) const {
  constexpr double kFew = 1e-6;  // as in a state file
  for (const std::size_t at : quaternions) {
    double square = 0;
    for (std::size_t k = at; k < at + 4; ++k) square += q[k] * q[k];
    if (std::abs(std::sqrt(square) - 1) <= kFew) continue;
    const std::string place = "q[" + std::to_string(at) + ":" + std::to_string(at + 4) + "]";
    throw pybind11::value_error(std::string(function) + "(): " + place +
                                " is a unit quaternion (w, x, y, z), and has length " +
                                short_number_text(std::sqrt(square)) + "; divide it by that");
  }
}

std::size_t Robot::body(const std::string& name) const {
  const int found = model.find_body(name);
  if (found >= 0) return static_cast<std::size_t>(found);
  throw pybind11::value_error("there is no body '" + name + "'; " +
                              name_remedy(name, model.body_name, "bodies"));
}

}  // namespace twinarm::python
