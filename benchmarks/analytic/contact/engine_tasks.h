// H1: tasks with published results of other engines: SimBenchmark of ETH's Robotic Systems Lab
// (github.com/leggedrobotics/SimBenchmark). Balls and a box on a floor, which every engine can load
// (benchmarks/scenes/). SI units; the error is a mean over all steps of 1 ms, as published.
//
//   rolling   box of 10 kg, 20 x 20 x 1 m, with 25 balls of 1 kg and 0.5 m on it, pulled by 150 N:
//             f1 = mu (M + n m) g is the friction of the floor, f2 = (F - f1)/M / (3.5/m + n/M)
//             that of a ball; the box has (F - f1 - n f2)/M, a ball f2/m. Squared errors of the
//             velocities of box and one ball, summed. 3.145 if nothing moves
//   bouncing  49 balls of 10 kg and 0.1 m from 5 m, e = 1, 20 s: (E - m n^2 g H)^2
//   666       6 x 6 x 6 such balls 0.21 m apart, displaced by up to 1 mm, fall from 1.101 m, no
//             friction, e = 0, 15 s: squared overlaps, summed over all pairs
//   elastic   the same with e = 1, 10 s: (E - E0)^2
// The random displacements differ from the published ones, whose generator is another.
#pragma once

#include <string>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm::engine_tasks {

struct TaskBody {
  bool is_box = false;  // else a ball
  Vector3 half;         // half edges, or the radius three times [m]
  double mass = 1;
  Vector3 p;                       // at the start, at rest
  Vector3 push = Vector3::Zero();  // constant force at its centre [N]
};
struct Moving {  // state of such a body: position, velocity, angular velocity
  Vector3 p, v, w;
};

enum class Measure { velocity, energy, overlap };
struct Task {
  std::string name, what, unit;
  std::vector<TaskBody> bodies{};
  double floor_friction = 0, friction = 0, restitution = 0;
  double duration = 0;
  Measure measure = Measure::energy;
  double energy = 0;  // exact, constant [J]
  // Accelerations where velocities are measured.
  Vector3 box_rate = Vector3::Zero(), ball_rate = Vector3::Zero();
};

Task rolling(bool diagonal);  // pulled along y, or along (1/2, sqrt(3)/2)
Task bouncing();
Task pile(bool elastic);

// Mean over the steps so far.
class MeanError {
 public:
  explicit MeanError(const Task& task) : task_(task) {}
  double take(double t, const std::vector<Moving>& bodies);

 private:
  double now(double t, const std::vector<Moving>& bodies) const;
  Task task_;
  double sum_ = 0;
  long count_ = 0;
};

}  // namespace twinarm::engine_tasks
