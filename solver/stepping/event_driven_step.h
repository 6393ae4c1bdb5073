// A step under constraints that locates its events in time, and is of high order between them.
//
// Events: something hits, opens, begins to slide or comes to rest. Between two of them the motion
// is smooth. It is taken in pieces by extrapolation (Hairer, Lubich and Roche 1989, VI; Lubich
// 1991): a piece of length s is crossed in n equal steps of the first order,
//   theta' = theta + (s/n) rate(theta, v),  q' = q exp(theta'),
//   M(q') (v' - v - (s/n) a(q', v)) = J(q')^T p,   J(q') v' held, under Coulomb's law,
// for n = 1 .. 7, and the errors, a series in s/n, are eliminated column by column (Aitken,
// Neville). The last two columns tell the error that is left, which chooses s.
//
// A piece counts if everything that is held does the same (rests, slides, opens) in all of its
// steps. Otherwise it is halved, down to 1e-11 s: so what changes is located. Where a gap has
// closed at its end, the piece is shortened by regula falsi until the gap is zero; then comes the
// impact, with the restitution of what touches. Impacts slower than 1e-7 m/s do not bounce: so a
// ball comes to rest through the point in time at which its bounces accumulate.
//
// Where events follow one another without end (a heap that chatters; redundant loops, whose forces
// are known to rounding only, so that no piece is good) a step stops looking for them after
// kMaxLaws laws solved (one for each constraint in each solution): what is left of it is one step
// of fixed size (constrained_step.h), which obeys the same laws to first order, and the report says
// so (StepReport::located).
//
// Between bodies that are nearer to each other at the start of a piece than they move in it a gap
// is looked for at its end; the predicted time of the meeting bounds the piece, so nothing is
// jumped.
#pragma once

#include <array>
#include <vector>

#include "solver/impulses/event_source.h"
#include "solver/stepping/constrained_step.h"

namespace twinarm {

// Aitken and Neville's table, its last row.
class ExtrapolationTable {
 public:
  static constexpr std::size_t kColumns = 7;
  void clear() { count_ = 0; }
  // Of n steps, n = 1 after clear(), and so on; leaves nothing of use in `values`.
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
  explicit EventStep(const Model<double>& model) : model_(&model) {}
  void serialize(StateArchive& memory) { memory.visit(length_); }
  // `interrupted` is asked before each solution; may be null. True ends the step where its last
  // piece began. All of constrained's sources must have events().
  using Interrupted = bool (*)();
  void step(ConstrainedStep& constrained, IntegrationState& m, double h, Interrupted interrupted,
            StepReport& report);

  static constexpr long kMaxLaws = 500'000;  // in one step; a second or two

 private:
  static constexpr int kColumns = ExtrapolationTable::kColumns;
  enum class Piece { good, inexact, uneven, stopped };

  Piece cross(ConstrainedStep& constrained, IntegrationState& m, double s);
  enum class Uneven { refused, taken };
  bool run_column(ConstrainedStep& constrained, IntegrationState& m, double s, int n,
                  Uneven uneven);
  void begin(ConstrainedStep& constrained, IntegrationState& m, double s);
  double piece(ConstrainedStep& constrained, IntegrationState& m, double longest,
               StepReport& report);
  double shorten(ConstrainedStep& constrained, IntegrationState& m, double s, double gap_start,
                 double gap_end);
  void step_over_event(ConstrainedStep& constrained, IntegrationState& m, double s);
  void restore(IntegrationState& m);
  void finish(ConstrainedStep& constrained, IntegrationState& m, double t_end, StepReport& report);
  bool stops();
  EventSource::NextEvent look(ConstrainedStep& constrained, const IntegrationState& m) const;
  void go_to(IntegrationState& m, const std::vector<double>& row, double s);
  ConstraintFrame frame(const ConstrainedStep& constrained, const IntegrationState& m) const {
    return {m.k, constrained.system().trees, m.x, Phase::flow, 0};
  }

  const Model<double>* model_;
  std::vector<EventSource*> sources_;
  double length_ = 0;  // of the next piece
  State<double> start_;
  std::vector<double> theta_, rate_, size_;
  ExtrapolationTable table_;    // of theta, v, works
  std::vector<double> values_;  // of one column
  double error_ = 0;            // by how much the last two columns differ, over kTolerance
  bool is_solved_ = true;       // all steps of the piece
  long laws_ = 0;               // solved in this step
  Interrupted interrupted_ = nullptr;
  bool is_interrupted_ = false;
  std::vector<char> modes_, modes_now_;
};

}  // namespace twinarm
