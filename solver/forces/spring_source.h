// A source of spring forces: couplings of two robots, and stops. What its springs pulled with at
// the last evaluation can be read, put aside and written down.
#pragma once

#include <vector>

#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// A spring's pull on the robot D that moves, towards its target K, at the last evaluation: for
// plots and pictures.
struct SpringState {
  Vector3 p_K = Vector3::Zero(), p_D = Vector3::Zero();  // ends in the KVR and the DVR, world [m]
  Vector3 pull = Vector3::Zero();  // force [N] or couple [N m] on the DVR, world axes
  double size = 0;                 // |pull|; of a joint spring the torque, or force, with its sign
  double m_star = 0;  // over a step the pull lessens by m* times the acceleration of the measured
                      // quantity: the weightless inertia [kg, kg m^2]
};

class SpringSource : public ForceSource, public Checkpointable {
 public:
  // By spring. In six dimensions the forces of all springs, and then the couples of all.
  const std::vector<SpringState>& readings() const { return readings_; }
  // The pulls, which may be held over many steps; more where a law overrides it.
  void serialize(StateArchive& memory) override {
    for (SpringState& reading : readings_) {
      for (Vector3* v : {&reading.p_K, &reading.p_D, &reading.pull}) memory.visit(*v);
      memory.visit(reading.size);
      memory.visit(reading.m_star);
    }
  }

 protected:
  std::vector<SpringState> readings_;
};

}  // namespace twinarm
