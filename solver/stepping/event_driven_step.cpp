#include "solver/stepping/event_driven_step.h"

#include <algorithm>
#include <cmath>

#include "solver/integration/friction_events.h"
#include "solver/model/configuration.h"

namespace twinarm {

// T_n,k+1 = T_n,k + (T_n,k - T_n-1,k) / (n / (n - k) - 1), with the previous row in columns_.
void ExtrapolationTable::add_row(std::vector<double>& values) {
  const std::size_t n = count_ + 1;
  for (std::size_t k = 0; k < count_; ++k) {
    std::vector<double>& before = columns_[k];
    const double factor = static_cast<double>(n - k - 1) / static_cast<double>(k + 1);
    spare_.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      spare_[i] = values[i] + factor * (values[i] - before[i]);
    std::swap(before, values);
    std::swap(values, spare_);
  }
  std::swap(columns_[count_++], values);
}

namespace {

constexpr double kMinLength = 1e-11;  // of a segment [s]
// Residuals of the impulses [m/s]: extrapolation amplifies them by some hundreds.
constexpr double kGoodGuess = 1e-14, kAccepted = 1e-11, kSolverTolerance = 1e-13;
// Of a segment, relative and absolute: well below EventSource::kMoves, so that rolling contacts do
// not appear to slide.
constexpr double kTolerance = 1e-10;
constexpr double kNoGap = 1;  // gap if there is none [m]

}  // namespace

void EventStep::step(ConstrainedStep& constrained, IntegrationState& m, double h,
                     Interrupted interrupted, StepReport& report) {
  constrained_ = &constrained, m_ = &m;
  sources_.clear();
  for (ConstraintSource* source : constrained_->system().sources)
    sources_.push_back(source->events());
  constrained_->system().set_accuracy(kGoodGuess, kAccepted, kSolverTolerance);
  constrained_->start_report();
  m_->begin_step(h);
  const double t_end = m_->x.t + h;
  if (length_ <= 0) length_ = h;
  report.substeps = 0;
  solves_ = 0, laws_ = 0;
  interrupted_ = interrupted, is_interrupted_ = false;
  for (double left = h; left > 1e-15 * h; left = t_end - m_->x.t) {
    const double s = smooth_segment(left, report);
    report.iterations = solves_;
    if (s == 0) {
      restore_segment_start();
      report.interrupted = is_interrupted_;
      report.reached = !is_interrupted_;
      if (!is_interrupted_) finish(t_end, report);
      return;
    }
    m_->x.t = s == left ? t_end : start_.t + s;
    m_->project_and_update();
    if (m_->account) m_->account->add_segment(), m_->account->add_projection();
    for (EventSource* source : sources_) source->commit_work();
    report.converged = report.converged && is_solved_;
    ++report.substeps;
    if (s == left) break;
  }
}

void EventStep::restore_segment_start() {
  m_->x = start_;
  forward_kinematics(m_->model(), m_->x, m_->k);
  for (EventSource* source : sources_) source->restore_active_set();
}

// The remainder as one step of fixed size; then a new active set.
void EventStep::finish(double t_end, StepReport& report) {
  const bool is_converged = report.converged;
  const int solved = report.iterations;
  constrained_->system().set_default_accuracy();
  constrained_->step(*m_, t_end - m_->x.t, report);
  m_->x.t = t_end;
  m_->project_and_update();
  constrained_->system().begin_step(*m_, 0);
  for (EventSource* source : sources_) source->set_active_set(frame(), true);
  report.converged = report.converged && is_converged;
  report.iterations += solved;
  report.located = false;
  ++report.substeps;
}

// Resolves impacts of closed gaps, then sets the active set.
void EventStep::begin_segment(double s) {
  constrained_->system().begin_step(*m_, s);
  const bool impact = constrained_->resolve_impacts_now(*m_);
  for (EventSource* source : sources_) source->set_active_set(frame(), impact);
  start_ = m_->x;
}

EventSource::NextEvent EventStep::next_event() const {
  EventSource::NextEvent next;
  for (const EventSource* source : sources_) source->find_next_event(frame(), next);
  next.gap = std::min(next.gap, kNoGap);
  return next;
}

// Advances m_ by an accepted segment of at most max_length; returns its length, 0 if stopped.
double EventStep::smooth_segment(double max_length, StepReport& report) {
  begin_segment(max_length);
  const EventSource::NextEvent ahead = next_event();
  double s = std::min(length_, max_length);
  if (max_length - s < 1e-3 * s) s = max_length;  // avoids a tiny remainder
  if (1.02 * ahead.time < s) s = std::max(1.02 * ahead.time, kMinLength);
  for (;; ++report.rejected) {
    const Segment result = integrate_segment(s);
    if (result == Segment::stopped) return 0;
    if (result != Segment::accepted && s <= kMinLength) {
      ++report.events;
      step_over_event(s);
      return s;
    }
    if (result == Segment::mode_changed) {
      s *= 0.5;
      continue;
    }
    if (result == Segment::inexact) {
      s *= std::clamp(0.9 * std::pow(error_, -1.0 / kColumns), 0.1, 0.7);
      continue;
    }
    constrained_->system().begin_step(*m_, s);
    const EventSource::NextEvent end = next_event();
    if (end.gap >= 0) break;
    if (ahead.has_closing_contact && ahead.gap > 0 && ahead.gap < kNoGap) {
      ++report.events;
      length_ = std::max(s, kMinLength);
      return locate_contact(s, ahead.gap, end.gap);
    }
    if (s <= kMinLength) break;
    s *= 0.5;  // a gap opened and closed again
  }
  const double grow =
      std::clamp(0.9 * std::pow(std::max(error_, 1e-10), -1.0 / kColumns), 0.2, 4.0);
  length_ = s * grow;
  return s;
}

double EventStep::locate_contact(double s, double gap_start, double gap_end) {
  const double length = locate_zero(s, gap_start, gap_end, [&](double trial) {
    m_->x = start_;
    forward_kinematics(m_->model(), m_->x, m_->k);
    if (integrate_segment(trial) == Segment::stopped) return 0.0;  // ends the search
    constrained_->system().begin_step(*m_, trial);
    return next_event().gap;
  });
  return stops() ? 0 : length;
}

// One first-order step over a located event.
void EventStep::step_over_event(double s) {
  run_column(s, 1, ModeChange::accepted);
  set_state(values_, s);
}

// From start_ by s by extrapolation; m_ is set to the result, accepted or not.
EventStep::Segment EventStep::integrate_segment(double s) {
  for (EventSource* source : sources_) source->hold_sticking();
  table_.clear();
  for (int n = 1; n <= kColumns; ++n) {
    if (run_column(s, n, ModeChange::rejected)) {
      table_.add_row(values_);
      continue;
    }
    if (stops()) return Segment::stopped;
    if (!has_mode(EventSource::released)) return Segment::mode_changed;
    table_.clear();
    n = 0;  // again, with Coulomb's law
  }
  const std::size_t nv = m_->model().nv;
  size_.resize(nv);
  coordinate_sizes(m_->model(), start_.q, size_);
  error_ = 0;
  const std::vector<double>&best = table_.best(), &next = table_.next_best();
  for (std::size_t i = 0; i < nv; ++i) {
    const double q_error = std::abs(best[i] - next[i]) / (1 + size_[i]);
    const double qd_error = std::abs(best[nv + i] - next[nv + i]) / (1 + std::abs(best[nv + i]));
    error_ = std::max({error_, q_error / kTolerance, qd_error / kTolerance});
    if (!std::isfinite(q_error + qd_error)) error_ = 1e300;
  }
  set_state(best, s);
  return error_ <= 1 ? Segment::accepted : Segment::inexact;
}

// n first-order steps; false if a contact mode changes and this is rejected, or if stopped.
bool EventStep::run_column(double s, int n, ModeChange mode_change) {
  const bool rejects = mode_change == ModeChange::rejected;
  const std::size_t nv = m_->model().nv;
  const double step = s / n;
  if (n == 1) is_solved_ = true;
  m_->x = start_;
  if (m_->account) m_->account->start_segment();
  for (EventSource* source : sources_) source->restore_active_set();
  theta_.assign(nv, 0);
  rate_.resize(nv);
  for (int i = 1; i <= n; ++i) {
    if (rejects && stops()) return false;
    tangent_rate(m_->model(), theta_, m_->x.qd, rate_);
    for (std::size_t dof = 0; dof < nv; ++dof) theta_[dof] += step * rate_[dof];
    integrate_coordinates(m_->model(), start_.q, theta_, m_->x.q);
    m_->x.t = start_.t + i * step;
    m_->update_kinematics();
    constrained_->system().begin_step(*m_, 0);
    constrained_->smooth_step(*m_, step);
    ++solves_;
    laws_ += 1 + static_cast<long>(constrained_->system().problem.constraints().size());
    is_solved_ = is_solved_ && constrained_->report().step.converged;
    modes_now_.clear();
    for (EventSource* source : sources_) source->append_modes(modes_now_);
    if (n == 1) modes_ = modes_now_;
    if (rejects && (has_mode(EventSource::reversing) || has_mode(EventSource::released) ||
                    modes_now_ != modes_))
      return false;
  }
  values_ = theta_;
  values_.insert(values_.end(), m_->x.qd.begin(), m_->x.qd.end());
  for (EventSource* source : sources_)
    values_.insert(values_.end(), source->work_integrals().begin(), source->work_integrals().end());
  if (m_->account)
    values_.insert(values_.end(), m_->account->segment().begin(), m_->account->segment().end());
  return true;
}

void EventStep::set_state(const std::vector<double>& row, double s) {
  const std::size_t nv = m_->model().nv;
  theta_.assign(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(nv));
  integrate_coordinates(m_->model(), start_.q, theta_, m_->x.q);
  std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(nv), nv, m_->x.qd.begin());
  m_->x.t = start_.t + s;
  m_->update_kinematics();
  std::size_t next = 2 * nv;
  for (EventSource* source : sources_)
    for (double& work : source->work_integrals()) work = row[next++];
  if (m_->account)
    for (double& sum : m_->account->segment()) sum = row[next++];
}

}  // namespace twinarm
