// A tracking run: KVR, couplings and DVR put together, and what the paper measures of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
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
  const HandSource* hand = nullptr;
  HandMapping mapping;
  DrivenJoints joints;
  std::vector<CouplingSpec> couplings;  // the first is the one that is studied
  KvrRates kvr_rates = KvrRates::from_hand;
  Integrator integrator = Integrator::semi_implicit;
  double h = 0.001;  // [s]
};

// The system put together. Sources beside the couplings (contact, joint stops) can be added.
class TrackingSystem {
 public:
  // Throws InputError for joints, couplings or a step size that cannot be.
  explicit TrackingSystem(const TrackingSetup& setup);
  Simulation& simulation() { return *simulation_; }
  KinematicRobot& kvr() { return *kvr_; }
  Coupling& coupling(std::size_t c) { return *couplings_[c]; }
  std::size_t coupling_count() const { return couplings_.size(); }
  // Runs to the hand's end. `each_step` is called at every sample, t = 0 included; it may be empty.
  TrackingSeries run(const std::function<void(double t)>& each_step = {});

 private:
  void record(TrackingSeries& series);

  TrackingSetup setup_;
  std::unique_ptr<KinematicRobot> kvr_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::unique_ptr<Coupling>> couplings_;
  std::vector<std::size_t> iq_;  // of the turned joints
};

}  // namespace twinarm
