// A tracking run: KVR, couplings and DVR put together, and what the paper measures of them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "coupling/laws/coupling_spec.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

// One run, by step: joint angles are those of DrivenJoints::turned.
struct TrackingSeries {
  std::vector<double> t;                      // [s]
  std::vector<std::vector<double>> q_K, q_D;  // [joint][step], rad (m for a prismatic joint)
  std::vector<std::vector<double>> pull;      // [spring of the main coupling][step], N or N m
  bool finite = true;                         // false: stopped where it left all bounds
};
// The paper's measure |theta_K - theta_D| [rad], per joint: maximum over the samples, and time
// average by the trapezoidal rule.
struct TrackingError {
  std::vector<double> max, mean;
};
TrackingError tracking_error(const TrackingSeries& series);

struct TrackingSetup {
  const Model<double>* kvr_model = nullptr;  // no added masses
  const Model<double>* dvr_model = nullptr;  // same tree, masses as simulated
  const OperatorMotion* hand = nullptr;
  HandMapping mapping;
  DrivenJoints joints;
  std::vector<CouplingSpec> couplings;  // the first is the one that is studied
  TargetRates kvr_rates = TargetRates::from_hand;
  Integrator integrator = Integrator::semi_implicit;
  double h = 0.001;  // [s]
};

// The system put together. Sources beside the couplings (contact, joint stops) can be added.
class TrackingSystem {
 public:
  // Throws InputError for joints, couplings or a step size that cannot be.
  explicit TrackingSystem(const TrackingSetup& setup);
  Simulation& simulation() { return *simulation_; }
  TargetRobot& kvr() { return *kvr_; }
  Coupling& coupling(std::size_t c) { return *couplings_[c]; }
  std::size_t coupling_count() const { return couplings_.size(); }
  // Runs to the hand's end. `each_step` is called at every sample, t = 0 included; it may be empty.
  TrackingSeries run(const std::function<void(double t)>& each_step = {});

 private:
  void record(TrackingSeries& series);

  TrackingSetup setup_;
  std::unique_ptr<TargetRobot> kvr_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::unique_ptr<Coupling>> couplings_;
  std::vector<std::size_t> iq_;  // of the turned joints
};

// How far a follower on a spring-damper stays behind a target that moves.
//
// One degree of freedom, e = q_K - q_D, a relative damper (it is given the target's velocity):
//   e'' + 2 z w e' + w^2 e = a_K(t).
// A jump V of the target's velocity is e'(0) = V. An absolute damper brakes the follower's own
// velocity: 2 z w v_K(t) stands on the right as well.

// Largest |e_j| after the target's velocity jumps by V (e = 0, e' = V), per coordinate; linear
// theory about the pose, within the given time [s].
Eigen::VectorXd peak_after_jump(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                                const Eigen::MatrixXd& B, const Eigen::VectorXd& V, double time);

// The same of several jumps, one after the other: largest and mean |e_j| from 0 to `duration` [s].
struct VelocityStep {
  double t = 0;
  Eigen::VectorXd V;
};
struct JumpErrors {
  Eigen::VectorXd peak, mean;
};
JumpErrors response_to_velocity_steps(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                                      const Eigen::MatrixXd& B,
                                      const std::vector<VelocityStep>& jumps, double duration);

// One degree of freedom: (V/w) exp(-z acos(z)/sqrt(1 - z^2)), V/(e w) at z = 1.
double peak_after_jump(double V, double omega, double zeta);

// Steady lag behind a target of constant speed v, of a damper that does not see that speed.
double absolute_damper_lag(double v, double omega, double zeta);  // 2 z v / w
// Of MuJoCo's weld to a mocap body, dampratio 1: an absolute damper with w = 1/timeconst.
double mocap_weld_lag(double v, double timeconst);  // 2 v timeconst

// Ways to move from 0 to `distance` in `time`, at rest before and after.
enum class MotionProfile {
  ramp,       // constant speed: it jumps at both ends
  cubic,      // D (3 s^2 - 2 s^3), s = t/T
  quintic,    // D (10 s^3 - 15 s^4 + 6 s^5)
  cosine,     // D (1 - cos pi s) / 2
  bang_bang,  // the largest acceleration, one half each way
};
const char* name_of(MotionProfile move);

// The move itself: from `start` on, with s = t - start and W = pi/time, velocity and acceleration
// are sum_n power[n] s^n + c cos(W s) + d sin(W s). The last piece is the rest after the move.
struct ProfileSegment {
  struct Series {
    std::vector<double> power;
    double c = 0, d = 0;
  };
  double start = 0, jump = 0;  // of the target's velocity at its start
  Series acceleration, velocity;
};
std::vector<ProfileSegment> pieces_of(MotionProfile move, double distance, double time);

// The closed-form error behind such a move, from rest with e = 0.
class FollowingError {
 public:
  enum class Damper { relative, absolute };
  FollowingError(MotionProfile move, double distance, double time, double omega, double zeta,
                 Damper damper = Damper::relative);
  // At a time t >= 0; after the move it dies out.
  double at(double t) const;
  // The largest |e| of all times.
  double peak() const;

 private:
  // f stands on the right; the particular solution has the same form.
  using Forcing = ProfileSegment::Series;
  struct Piece {
    double start = 0, jump = 0;  // of the target's velocity at its start
    Forcing right, particular;
    double e = 0, e_dot = 0;  // of the free motion at its start
  };
  void add_piece(const ProfileSegment& move);
  void solve();
  struct Motion {
    double e, e_dot;
  };
  Motion of_particular(const Piece& piece, double s) const;
  Motion free_motion(double e, double e_dot, double s) const;
  Motion in_piece(const Piece& piece, double s) const;

  double time_, omega_, zeta_, turn_;  // turn_: W [rad/s]
  Damper damper_;
  std::vector<Piece> pieces_;
};

}  // namespace twinarm
