// A mechanism put together: close_loops() of loop_closure.h.
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
// The longest step in any velocity's direction: Newton's far away point anywhere [rad, m].
constexpr double kLongest = 0.5;

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
        shift_(model.nv),
        scaled_(model.nv) {
    forces_.set_loops(LoopClosures(model, loops));
    apply_mimics(model_, x_);
  }

  State<double> run() {
    double open = look(x_);
    for (int n = 0; n < kMaxSteps && open > kAssemblyRounding; ++n) {
      // Of rows that are open by some angle, what is below its square is not known.
      prepare(std::max(PivotedCholesky::kDependent, std::min(1e-4, open * open)));
      forces_.correction(forces_.loops().g(), shift_);
      const double then = search(open);
      if (!(then < open)) break;
      x_ = trial_;
      open = then;
    }
    look(x_);
    prepare(PivotedCholesky::kDependent);
    forces_.correction(forces_.loops().rate(), shift_);
    for (std::size_t d = 0; d < model_.nv; ++d) x_.qd[d] += shift_[d];
    apply_mimics(model_, x_);
    return x_;
  }

 private:
  double look(const State<double>& x) {
    forward_kinematics(model_, x, k_);
    forces_.loops().evaluate(x, k_);
    return forces_.loops().g().norm();
  }
  void prepare(double tolerance) {
    aba(model_, x_, none_, w_);
    forces_.prepare(w_, {}, tolerance);
  }
  // trial_ along the shift, shorter and shorter until loops are less open; how open there.
  double search(double open) {
    double longest = 0;
    for (const double s : shift_) longest = std::max(longest, std::abs(s));
    double part = longest > kLongest ? kLongest / longest : 1, then = open;
    for (int tries = 0; tries < 30 && !(then < open); ++tries, part /= 2) {
      for (std::size_t d = 0; d < model_.nv; ++d) scaled_[d] = part * shift_[d];
      integrate_coordinates(model_, x_.q, scaled_, trial_.q);
      trial_.qd = x_.qd;
      apply_mimics(model_, trial_);
      then = look(trial_);
    }
    return then;
  }

  const Model<double>& model_;
  State<double> x_, trial_;
  Kinematics k_;
  Workspace<double> w_;
  Forces<double> none_;
  ConstraintForceSolver forces_;
  std::vector<double> shift_, scaled_;
};

}  // namespace

State<double> close_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                          State<double> x) {
  State<double> closed = Assembly(model, loops, std::move(x)).run();
  check_loops(model, loops, closed);
  return closed;
}

}  // namespace twinarm
