#include "solver/integration/constraint_work.h"

#include "solver/model/configuration.h"

namespace twinarm {
namespace {

bool is_same(const State<double>& a, const State<double>& b) {
  return a.q == b.q && a.qd == b.qd && a.prescribed == b.prescribed;
}

}  // namespace

ConstraintWork::ConstraintWork(const Model<double>& model, std::size_t loops, std::size_t rows)
    : model_(&model),
      moved_(bodies_with_dofs(model)),
      w_(model),
      loops_(loops),
      stabilisation_(loops),
      mimics_(model.mimics.size()),
      segment_(kNumbers * loops + mimics_.size()),
      share_q_(loops, std::vector<double>(model.nv)),
      share_qd_(share_q_),
      impulse_(loops),
      lambda_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows))) {
  for (State<double>* x : {&unprojected_, &before_, &after_, &trial_, &projections_[0].from,
                           &projections_[0].to, &projections_[1].from, &projections_[1].to})
    *x = State<double>(model);
}

void ConstraintWork::start_step() {
  std::fill(loops_.begin(), loops_.end(), EnergyMomentum{});
  std::fill(stabilisation_.begin(), stabilisation_.end(), EnergyMomentum{});
  std::fill(mimics_.begin(), mimics_.end(), 0);
  separation_ = sleep_ = {};
  count_ = 0;
  pending_ = false;
}

void ConstraintWork::after_projection(const State<double>& x, LoopProjection& projection,
                                      const LoopClosures& at_start) {
  if (is_same(x, unprojected_)) {
    pending_ = pending_ && is_same(x, after_);
    return;
  }
  std::swap(before_, unprojected_);
  after_ = x;
  const std::vector<double>& lambda = projection.lambda_qd();
  for (std::size_t r = 0; r < lambda.size(); ++r) lambda_[static_cast<Eigen::Index>(r)] = lambda[r];
  for (std::size_t l = 0; l < stabilisation_.size(); ++l) {
    projection.correction_of_loop(l, share_q_[l], share_qd_[l]);
    const LoopWrench wrench = at_start.wrench(l, lambda_);
    impulse_[l] = {};
    impulse_[l].add_wrench(1, at_start.point(l), wrench.force, wrench.couple);
  }
  pending_ = true;
}

// The kinetic energy is quadratic in v: with the mean of the velocities before and after, the works
// of the loops add up to its change.
void ConstraintWork::add_projection() {
  if (!pending_) return;
  pending_ = false;
  if (count_ < projections_.size()) {
    Projection& projection = projections_[count_++];
    projection.from = projection.to = after_;
    projection.from.qd = before_.qd;
  }
  const EnergyMomentum from = energy_momentum(before_);
  for (std::size_t l = 0; l < stabilisation_.size(); ++l) {
    integrate_coordinates(*model_, before_.q, share_q_[l], trial_.q);
    trial_.qd = before_.qd;
    trial_.prescribed = before_.prescribed;
    stabilisation_[l] += energy_momentum(trial_) - from;
    trial_.q = after_.q;
    for (const double side : {1.0, -1.0}) {
      for (std::size_t d = 0; d < model_->nv; ++d)
        trial_.qd[d] = 0.5 * (before_.qd[d] + after_.qd[d] + side * share_qd_[l][d]);
      impulse_[l].work += side * energy_momentum(trial_).work;
    }
    loops_[l] += impulse_[l];
  }
}

void ConstraintWork::add_loop(std::size_t loop, const EnergyMomentum& on_a, bool in_segment) {
  if (!in_segment) {
    loops_[loop] += on_a;
    return;
  }
  double* sums = &segment_[kNumbers * loop];
  sums[0] += on_a.work;
  for (int c = 0; c < 3; ++c) sums[1 + c] += on_a.impulse[c], sums[4 + c] += on_a.moment[c];
}

void ConstraintWork::add_segment() {
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    const double* sums = &segment_[kNumbers * l];
    loops_[l] += EnergyMomentum{sums[0], {sums[1], sums[2], sums[3]}, {sums[4], sums[5], sums[6]}};
  }
  for (std::size_t i = 0; i < mimics_.size(); ++i)
    mimics_[i] += segment_[kNumbers * loops_.size() + i];
  start_segment();
}

}  // namespace twinarm
