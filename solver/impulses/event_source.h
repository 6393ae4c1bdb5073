// What the event-located steps (event_driven_step.h) ask of contacts and limits, beyond
// constraint_source.h.
//
// A piece of the motion begins where something has hit, opened, begun to slide or come to rest.
// What touches at its start is *held*: it may not close, and what slides or sticks does so
// throughout. Everything else is free, until the first gap closes.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "solver/impulses/constraint_source.h"

namespace twinarm {

class EventSource {
 public:
  virtual ~EventSource() = default;
  // Gaps up to this are closed, so that rest does not chase rounding [m]; what opens or closes
  // slower than this rests [m/s]. Angles of joints likewise.
  static constexpr double kClosed = 1e-9, kRest = 1e-7;
  // Slower than this what is held neither slides nor opens [m/s].
  static constexpr double kMoves = 1e-8;
  // Gaps of what is held go by this rate, so that what integration leaves does not add up [1/s].
  static constexpr double kGapRate = 100;

  // After begin_step at the start of a piece: holds what touches, and what was held before and did
  // not open, unless something has hit meanwhile.
  virtual void hold(const ConstraintFrame& frame, bool struck) noexcept = 0;
  // Back to the start of the piece, as hold() left it; the next begin_step follows from there.
  virtual void restore_active_set() noexcept = 0;

  // Of what is not held.
  struct NextEvent {
    double gap = std::numeric_limits<double>::infinity();   // the least [m], negative: beyond
    double time = std::numeric_limits<double>::infinity();  // the least, at the present speeds [s]
    bool has_closing_contact = true;  // the one with the least gap comes nearer

    // One more gap [m], which opens at `rate` [m/s].
    void see(double gap_now, double rate) {
      const bool comes = rate < -kRest;
      if (comes) time = std::min(time, std::max(0.0, gap_now) / -rate);
      if ((comes || gap_now < -10 * kClosed) && gap_now < gap)
        gap = gap_now, has_closing_contact = comes;
    }
  };
  virtual void look(const ConstraintFrame& frame, NextEvent& nearest) const noexcept = 0;

  // After a solution in Phase::flow: what each held one does, appended. They agree all through a
  // smooth piece. What slides at its start, but then stands or slides the other way, turns: that is
  // never smooth.
  enum Mode : char { rests, slides, opens, turns };
  virtual void modes(std::vector<char>& modes) const noexcept = 0;

  // Work since restore_active_set() of each held one, some numbers each, for the stepper to
  // extrapolate [J].
  virtual std::span<double> works() noexcept = 0;
  // The piece is done: works() are right now.
  virtual void commit_work() noexcept = 0;
};

}  // namespace twinarm
