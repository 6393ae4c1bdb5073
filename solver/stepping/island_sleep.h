// Sleep of islands at rest: trees joined by constraints whose velocities have stayed below a speed
// for kTime, with accelerations that would take kStart to reach it. An island asleep has no
// velocity, and its coordinates keep their bits. In each step its former impulses are only
// checked, as nothing has changed; where a contact, a force or a support has, the solution moves
// the island, and it wakes.
#pragma once

#include <span>
#include <vector>

#include "solver/impulses/impulse_solver.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class IslandSleep {
 public:
  static constexpr double kTime = 0.5, kStart = 2;  // [s]

  // Largest velocity of a coordinate at rest [m/s, rad/s]; 0: nothing sleeps.
  void set_speed(double speed) { speed_ = speed; }
  bool is_on() const { return speed_ > 0; }
  struct Step {
    const ImpulseProblem& problem;                    // solved
    std::span<const ImpulseIsland::Members> islands;  // of the solution
    const std::vector<double>& before;                // velocities at the start, as in v0
    double accuracy, h;                               // of the impulses [m/s]; step size [s]
  };
  void update(const Step& step);  // at the end of each step
  bool is_asleep(int tree) const {
    return !quiet_.empty() && quiet_[static_cast<std::size_t>(tree)] >= kTime;
  }
  void serialize(StateArchive& archive) {
    if (is_on()) archive.visit(quiet_);
  }

 private:
  double speed_ = 0;
  std::vector<double> quiet_;  // by tree: time at rest [s], at most kTime
  std::vector<char> in_island_;
};

}  // namespace twinarm
