// Tracking errors: simulation of KVR, couplings and DVR with the paper's measure, and linear
// theory.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "coupling/laws/coupling_spec.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

// One run, by step; joints of DrivenJoints::turned.
struct TrackingSeries {
  std::vector<double> t;                            // [s]
  std::vector<std::vector<double>> q_K, q_D;        // [joint][step], rad (m for a prismatic joint)
  std::vector<std::vector<double>> coupling_force;  // [spring of the main coupling][step], N or N m
  bool finite = true;                               // false: stopped, diverged
};
// The paper's measure |theta_K - theta_D| [rad] by joint: maximum over the samples, and time
// average (trapezoidal rule).
struct TrackingError {
  std::vector<double> max, mean;
};
TrackingError tracking_error(const TrackingSeries& series);

struct TrackingSetup {
  const Model<double>* kvr_model = nullptr;  // no added masses
  const Model<double>* dvr_model = nullptr;  // same tree, masses as simulated
  const OperatorMotion* motion = nullptr;
  OperatorMapping mapping;
  DrivenJoints joints;
  std::vector<CouplingSpec> couplings;  // forces of the first are recorded
  TargetRates kvr_rates = TargetRates::from_operator;
  Integrator integrator = Integrator::semi_implicit;
  double h = 0.001;  // [s]
};

// KVR, couplings and DVR; further force sources can be added to the simulation.
class TrackingSystem {
 public:
  // Throws InputError for invalid joints, couplings or step size.
  explicit TrackingSystem(const TrackingSetup& setup);
  Simulation& simulation() { return *simulation_; }
  TargetRobot& kvr() { return *kvr_; }
  Coupling& coupling(std::size_t c) { return *couplings_[c]; }
  std::size_t coupling_count() const { return couplings_.size(); }
  // Runs to the end of the motion. Calls `each_step`, if not empty, at every sample from t = 0 on.
  TrackingSeries run(const std::function<void(double t)>& each_step = {});

 private:
  void record(TrackingSeries& series);

  TrackingSetup setup_;
  std::unique_ptr<TargetRobot> kvr_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::unique_ptr<Coupling>> couplings_;
  std::vector<std::size_t> iq_;  // of the driven joints
};

// Linear theory of the tracking error e = q_K - q_D behind a moving target. One degree of freedom,
// relative damper:
//   e'' + 2 z w e' + w^2 e = a_K(t).
// A velocity step V of the target is e'(0) = V. An absolute damper adds 2 z w v_K(t) on the right.

// Maximum and mean |e_j| from 0 to `duration` [s] with velocity steps V of the target, from e = 0.
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

// Maximum |e| after a velocity step V, of one degree of freedom:
// (V/w) exp(-z acos(z)/sqrt(1 - z^2)), V/(e w) at z = 1.
double peak_after_jump(double V, double omega, double zeta);

// Steady-state error at constant target speed v with an absolute damper.
inline double absolute_damper_error(double v, double omega, double zeta) {
  return 2 * zeta * v / omega;
}
// MuJoCo's weld to a mocap body, dampratio 1: absolute damper with w = 1/timeconst.
inline double mocap_weld_error(double v, double timeconst) {  // 2 v timeconst
  return absolute_damper_error(v, 1 / timeconst, 1);
}

// Motion profiles from 0 to `distance` D in `time` T, at rest before and after.
enum class MotionProfile {
  ramp,       // constant speed, velocity steps at both ends
  cubic,      // D (3 s^2 - 2 s^3), s = t/T
  quintic,    // D (10 s^3 - 15 s^4 + 6 s^5)
  cosine,     // D (1 - cos pi s) / 2
  bang_bang,  // constant acceleration, then deceleration
};

// A segment of a profile: from `start` on, with s = t - start and W = pi/time, velocity and
// acceleration are sum_n power[n] s^n + c cos(W s) + d sin(W s). The last segment is the rest after
// the move.
struct ProfileSegment {
  struct Series {
    std::vector<double> power;
    double c = 0, d = 0;
  };
  double start = 0, jump = 0;  // time, and velocity step of the target at it
  Series acceleration, velocity;
};
std::vector<ProfileSegment> segments_of(MotionProfile move, double distance, double time);

}  // namespace twinarm
