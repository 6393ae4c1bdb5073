// The two couplings exactly as the paper prints them (sections Torsional spring-damper and Linear
// spring-damper), with the variants that show what each choice costs.
//
// Both compute velocities as one-step backward differences between evaluations, zero at the first,
// are evaluated once a step (or every hold_steps steps) and held in between.
//
// Torsional, per link: R_DK = R_D^-1 R_K; restoring couple k Ang(R_DK) about Axis(R_DK). The step
// rotation of each robot, divided by the interval, is made a rotation again, R_Dw and R_Kw; damping
// couple b Ang(R_Dw R_Kw^-1), an angle in [0, pi] (so relative speeds fold modulo 2 pi rad/s),
// about the axis of the KVR's own step rotation, opposed to the restoring couple: no axis, no
// damping.
//
// Linear, per added mass: F = k (T_K - T_D) - b (T'_D - T'_K).
#pragma once

#include <algorithm>

#include "coupling/laws/coupling.h"

namespace twinarm {

enum class Damper {
  folded,     // as printed
  unsigned_,  // |w_K - w_D| about the KVR's axis, without the fold
  vector_     // b (w_K - w_D): what the paper must have meant
};
enum class Difference {
  per_second,  // (x_n - x_n-1) / h
  per_frame,   // not divided by h
  older        // (x_n-1 - x_n-2) / h: one frame of lag
};

struct AsPublishedOptions {
  SpringSpace measure = SpringSpace::world;  // torsional only
  Damper damper = Damper::folded;            // torsional only
  // Torsional folded and unsigned: -1 puts the damping couple against the KVR's motion (as printed:
  // opposed to the restoring couple of a DVR that lags), +1 along it.
  double damping_sign = -1;
  Difference difference = Difference::per_second;
  int hold_steps = 1;  // 0: as 1, at every step
};

// What both share. A pose is what the springs measure of each robot: a position, or an orientation.
// The law has, without virtual calls,
//   Pose pose(spring, k) const
//   static Vector3 step_between(before, now)   of two poses
//   void evaluate(s, k, K, D, step_K, step_D, interval)
// where the last one fills the spring's reading from the poses and their steps, an interval [s]
// apart.
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
      for (Vector3* v : {&past.step_K, &past.step_D}) memory.visit(*v);
    }
  }

 protected:
  AsPublishedOptions options_;

 private:
  struct Past {  // of one spring: poses at the last evaluation, and their last steps
    Pose K, D;
    Vector3 step_K = Vector3::Zero(), step_D = Vector3::Zero();
  };
  std::vector<Past> past_;
  int steps_ = 0;
};

}  // namespace twinarm
