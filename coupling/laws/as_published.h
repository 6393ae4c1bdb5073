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

struct PrintedOptions {
  Measure measure = Measure::world;  // torsional only
  Damper damper = Damper::folded;    // torsional only
  // Torsional folded and unsigned: -1 puts the damping couple against the KVR's motion (as printed:
  // opposed to the restoring couple of a DVR that lags), +1 along it.
  double damping_sign = -1;
  Difference difference = Difference::per_second;
  int hold_steps = 1;  // 0: as 1, at every step
};

class PrintedTorsional final : public Coupling {
 public:
  PrintedTorsional(std::string name, const Model<double>& model, KinematicRobot& kvr,
                   std::vector<Spring> springs, PrintedOptions options);
  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  // Of the vector damper. The folded and the unsigned one have no linear part: B_q = 0.
  JointSpace joint_space(const Kinematics& k) const override;
  void visit_memory(Memory& memory) override;

 private:
  struct Past {  // of one spring: orientations (or joint turns) at the last evaluations
    Matrix3 R_K = Matrix3::Identity(), R_D = Matrix3::Identity();
    Vector3 step_K = Vector3::Zero(), step_D = Vector3::Zero();  // last step rotations, world
  };
  Matrix3 orientation(const Spring& spring, const Kinematics& k) const;
  Vector3 damping(const Spring& spring, const Vector3& step_K, const Vector3& step_D,
                  double interval) const;

  PrintedOptions options_;
  std::vector<Past> past_;
  int steps_ = 0;
};

class PrintedLinear final : public Coupling {
 public:
  PrintedLinear(std::string name, const Model<double>& model, KinematicRobot& kvr,
                std::vector<Spring> springs, PrintedOptions options);
  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  JointSpace joint_space(const Kinematics& k) const override;
  void visit_memory(Memory& memory) override;

 private:
  struct Past {  // of one spring: mass positions at the last evaluation, and their last steps
    Vector3 p_K = Vector3::Zero(), p_D = Vector3::Zero();
    Vector3 step_K = Vector3::Zero(), step_D = Vector3::Zero();
  };
  PrintedOptions options_;
  std::vector<Past> past_;
  int steps_ = 0;
};

}  // namespace twinarm
