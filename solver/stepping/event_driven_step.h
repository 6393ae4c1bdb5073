// Event-driven step with constraints: events are located in time, high order between them.
//
// Events: a contact or limit closes or opens, sliding starts or stops. Between two events the
// motion is smooth and is integrated in segments by extrapolation (Hairer, Lubich and Roche 1989,
// VI; Lubich 1991). A segment of length s is integrated with n equal first-order steps,
//   theta' = theta + (s/n) rate(theta, v),  q' = q exp(theta'),
//   M(q') (v' - v - (s/n) a(q', v)) = J(q')^T p,   active constraints on J(q') v', Coulomb
//   friction,
// for n = 1 .. 7; the error, a series in s/n, is eliminated by the Aitken-Neville scheme. The
// difference of the last two columns is the error estimate, which controls s.
//
// A segment is accepted if every active contact keeps its mode (sticking, sliding, separating) in
// all steps; otherwise it is halved, down to 1e-11 s, which locates the change. Sticking contacts
// are bilateral constraints: no rounding amplified by the friction coefficient or by extrapolation
// makes them slide. If an impulse leaves its friction cone, the segment is integrated again with
// Coulomb's law for that pair; a contact sticks again when its force is inside. If a gap is closed
// at the end, the segment is shortened by regula falsi to gap zero; then the impact is resolved
// with restitution. Impacts slower than 1e-7 m/s do not bounce: the step passes the accumulation
// point of a bouncing ball.
//
// If events accumulate (chattering piles; redundant loops, whose forces are determined up to
// rounding only) the step stops locating events after kMaxLaws constraint solutions. The remainder
// is one step of fixed size (constrained_step.h), first-order accurate; StepReport::located =
// false.
//
// Pairs that are closer than their displacement in the segment are checked for a gap at its end;
// the predicted time of contact limits s, so that no contact is missed.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/constraints/event_source.h"
#include "solver/stepping/constrained_step.h"

namespace twinarm {

// Last row of the Aitken-Neville table.
class ExtrapolationTable {
 public:
  static constexpr std::size_t kColumns = 7;
  void clear() { count_ = 0; }
  // Result of n steps, n = 1, 2, ... after clear(). Overwrites `values`.
  void add_row(std::vector<double>& values);
  const std::vector<double>& best() const { return columns_[count_ - 1]; }
  const std::vector<double>& next_best() const { return columns_[count_ - 2]; }

 private:
  std::array<std::vector<double>, kColumns> columns_;
  std::vector<double> spare_;
  std::size_t count_ = 0;
};

class EventStep {
 public:
  void serialize(StateArchive& archive) { archive.visit(length_); }
  // `interrupted`, or null, is called before each solution; true ends the step at the start of the
  // current segment. All sources must have events().
  using Interrupted = bool (*)();
  void step(ConstrainedStep& constrained, IntegrationState& m, double h, Interrupted interrupted,
            StepReport& report);

  static constexpr long kMaxLaws = 500'000;  // per step; 1 to 2 s of computation

 private:
  static constexpr int kColumns = ExtrapolationTable::kColumns;
  enum class Segment { accepted, inexact, mode_changed, stopped };
  enum class ModeChange { rejected, accepted };

  void begin_segment(double s);
  double smooth_segment(double max_length, StepReport& report);
  Segment integrate_segment(double s);
  bool run_column(double s, int n, ModeChange mode_change);
  double locate_contact(double s, double gap_start, double gap_end);
  void step_over_event(double s);
  void restore_segment_start();
  void finish(double t_end, StepReport& report);
  // Interrupted, or too many constraints solved.
  bool stops() {
    if (!is_interrupted_ && interrupted_) is_interrupted_ = interrupted_();
    return is_interrupted_ || laws_ >= kMaxLaws;
  }
  EventSource::NextEvent next_event() const;
  void set_state(const std::vector<double>& row, double s);
  ConstraintFrame frame() const {
    return {m_->k, constrained_->system().trees, m_->x, Phase::smooth, 0};
  }

  ConstrainedStep* constrained_ = nullptr;  // of the current call of step()
  IntegrationState* m_ = nullptr;           // likewise
  std::vector<EventSource*> sources_;
  double length_ = 0;  // of the next segment [s]
  State<double> start_;
  std::vector<double> theta_, rate_, size_;
  ExtrapolationTable table_;    // of theta, v, work integrals
  std::vector<double> values_;  // of one column
  double error_ = 0;            // difference of the last two columns, over kTolerance
  bool is_solved_ = true;       // all steps of the segment
  int solves_ = 0;              // impulse problems solved in this step
  long laws_ = 0;               // and the constraints in them
  Interrupted interrupted_ = nullptr;
  bool is_interrupted_ = false;
  bool has_mode(char mode) const { return std::ranges::count(modes_now_, mode) > 0; }
  std::vector<char> modes_, modes_now_;
};

}  // namespace twinarm
