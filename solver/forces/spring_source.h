// Base of force sources made of springs: couplings and joint stops. Provides the forces of the last
// evaluation, and their serialization.
#pragma once

#include <vector>

#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// Force of a spring on the robot (D) towards its target (K) at the last evaluation.
struct SpringState {
  Vector3 p_K = Vector3::Zero(), p_D = Vector3::Zero();  // ends at target and robot, world [m]
  Vector3 force_W = Vector3::Zero();                     // force [N] or couple [N m] on the robot
  double size = 0;    // |force_W|; of a joint spring the signed joint force
  double m_star = 0;  // added inertia [kg, kg m^2]
};

class SpringSource : public ForceSource, public Checkpointable {
 public:
  // By spring. In six dimensions the forces of all springs, then the couples of all.
  const std::vector<SpringState>& readings() const { return readings_; }
  // Spring forces may be held over several steps. Overridden by laws with more state.
  void serialize(StateArchive& archive) override {
    for (SpringState& reading : readings_)
      archive.visit(reading.p_K, reading.p_D, reading.force_W, reading.size, reading.m_star);
  }

 protected:
  std::vector<SpringState> readings_;
};

}  // namespace twinarm
