// Assembly of a mechanism with loops: close_loops() of loop_closure.h.
#include <algorithm>
#include <cmath>

#include "solver/dynamics/dynamics.h"
#include "solver/loops/loop_closure.h"
#include "solver/loops/loop_forces.h"
#include "solver/model/configuration.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

constexpr int kMaxSteps = 200;
constexpr double kAssemblyRounding = 1e-15;
constexpr double kMaxNewtonStep = 0.5;  // per velocity [rad, m]

class Assembly {
 public:
  Assembly(const Model<double>& model, const std::vector<LoopClosure>& loops, State<double> start)
      : model_(model),
        x_(std::move(start)),
        trial_(x_),
        k_(model),
        w_(model),
        none_(model),
        forces_(model),
        delta_(model.nv),
        scaled_(model.nv) {
    forces_.set_loops(LoopClosures(model, loops));
    apply_mimics(model_, x_);
  }

  State<double> run() {
    double error = error_at(x_);
    for (int n = 0; n < kMaxSteps && error > kAssemblyRounding; ++n) {
      // An error of `error` rad in the rows is error^2 in G.
      prepare(std::max(PivotedCholesky::kDependent, std::min(1e-4, error * error)));
      forces_.correction(forces_.loops().g(), delta_);
      const double after = line_search(error);
      if (!(after < error)) break;
      x_ = trial_;
      error = after;
    }
    error_at(x_);
    prepare(PivotedCholesky::kDependent);
    forces_.correction(forces_.loops().rate(), delta_);
    for (std::size_t d = 0; d < model_.nv; ++d) x_.qd[d] += delta_[d];
    apply_mimics(model_, x_);
    return x_;
  }

 private:
  double error_at(const State<double>& x) {
    forward_kinematics(model_, x, k_);
    forces_.loops().evaluate(x, k_);
    return forces_.loops().g().norm();
  }
  void prepare(double tolerance) {
    aba(model_, x_, none_, w_);
    forces_.prepare(w_, {}, tolerance);
  }
  // Backtracking along delta_ until the error decreases; sets trial_ and returns its error.
  double line_search(double error) {
    double longest = 0;
    for (const double s : delta_) longest = std::max(longest, std::abs(s));
    double step = longest > kMaxNewtonStep ? kMaxNewtonStep / longest : 1, after = error;
    for (int tries = 0; tries < 30 && !(after < error); ++tries, step /= 2) {
      for (std::size_t d = 0; d < model_.nv; ++d) scaled_[d] = step * delta_[d];
      integrate_coordinates(model_, x_.q, scaled_, trial_.q);
      trial_.qd = x_.qd;
      apply_mimics(model_, trial_);
      after = error_at(trial_);
    }
    return after;
  }

  const Model<double>& model_;
  State<double> x_, trial_;
  Kinematics k_;
  Workspace<double> w_;
  Forces<double> none_;
  ConstraintForceSolver forces_;
  std::vector<double> delta_, scaled_;
};

}  // namespace

State<double> close_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                          State<double> x) {
  State<double> closed = Assembly(model, loops, std::move(x)).run();
  check_loops(model, loops, closed);
  return closed;
}

}  // namespace twinarm
