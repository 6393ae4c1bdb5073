// Back to closed loops: coordinates with g(q) = 0, velocities with g' = 0.
//
// Accelerations that satisfy J qdd = -gamma keep g'' = 0; g and g' then drift by the error of the
// integrator. After every step, and at every stage of a step, the state is therefore moved to the
// closed one next to it (Hairer, Lubich, Wanner, Geometric Numerical Integration, IV.4; here in
// the metric of M):
//   q <- q exp(-M^-1 J^T G^-1 g)  until g = 0,     qd <- qd - M^-1 J^T G^-1 g'  until g' = 0,
// simplified Newton iterations. M, J and G are those where the step starts, and stay so for the
// whole step, for two reasons:
// - There the loops are closed, and G has its true rank. Of an open redundant loop the rows are
//   independent, by as much as it is open; nothing may be solved with that.
// - With p the projection, the stages of a Runge-Kutta method look at f(p(q, qd)). For one p
//   that is
//   one smooth vector field around the closed states, which agrees with f on them: the method has
//   its full order on it. (With M and J of the last stage p changes from stage to stage by O(h),
//   and RK4 was seen to fall to order 3.)
// Only where the iterations do not converge, as J changes too much when a singular place is
// passed, all are formed anew on the spot. At a singular place itself the direction of motion is
// not determined; steps of fixed size pass over it. dopri5 may take it for an error that shorter
// steps would lessen, and stop there (StepReport::reached).
#pragma once

#include <vector>

#include "solver/loops/loop_forces.h"

namespace twinarm {

class LoopProjection {
 public:
  explicit LoopProjection(const Model<double>& model)
      : model_(&model),
        forces_(model),
        q_before_(model.nq),
        qd_before_(model.nv),
        shift_(model.nv),
        moved_q_(model.nv),
        moved_qd_(model.nv) {}
  void set_loops(LoopClosures loops) {
    pushed_q_.assign(loops.rows(), 0);
    pushed_qd_.assign(loops.rows(), 0);
    forces_.set_loops(std::move(loops));
  }

  // The step starts at x, where `prepared` was; `held` velocities stay as they are.
  void start(const ConstraintForceSolver& prepared, const std::vector<std::size_t>& held,
             const State<double>& x, const Kinematics& k, Workspace<double>& w) noexcept;
  // Moves x, of which k is the kinematics, and k. w: of any aba() near by, for held velocities that
  // are others than at the start. Returns how far open the widest loop is left, in any row of g.
  double operator()(const std::vector<std::size_t>& held, State<double>& x, Kinematics& k,
                    Workspace<double>& w) noexcept;
  // By how much the last call did so, by velocity: the part of an integrator's error that it
  // mended.
  const std::vector<double>& moved_q() const { return moved_q_; }
  const std::vector<double>& moved_qd() const { return moved_qd_; }
  const std::vector<double>& pushed_qd() const {
    return pushed_qd_;
  }  // impulses of the loops' rows
  // The share of one loop in both, of the last call.
  void share_of(std::size_t loop, std::vector<double>& dq, std::vector<double>& dqd) const {
    forces_.shift_of(loop, pushed_q_, dq);
    forces_.shift_of(loop, pushed_qd_, dqd);
  }

 private:
  struct At;
  template <class Size, class Move, class Restore>
  void iterate(const At& at, double rounding, Size&& size, Move&& move, Restore&& restore);

  const Model<double>* model_;
  ConstraintForceSolver forces_;
  std::vector<double> q_before_, qd_before_, shift_, moved_q_, moved_qd_;
  std::vector<double> pushed_q_, pushed_qd_;  // by row of the loops: lambda of all corrections
};

}  // namespace twinarm
