// The scenes that are timed with contacts, in plain numbers: every engine gets the same ones.
//
//   wall100  ten columns of ten boxes; the gaps of 1 mm close by falling, then all is at rest
//   pyr55    a pyramid of 55 boxes, dropped likewise: every box lies on two others
//   scara    the arm scara3 of models.h; PD control pushes a ball at its tip into a fixed box
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/speed/models.h"

namespace twinarm::speed {

inline constexpr double box_edge = 0.1, box_mass = 1;  // [m], [kg]; uniform
inline constexpr double contact_friction = 0.6;        // of every pair; nothing bounces

// Controlled once in each step: tau = stiffness (target - q) - damping qd. Starts at q = 0, at
// rest.
struct Push {
  std::array<double, 3> target = {0.6, 0.3, 0.2};  // [rad]
  double stiffness = 20, damping = 0.5;            // [N m/rad], [N m s/rad]
  Numbers3 tip = {0.14, 0, 0};                     // centre of the ball, in axes of the last link
  double radius = 0.02;                            // [m]
  Numbers3 obstacle = {0.2206, 0.3053, 0.13};      // centre of the box, whose edge is box_edge
  double torque(std::size_t joint, double q, double qd) const {
    return stiffness * (target[joint] - q) - damping * qd;
  }
};

struct ContactScene {
  std::string name;
  double h;                     // [s]
  int steps;                    // of the whole run
  std::vector<Numbers3> boxes;  // centres at the start, axes along the world's, floor at z = 0;
                                // empty: the arm
  bool has_arm() const { return boxes.empty(); }
};

inline constexpr std::array<const char*, 3> contact_scene_names = {"wall100", "pyr55", "scara"};
ContactScene contact_scene(const std::string& name);  // throws std::invalid_argument

// What moves and is watched: each box, or the ball at the arm's tip.
struct Placed {
  Numbers3 position;                  // of its centre in the world
  std::array<double, 4> orientation;  // w, x, y, z; of the ball: any
};

// Over a run, by one and the same measure for all engines: our collision detection at the poses
// that they report.
class ContactMeasure {
 public:
  explicit ContactMeasure(const ContactScene& scene);
  ~ContactMeasure();
  void take(int step, const std::vector<Placed>& bodies);  // after each step

  double penetration() const { return penetration_; }  // the deepest point, of the last step [m]
  double largest_penetration() const { return largest_; }
  // Boxes: the farthest that one of them is from its vertical at the start [m]. The ball: how far
  // it creeps in the last fifth of the run [m].
  double drift() const { return drift_; }

 private:
  struct Detection;
  ContactScene scene_;
  std::unique_ptr<Detection> detection_;
  Placed reference_{};
  double penetration_ = 0, largest_ = 0, drift_ = 0;
};

}  // namespace twinarm::speed
