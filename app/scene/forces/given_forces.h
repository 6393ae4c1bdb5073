// What a state file says that acts, held constant. Both remember nothing from step to step.
#pragma once

#include <vector>

#include "app/robot/robot_input.h"
#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

// Joint torques: constant as the command line has them, so those of a floating joint in the
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

// A force at a point of a link, and a torque about it. In link axes it turns with the link. In
// world axes both keep their direction, and the point is the one of the link that stood there at
// the start: it goes with the link.
class GivenWrench : public ForceSource, public Checkpointable {
 public:
  GivenWrench(const Wrench& wrench, const Kinematics& start);
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  double power(const Kinematics& k) const;  // [W]
  Wrench now(const Kinematics& k) const;    // in world axes
  std::size_t body() const { return wrench_.body; }

 private:
  Wrench wrench_;
  Vector3 p_L_;  // the point, link axes
};

}  // namespace twinarm
