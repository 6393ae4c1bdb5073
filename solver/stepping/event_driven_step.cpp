#include "solver/stepping/event_driven_step.h"

#include <algorithm>
#include <cmath>

#include "solver/integration/friction_events.h"
#include "solver/model/configuration.h"

namespace twinarm {

// T_n,k+1 = T_n,k + (T_n,k - T_n-1,k) / (n / (n - k) - 1), the row before in columns_.
void ExtrapolationTable::add_row(std::vector<double>& values) {
  const std::size_t n = count_ + 1;
  for (std::size_t k = 0; k < count_; ++k) {
    std::vector<double>& before = columns_[k];
    const double part = static_cast<double>(n - k - 1) / static_cast<double>(k + 1);
    spare_.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      spare_[i] = values[i] + part * (values[i] - before[i]);
    std::swap(before, values);
    std::swap(values, spare_);
  }
  std::swap(columns_[count_++], values);
}

namespace {

constexpr double kMinLength = 1e-11;  // of a piece that must be good [s]
// Residuals of the impulses [m/s]: extrapolation multiplies what they leave by some hundreds.
constexpr double kGoodGuess = 1e-14, kAccepted = 1e-11, kAim = 1e-13;
// Of a piece, relative and absolute: well below EventSource::kMoves, else what rolls seems to slip.
constexpr double kTolerance = 1e-10;
constexpr double kFar = 1;  // stands for a gap that is not there [m]

}  // namespace

void EventStep::step(ConstrainedStep& constrained, IntegrationState& m, double h,
                     Interrupted interrupted, StepReport& report) {
  sources_.clear();
  for (ConstraintSource* source : constrained.system().sources)
    sources_.push_back(source->events());
  constrained.system().set_accuracy(kGoodGuess, kAccepted, kAim);
  constrained.start_report();
  m.begin_step(h);
  const double t_end = m.x.t + h;
  if (length_ <= 0) length_ = h;
  report.substeps = 0;
  laws_ = 0;
  interrupted_ = interrupted, is_interrupted_ = false;
  for (double left = h; left > 1e-15 * h; left = t_end - m.x.t) {
    const double s = piece(constrained, m, left, report);
    if (s == 0) {
      restore(m);
      report.interrupted = is_interrupted_;
      report.reached = !is_interrupted_;
      if (!is_interrupted_) finish(constrained, m, t_end, report);
      return;
    }
    m.x.t = s == left ? t_end : start_.t + s;
    m.refresh();
    if (m.account) m.account->count_flow(), m.account->count_projection();
    for (EventSource* source : sources_) source->commit_work();
    report.converged = report.converged && is_solved_;
    ++report.substeps;
    if (s == left) break;
  }
}

// Whether the piece is given up.
bool EventStep::stops() {
  if (!is_interrupted_ && interrupted_) is_interrupted_ = interrupted_();
  return is_interrupted_ || laws_ >= kMaxLaws;
}

// To the start of the piece.
void EventStep::restore(IntegrationState& m) {
  m.x = start_;
  forward_kinematics(*model_, m.x, m.k);
  for (EventSource* source : sources_) source->restore_active_set();
}

// The rest of the step at once; what is held in the next one is found anew.
void EventStep::finish(ConstrainedStep& constrained, IntegrationState& m, double t_end,
                       StepReport& report) {
  const bool is_converged = report.converged;
  constrained.system().set_usual_accuracy();
  constrained.step(m, t_end - m.x.t, report);
  m.x.t = t_end;
  m.refresh();
  constrained.system().begin_step(m, 0);
  for (EventSource* source : sources_) source->hold(frame(constrained, m), true);
  report.converged = report.converged && is_converged;
  report.located = false;
  ++report.substeps;
}

// What has come together is struck; the rest is held or free.
void EventStep::begin(ConstrainedStep& constrained, IntegrationState& m, double s) {
  constrained.system().begin_step(m, s);
  const bool struck = constrained.hit(m);
  for (EventSource* source : sources_) source->hold(frame(constrained, m), struck);
  start_ = m.x;
}

EventSource::NextEvent EventStep::look(ConstrainedStep& constrained,
                                       const IntegrationState& m) const {
  EventSource::NextEvent nearest;
  for (const EventSource* source : sources_) source->look(frame(constrained, m), nearest);
  nearest.gap = std::min(nearest.gap, kFar);
  return nearest;
}

// Moves m by a good piece, at most the longest; returns its length, or 0 where it is given up.
double EventStep::piece(ConstrainedStep& constrained, IntegrationState& m, double longest,
                        StepReport& report) {
  begin(constrained, m, longest);
  const EventSource::NextEvent ahead = look(constrained, m);
  double s = std::min(length_, longest);
  if (longest - s < 1e-3 * s) s = longest;  // no sliver is left over
  if (1.02 * ahead.time < s) s = std::max(1.02 * ahead.time, kMinLength);
  for (;; ++report.rejected) {
    const Piece found = cross(constrained, m, s);
    if (found == Piece::stopped) return 0;
    if (found != Piece::good && s <= kMinLength) {
      ++report.events;
      step_over_event(constrained, m, s);
      return s;
    }
    if (found == Piece::uneven) {
      s *= 0.5;
      continue;
    }
    if (found == Piece::inexact) {
      s *= std::clamp(0.9 * std::pow(error_, -1.0 / kColumns), 0.1, 0.7);
      continue;
    }
    constrained.system().begin_step(m, s);
    const EventSource::NextEvent end = look(constrained, m);
    if (end.gap >= 0) break;
    if (ahead.has_closing_contact && ahead.gap > 0 && ahead.gap < kFar) {
      ++report.events;
      length_ = std::max(s, kMinLength);
      return shorten(constrained, m, s, ahead.gap, end.gap);
    }
    if (s <= kMinLength) break;
    s *= 0.5;  // it was thrown up, and has come down again
  }
  const double grow =
      std::clamp(0.9 * std::pow(std::max(error_, 1e-10), -1.0 / kColumns), 0.2, 4.0);
  length_ = s * grow;
  return s;
}

double EventStep::shorten(ConstrainedStep& constrained, IntegrationState& m, double s,
                          double gap_start, double gap_end) {
  const double length = step_to_zero(s, gap_start, gap_end, [&](double trial) {
    m.x = start_;
    forward_kinematics(*model_, m.x, m.k);
    if (cross(constrained, m, trial) == Piece::stopped) return 0.0;  // ends the search
    constrained.system().begin_step(m, trial);
    return look(constrained, m).gap;
  });
  return stops() ? 0 : length;
}

// Over an event that is located: one step of the first order.
void EventStep::step_over_event(ConstrainedStep& constrained, IntegrationState& m, double s) {
  is_solved_ = true;
  modes_.clear();
  run_column(constrained, m, s, 1, Uneven::taken);
  go_to(m, values_, s);
}

// From start_ by s: m is there, whether the piece is good or not.
EventStep::Piece EventStep::cross(ConstrainedStep& constrained, IntegrationState& m, double s) {
  modes_.clear();
  is_solved_ = true;
  table_.clear();
  for (int n = 1; n <= kColumns; ++n) {
    if (!run_column(constrained, m, s, n, Uneven::refused))
      return stops() ? Piece::stopped : Piece::uneven;
    table_.add_row(values_);
  }
  const std::size_t nv = model_->nv;
  size_.resize(nv);
  coordinate_sizes(*model_, start_.q, size_);
  error_ = 0;
  const std::vector<double>&best = table_.best(), &next = table_.next_best();
  for (std::size_t i = 0; i < nv; ++i) {
    const double place = std::abs(best[i] - next[i]) / (1 + size_[i]);
    const double speed = std::abs(best[nv + i] - next[nv + i]) / (1 + std::abs(best[nv + i]));
    error_ = std::max({error_, place / kTolerance, speed / kTolerance});
    if (!std::isfinite(place + speed)) error_ = 1e300;
  }
  go_to(m, best, s);
  return error_ <= 1 ? Piece::good : Piece::inexact;
}

// n steps of the first order; false as soon as what is held does another thing than before, or the
// piece is given up.
bool EventStep::run_column(ConstrainedStep& constrained, IntegrationState& m, double s, int n,
                           Uneven uneven) {
  const std::size_t nv = model_->nv;
  const double step = s / n;
  m.x = start_;
  if (m.account) m.account->start_flow();
  for (EventSource* source : sources_) source->restore_active_set();
  theta_.assign(nv, 0);
  rate_.resize(nv);
  for (int i = 1; i <= n; ++i) {
    if (uneven == Uneven::refused && stops()) return false;
    shift_rate(*model_, theta_, m.x.qd, rate_);
    for (std::size_t dof = 0; dof < nv; ++dof) theta_[dof] += step * rate_[dof];
    integrate_coordinates(*model_, start_.q, theta_, m.x.q);
    m.x.t = start_.t + i * step;
    m.place_and_look();
    constrained.system().begin_step(m, 0);
    constrained.flow(m, step);
    laws_ += 1 + static_cast<long>(constrained.system().problem.constraints().size());
    is_solved_ = is_solved_ && constrained.report().step.converged;
    modes_now_.clear();
    for (EventSource* source : sources_) source->modes(modes_now_);
    if (n == 1) modes_ = modes_now_;
    const bool turns =
        std::count(modes_now_.begin(), modes_now_.end(), EventSource::Mode::turns) > 0;
    if (uneven == Uneven::refused && (turns || modes_now_ != modes_)) return false;
  }
  values_ = theta_;
  values_.insert(values_.end(), m.x.qd.begin(), m.x.qd.end());
  for (EventSource* source : sources_)
    values_.insert(values_.end(), source->works().begin(), source->works().end());
  if (m.account) values_.insert(values_.end(), m.account->flow().begin(), m.account->flow().end());
  return true;
}

void EventStep::go_to(IntegrationState& m, const std::vector<double>& row, double s) {
  const std::size_t nv = model_->nv;
  theta_.assign(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(nv));
  integrate_coordinates(*model_, start_.q, theta_, m.x.q);
  std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(nv), nv, m.x.qd.begin());
  m.x.t = start_.t + s;
  m.place_and_look();
  std::size_t next = 2 * nv;
  for (EventSource* source : sources_)
    for (double& work : source->works()) work = row[next++];
  if (m.account)
    for (double& sum : m.account->flow()) sum = row[next++];
}

}  // namespace twinarm
