// Constant joint forces and wrenches of a state file; without internal state.
#pragma once

#include <vector>

#include "app/robot/robot_input.h"
#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

// Joint forces, constant in the coordinates of app/robot/coordinates.h: of a floating joint in the
// parent's axes.
class GivenTorques : public ForceSource, public Checkpointable {
 public:
  GivenTorques(const Model<double>& model, const Coordinates& coordinates,
               const Eigen::VectorXd& tau)
      : coordinates_(coordinates), tau_(tau), by_velocity_(model.nv) {}
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;

 private:
  const Coordinates& coordinates_;
  const Eigen::VectorXd& tau_;
  std::vector<double> by_velocity_;
};

// A force at a point of a link and a torque about it. The point is fixed to the link; the
// directions are constant in link axes, or in world axes (the point is then given at the start).
class GivenWrench : public ForceSource, public Checkpointable {
 public:
  GivenWrench(const Wrench& wrench, const Kinematics& start);
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  double power(const Kinematics& k) const;  // [W]
  Wrench now(const Kinematics& k) const;    // world axes
  std::size_t body() const { return wrench_.body; }

 private:
  Wrench wrench_;
  Vector3 p_L_;  // the point, link axes
};

}  // namespace twinarm
