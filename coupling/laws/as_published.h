// The two couplings as published (sections Torsional spring-damper and Linear spring-damper of the
// paper), and variants of single choices.
//
// Velocities are one-step backward differences between evaluations, zero at the first. Forces are
// evaluated once a step (or every hold_steps steps) and held.
//
// Torsional, per link: R_DK = R_D^-1 R_K; restoring torque k Ang(R_DK) about Axis(R_DK). The step
// rotation of each robot, divided by the interval, is interpreted as a rotation again, R_Dw and
// R_Kw; damping torque b Ang(R_Dw R_Kw^-1), an angle in [0, pi] (relative speeds are folded modulo
// 2 pi rad/s), about the axis of the KVR's step rotation, opposed to the restoring torque; zero
// without that axis.
//
// Linear, per added mass: F = k (T_K - T_D) - b (T'_D - T'_K).
#pragma once

#include <algorithm>

#include "coupling/laws/coupling.h"

namespace twinarm {

enum class Damper {
  folded,     // as published
  unsigned_,  // |w_K - w_D| about the KVR's axis, not folded
  vector_     // b (w_K - w_D), presumably intended
};
enum class Difference {
  per_second,  // (x_n - x_n-1) / h
  per_frame,   // not divided by h
  older        // (x_n-1 - x_n-2) / h: delayed by one frame
};

struct AsPublishedOptions {
  SpringSpace measure = SpringSpace::world;  // torsional only
  Damper damper = Damper::folded;            // torsional only
  // Torsional folded and unsigned: -1: damping torque against the KVR's motion (as published), +1:
  // along it.
  double damping_sign = -1;
  Difference difference = Difference::per_second;
  int hold_steps = 1;  // 0: as 1, at every step
};

// Common base. Pose: what the springs measure of each robot, a position or an orientation. The law
// (CRTP) has
//   Pose pose(spring, k) const
//   static Vector3 step_between(before, now)   of two poses
//   void evaluate(s, k, K, D, step_K, step_D, interval)
// The last one computes the spring's state from the poses and their differences over an interval
// [s].
template <class Law, class Pose>
class AsPublished : public Coupling {
 public:
  AsPublished(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr,
              const AsPublishedOptions& options, const Pose& none)
      : Coupling(spec, model, kvr), options_(options), past_(springs_.size(), {none, none}) {
    options_.hold_steps = std::max(1, options_.hold_steps);
  }

  void begin_step(const Kinematics& k, double t, double h) noexcept final {
    kvr_.begin_step(t, h);
    const bool first = steps_ == 0, due = steps_ % options_.hold_steps == 0;
    ++steps_;
    if (!due) return;
    Law& law = static_cast<Law&>(*this);
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      Past& past = past_[s];
      const Pose K = law.pose(springs_[s], kvr_.start().k), D = law.pose(springs_[s], k);
      const Vector3 old_step_K = past.step_K, old_step_D = past.step_D;
      past.step_K = first ? Vector3(Vector3::Zero()) : Law::step_between(past.K, K);
      past.step_D = first ? Vector3(Vector3::Zero()) : Law::step_between(past.D, D);
      past.K = K;
      past.D = D;
      const bool older = options_.difference == Difference::older;
      law.evaluate(s, k, K, D, older ? old_step_K : past.step_K, older ? old_step_D : past.step_D,
                   h * options_.hold_steps);
    }
  }
  void serialize(StateArchive& memory) final {
    Coupling::serialize(memory);
    memory.visit(steps_);
    for (Past& past : past_) {
      for (Pose* pose : {&past.K, &past.D})
        for (Eigen::Index c = 0; c < pose->size(); ++c) memory.visit((*pose)(c));
      memory.visit(past.step_K, past.step_D);
    }
  }

 protected:
  AsPublishedOptions options_;

 private:
  struct Past {  // of one spring: poses at the last evaluation, and their last differences
    Pose K, D;
    Vector3 step_K = Vector3::Zero(), step_D = Vector3::Zero();
  };
  std::vector<Past> past_;
  int steps_ = 0;
};

}  // namespace twinarm
