// Projection to the constraint manifold: positions with g(q) = 0, velocities with g' = 0.
//
// Accelerations with J qdd = -gamma keep g'' = 0; g and g' drift by the integrator's error. After
// every step and at every stage the state is projected (Hairer, Lubich, Wanner, Geometric Numerical
// Integration, IV.4; here in the metric of M) by simplified Newton iterations:
//   q <- q exp(-M^-1 J^T G^-1 g)  until g = 0,     qd <- qd - M^-1 J^T G^-1 g'  until g' = 0.
// M, J and G are those at the start of the step, for two reasons:
// - There the loops are closed and G has its true rank. Rows of an open redundant loop are
//   independent by the amount of its position error.
// - With p the projection, the stages of a Runge-Kutta method evaluate f(p(q, qd)). For a constant
//   p this is a smooth vector field that agrees with f on the manifold, and the method has its full
//   order. (With M and J of the last stage, RK4 was observed to drop to order 3.)
// If the iteration does not converge (J changes strongly near a singular configuration), M, J and G
// are recomputed. At a singular configuration the direction of motion is undetermined: fixed steps
// pass over it, dopri5 may reduce its substeps until it stops (StepReport::reached).
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
        delta_(model.nv),
        correction_q_(model.nv),
        correction_qd_(model.nv) {}
  void set_loops(LoopClosures loops) {
    lambda_q_.assign(loops.rows(), 0);
    lambda_qd_.assign(loops.rows(), 0);
    forces_.set_loops(std::move(loops));
  }

  // The step starts at x, the state of prepared.prepare(); `held` velocities are not changed.
  void start(const ConstraintForceSolver& prepared, const std::vector<std::size_t>& held,
             const State<double>& x, const Kinematics& k, Workspace<double>& w) noexcept;
  // Projects x and updates its kinematics k. w: of an aba() nearby, used if `held` differs from the
  // start. Returns the maximum |g| that is left.
  double operator()(const std::vector<std::size_t>& held, State<double>& x, Kinematics& k,
                    Workspace<double>& w) noexcept;
  // Corrections of the last call, by velocity.
  const std::vector<double>& correction_q() const { return correction_q_; }
  const std::vector<double>& correction_qd() const { return correction_qd_; }
  const std::vector<double>& lambda_qd() const { return lambda_qd_; }  // impulses of the rows
  // Contribution of one loop to both corrections.
  void correction_of_loop(std::size_t loop, std::vector<double>& dq, std::vector<double>& dqd) {
    forces_.correction_of_loop(loop, lambda_q_, dq);
    forces_.correction_of_loop(loop, lambda_qd_, dqd);
  }

 private:
  struct At;
  template <class Norm, class Correct, class Revert>
  void iterate(const At& at, double rounding, Norm&& norm, Correct&& correct, Revert&& revert);

  const Model<double>* model_;
  ConstraintForceSolver forces_;
  std::vector<double> q_before_, qd_before_, delta_, correction_q_, correction_qd_;
  std::vector<double> lambda_q_, lambda_qd_;  // by row of the loops: sums over all iterations
};

}  // namespace twinarm
