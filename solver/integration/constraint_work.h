// What constraints did in the last step, for the ledgers: kept where somebody asked for it
// (SimulationOptions::enable_constraint_work), and else not computed at all.
//
//   forces          of loops and followers in steps by impulses (constrained_step.h): an impulse p
//                   over rows J works p . J (v + v')/2 on what moves, which is exact where the
//                   coordinates stand still. What moves by a law is not in J, so a constraint to it
//                   works. In other steps the accelerations hold the forces (loop_forces.h).
//                   A projection of velocities is an impulse too, and is among them: in a step by
//                   impulses it has a part of the force that keeps to a curve.
//   stabilisation   projections of coordinates back to closed loops: the change of kinetic and
//                   potential energy and of momentum from before to after; of several loops each by
//                   its own share alone, so that what is of second order in the shift, an
//                   integrator's error, is nobody's
//   separation      of what penetrates, likewise
// Allocates in the constructor.
#pragma once

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
  EnergyMomentum contents(const State<double>& x) {
    return energy_and_momentum_of(*model_, moved_, x, w_);
  }

  // Around every projection. That of a state which is not taken is forgotten with the next; one
  // that moves nothing, of a state that came out of one, leaves that one pending.
  void before_projection(const State<double>& x);
  // `at_start` as evaluate() left it where the step found its forces.
  void after_projection(const State<double>& x, const LoopProjection& projection,
                        const LoopClosures& at_start);
  void count_projection();  // the last one, of the state that was taken
  void add_separation(const State<double>& before, const State<double>& after);

  // On link a of the loop; what it does to link b is in `work` too.
  void add_loop(std::size_t loop, const EnergyMomentum& on_a, bool in_flow);
  void add_mimic(std::size_t mimic, double work, bool in_flow);
  // Of the pieces of event_driven_step.h: sums of a column, which are extrapolated, then counted.
  void start_flow();
  std::vector<double>& flow() { return flow_; }
  void count_flow();

  const std::vector<EnergyMomentum>& loops() const { return loops_; }
  const std::vector<double>& mimics() const { return mimics_; }
  const std::vector<EnergyMomentum>& stabilisation() const { return stabilisation_; }  // by loop
  const EnergyMomentum& separation() const { return separation_; }
  // What projections did to the velocities, at one place each: two in a step of semi-implicit-xv,
  // else one; of steps that locate events the first two.
  struct Push {
    State<double> from, to;
  };
  std::span<const Push> pushes() const { return {pushes_.data(), push_count_}; }

 private:
  static constexpr std::size_t kNumbers = 7;  // of an Exchange
  const Model<double>* model_;
  std::vector<char> moved_;
  Workspace<double> w_;
  std::vector<EnergyMomentum> loops_, stabilisation_;
  std::vector<double> mimics_, flow_;
  EnergyMomentum separation_;
  State<double> seen_, before_, after_, trial_;
  std::vector<std::vector<double>> share_q_, share_qd_;  // by loop
  std::vector<EnergyMomentum> push_;                     // by loop, without work
  Eigen::VectorXd lambda_;
  std::array<Push, 2> pushes_;
  std::size_t push_count_ = 0;
  bool pending_ = false;
};

}  // namespace twinarm
