// Constant joint forces and wrenches of a state file, springs of a scene; without internal state.
#pragma once

#include <vector>

#include "app/robot/dynamics.h"
#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

// A force at a point of a link and a torque about it. The point is fixed to the link; the
// directions are constant in link axes, or in world axes (the point is then given at the start).
class GivenWrench {
 public:
  GivenWrench(const Wrench& wrench, const Kinematics& start);
  double power(const Kinematics& k) const;  // [W]
  Wrench now(const Kinematics& k) const;    // world axes
  std::size_t body() const { return wrench_.body; }

 private:
  Wrench wrench_;
  Vector3 p_L_;  // the point, link axes
};

// Joint forces are constant in the coordinates of app/robot/coordinates.h: of a floating joint in
// the parent's axes.
class GivenForces : public ForceSource, public Checkpointable {
 public:
  explicit GivenForces(const RobotInput& input);  // which must outlive it
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  const std::vector<GivenWrench>& wrenches() const { return wrenches_; }
  PointSprings& springs() { return springs_; }

 private:
  const RobotInput& input_;
  std::vector<GivenWrench> wrenches_;
  PointSprings springs_;
  std::vector<double> by_velocity_;
};

}  // namespace twinarm
