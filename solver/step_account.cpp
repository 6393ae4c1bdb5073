#include "solver/step_account.h"

#include <algorithm>

#include "solver/integrator.h"

namespace twinarm {

StepAccount::StepAccount(const Model<double>& model, std::size_t loops)
    : model_(&model),
      moved_(bodies_that_forces_move(model)),
      w_(model),
      loops_(loops),
      stabilisation_(loops),
      mimics_(model.mimics.size()),
      flow_(kNumbers * loops + mimics_.size()),
      share_q_(loops, std::vector<double>(model.nv)),
      share_qd_(share_q_) {
  for (State<double>* x : {&seen_, &before_, &after_, &trial_}) {
    x->q.resize(model.nq);
    x->qd.resize(model.nv);
  }
}

void StepAccount::start_step() {
  std::fill(loops_.begin(), loops_.end(), Exchange{});
  std::fill(stabilisation_.begin(), stabilisation_.end(), Exchange{});
  std::fill(mimics_.begin(), mimics_.end(), 0);
  separation_ = {};
  pending_ = false;
}

void StepAccount::before_projection(const State<double>& x) {
  seen_.q = x.q;
  seen_.qd = x.qd;
}

void StepAccount::after_projection(const State<double>& x, const LoopProjection& projection) {
  if (x.q == seen_.q && x.qd == seen_.qd) {
    pending_ = pending_ && x.q == after_.q && x.qd == after_.qd;
    return;
  }
  std::swap(before_.q, seen_.q);
  std::swap(before_.qd, seen_.qd);
  after_.q = x.q;
  after_.qd = x.qd;
  for (std::size_t l = 0; l < stabilisation_.size(); ++l)
    projection.share_of(l, share_q_[l], share_qd_[l]);
  pending_ = true;
}

void StepAccount::count_projection() {
  if (!pending_) return;
  pending_ = false;
  const Exchange from = contents(before_);
  if (stabilisation_.size() == 1) {
    stabilisation_[0] += contents(after_) - from;
    return;
  }
  for (std::size_t l = 0; l < stabilisation_.size(); ++l) {
    integrate_coordinates(*model_, before_.q, share_q_[l], trial_.q);
    for (std::size_t d = 0; d < model_->nv; ++d) trial_.qd[d] = before_.qd[d] + share_qd_[l][d];
    stabilisation_[l] += contents(trial_) - from;
  }
}

void StepAccount::add_separation(const State<double>& before, const State<double>& after) {
  separation_ += contents(after) - contents(before);
}

void StepAccount::add_loop(std::size_t loop, const Exchange& on_a, bool in_flow) {
  if (!in_flow) {
    loops_[loop] += on_a;
    return;
  }
  double* sums = &flow_[kNumbers * loop];
  sums[0] += on_a.work;
  for (int c = 0; c < 3; ++c) sums[1 + c] += on_a.impulse[c], sums[4 + c] += on_a.moment[c];
}

void StepAccount::add_mimic(std::size_t mimic, double work, bool in_flow) {
  (in_flow ? flow_[kNumbers * loops_.size() + mimic] : mimics_[mimic]) += work;
}

void StepAccount::start_flow() {
  std::fill(flow_.begin(), flow_.end(), 0);
}

void StepAccount::count_flow() {
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    const double* sums = &flow_[kNumbers * l];
    loops_[l] += Exchange{sums[0], {sums[1], sums[2], sums[3]}, {sums[4], sums[5], sums[6]}};
  }
  for (std::size_t i = 0; i < mimics_.size(); ++i)
    mimics_[i] += flow_[kNumbers * loops_.size() + i];
  start_flow();
}

}  // namespace twinarm
