// Work, impulse and angular impulse of constraints in the last step, for the energy and momentum
// balance. Computed only if SimulationOptions::enable_constraint_work is set.
//
//   forces          of loops and mimic joints in constrained steps (constrained_step.h): an impulse
//                   p with rows J does the work p . J (v + v')/2, exact for constant coordinates.
//                   Constraints to prescribed bodies do work, as their motion is not in J. Includes
//                   velocity projections, which are impulses too. In other steps the constraint
//                   forces act through the accelerations (loop_forces.h).
//   stabilisation   position projections: change of kinetic and potential energy and of momentum.
//                   For several loops each by its own correction alone; terms of second order in
//                   the corrections (integration error) belong to no loop.
//   separation      position correction of penetrating contacts and limits, likewise
//   sleep           velocities that island_sleep.h drops, likewise
// Allocates in the constructor.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "solver/dynamics/energy_momentum.h"
#include "solver/loops/loop_projection.h"

namespace twinarm {

class ConstraintWork {
 public:
  // The model must outlive it.
  ConstraintWork(const Model<double>& model, std::size_t loops, std::size_t rows);

  void start_step();
  EnergyMomentum energy_momentum(const State<double>& x) {
    return energy_and_momentum_of(*model_, moved_, x, w_);
  }

  // Called around every projection. A later projection replaces the pending one, unless it changes
  // nothing in the pending one's result.
  void before_projection(const State<double>& x) { unprojected_ = x; }
  // `at_start`: loops as evaluated at the start of the step.
  void after_projection(const State<double>& x, LoopProjection& projection,
                        const LoopClosures& at_start);
  void add_projection();  // adds the pending one
  void add_separation(const State<double>& before, const State<double>& after) {
    separation_ += energy_momentum(after) - energy_momentum(before);
  }

  void add_sleep(const State<double>& before, const State<double>& after) {
    sleep_ = energy_momentum(after) - energy_momentum(before);
  }

  // Impulse on link a; `work` includes that on link b.
  void add_loop(std::size_t loop, const EnergyMomentum& on_a, bool in_segment);
  void add_mimic(std::size_t mimic, double work, bool in_segment) {
    (in_segment ? segment_[kNumbers * loops_.size() + mimic] : mimics_[mimic]) += work;
  }
  // Segments of event_driven_step.h: sums of one column, extrapolated by the caller, then added.
  void start_segment() { std::fill(segment_.begin(), segment_.end(), 0); }
  std::vector<double>& segment() { return segment_; }
  void add_segment();

  const std::vector<EnergyMomentum>& loops() const { return loops_; }
  const std::vector<double>& mimics() const { return mimics_; }
  const std::vector<EnergyMomentum>& stabilisation() const { return stabilisation_; }  // by loop
  const EnergyMomentum& separation() const { return separation_; }
  const EnergyMomentum& sleep() const { return sleep_; }
  // Velocity projections at constant q: two in a step of semi-implicit-xv, else one; of
  // event-driven steps the first two.
  struct Projection {
    State<double> from, to;
  };
  std::span<const Projection> projections() const { return {projections_.data(), count_}; }

 private:
  static constexpr std::size_t kNumbers = 7;  // of an EnergyMomentum
  const Model<double>* model_;
  std::vector<char> moved_;
  Workspace<double> w_;
  std::vector<EnergyMomentum> loops_, stabilisation_;
  std::vector<double> mimics_, segment_;
  EnergyMomentum separation_, sleep_;
  State<double> unprojected_, before_, after_, trial_;
  std::vector<std::vector<double>> share_q_, share_qd_;  // corrections by loop
  std::vector<EnergyMomentum> impulse_;                  // by loop
  Eigen::VectorXd lambda_;
  std::array<Projection, 2> projections_;
  std::size_t count_ = 0;  // of projections_
  bool pending_ = false;
};

}  // namespace twinarm
