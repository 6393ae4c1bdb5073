// Interface of constraint sources whose events are located in time (event_driven_step.h), in
// addition to constraint_source.h.
//
// The *active set* (`held`) of a smooth segment are the contacts and limits that are closed at its
// start: they may not close further, and keep sliding or sticking. All others are inactive until
// the first gap closes.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "solver/constraints/constraint_source.h"

namespace twinarm {

class EventSource {
 public:
  virtual ~EventSource() = default;
  // Gaps up to kClosed [m, rad] count as closed; velocities up to kRest [m/s, rad/s] as rest.
  static constexpr double kClosed = 1e-9, kRest = 1e-7;
  // Active constraints below this velocity neither slide nor separate [m/s].
  static constexpr double kMoves = 1e-8;
  // Rate at which gaps of the active set decay (Baumgarte), against integration drift [1/s].
  static constexpr double kGapRate = 100;

  // After begin_step at the start of a segment: the active set are closed gaps, and without an
  // `impact` also the previous active set except separating members.
  virtual void set_active_set(const ConstraintFrame& frame, bool impact) noexcept = 0;
  // Restores the active set of the start of the segment.
  virtual void restore_active_set() noexcept = 0;
  // Sticking contacts are bilateral until their impulse leaves the friction cone (ContactMode).
  virtual void hold_sticking() noexcept {}

  // Over the inactive gaps.
  struct NextEvent {
    double gap = std::numeric_limits<double>::infinity();   // minimum [m]; negative: penetration
    double time = std::numeric_limits<double>::infinity();  // minimum at current velocities [s]
    bool has_closing_contact = true;                        // the minimum gap is closing

    // Includes a gap [m] with d gap/dt = rate [m/s].
    void include(double gap_now, double rate) {
      const bool closing = rate < -kRest;
      if (closing) time = std::min(time, std::max(0.0, gap_now) / -rate);
      if ((closing || gap_now < -10 * kClosed) && gap_now < gap)
        gap = gap_now, has_closing_contact = closing;
    }
  };
  virtual void find_next_event(const ConstraintFrame& frame, NextEvent& next) const noexcept = 0;

  // Appends the mode of each active constraint after a solution in Phase::smooth. reversing:
  // sliding at the start, then stopped or reversed. released: held sticking, but the impulse is
  // outside the friction cone; restore_active_set() returns this contact to its Coulomb law.
  // Constant in a smooth segment, never reversing or released.
  enum ContactMode : char { sticking, sliding, separating, reversing, released };
  virtual void append_modes(std::vector<char>& modes) const noexcept = 0;

  // Work integrals [J] of the active constraints since restore_active_set(), for extrapolation.
  virtual std::span<double> work_integrals() noexcept = 0;
  virtual void commit_work() noexcept = 0;  // adds work_integrals() at the end of the segment
};

}  // namespace twinarm
