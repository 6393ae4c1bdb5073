// Position limits in steps that locate their events in time (event_source.h).
#include <algorithm>
#include <cmath>

#include "solver/impulses/joint_limits.h"

namespace twinarm {

// Away from the limit.
double JointLimits::speed(const Row& row, const State<double>& x) const {
  return row.sign * x.qd[model_->iv[static_cast<std::size_t>(limits_[row.limit].body)]];
}

const JointLimits::Held* JointLimits::held(const Row& row) const {
  for (const Held& h : held_)
    if (h.limit == row.limit && h.sign == row.sign) return &h;
  return nullptr;
}

bool JointLimits::takes_part(const ConstraintFrame& frame, const Row& row) const {
  if (frame.phase == Phase::flow) return held(row) != nullptr;
  return frame.phase != Phase::hit || row.gap <= kClosed;
}

// Limits are plastic: in a step of fixed size they stop what comes in its second phase.
bool JointLimits::closes(const ConstraintFrame& frame) noexcept {
  if (frame.phase != Phase::hit) return false;
  return std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
    return row.gap <= kClosed && speed(row, frame.x) < -kRest;
  });
}

void JointLimits::hold(const ConstraintFrame& frame, bool struck) noexcept {
  held_before_.clear();
  for (const Row& row : rows_) {
    const Held* before = held(row);
    const bool goes_on = before && !before->opens && !struck;
    if (goes_on || (row.gap <= kClosed && speed(row, frame.x) <= kRest))
      held_before_.push_back({row.limit, row.sign});
  }
  std::swap(held_, held_before_);
  flow_works_.assign(held_.size(), 0);
}

void JointLimits::hold_again() noexcept {
  std::fill(flow_works_.begin(), flow_works_.end(), 0);
}

void JointLimits::look(const ConstraintFrame& frame, Nearest& nearest) const noexcept {
  for (const Row& row : rows_)
    if (!held(row)) nearest.see(row.gap, speed(row, frame.x));
}

void JointLimits::modes(std::vector<char>& modes) const noexcept {
  for (const Row& row : rows_)
    if (const Held* h = held(row)) modes.push_back(h->opens ? Mode::opens : Mode::rests);
}

void JointLimits::count_works() noexcept {
  for (std::size_t i = 0; i < held_.size(); ++i) limits_[held_[i].limit].work += flow_works_[i];
}

}  // namespace twinarm
