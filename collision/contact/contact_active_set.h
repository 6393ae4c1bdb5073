// Active set of an event-driven step (solver/constraints/event_source.h): the contacts that are
// constraints during a smooth segment, and their work.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "collision/contact/contact_bodies.h"
#include "solver/constraints/event_source.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// Accumulated work and impulses of contacts, by pair of geometries.
class ContactWorks {
 public:
  ContactWorks() { all.reserve(256); }  // a step does not allocate

  // Inserts the pair if it is new.
  ContactWork& of(int a, int b);
  void serialize(StateArchive& memory, std::size_t geometries);

  std::vector<ContactWork> all;  // ascending by (a, b)
};

class ContactActiveSet final : public EventSource {
 public:
  // `points`: the detected contacts; commit_work() adds to `works`.
  ContactActiveSet(ContactBodies& bodies, std::vector<ContactPoint>& points, ContactWorks& works)
      : bodies_(bodies), points_(points), works_(works) {}

  void set_active_set(const ConstraintFrame& frame, bool impact) noexcept override;
  void restore_active_set() noexcept override;
  void hold_sticking() noexcept override { std::fill(released_.begin(), released_.end(), 0); }
  void find_next_event(const ConstraintFrame& frame, NextEvent& next) const noexcept override;
  void append_modes(std::vector<char>& modes) const noexcept override {
    modes.insert(modes.end(), modes_.begin(), modes_.end());
  }
  std::span<double> work_integrals() noexcept override { return integrals_; }
  void commit_work() noexcept override;

  // Reads a solution of Phase::smooth: contact modes and work of the active contacts.
  void clear_modes() { modes_.clear(); }
  void read_smooth(ContactPoint& point, const ImpulseConstraint& c, double h, double normal,
                   double friction);

 private:
  // By pair: work of the normal force, work of friction, impulse (3), moment (3).
  static constexpr std::size_t kIntegrals = 8;
  std::size_t pair_index(const ContactPoint& point) const {
    const std::pair pair(point.contact.a, point.contact.b);
    return static_cast<std::size_t>(std::ranges::lower_bound(held_pairs_, pair) -
                                    held_pairs_.begin());
  }

  ContactBodies& bodies_;
  std::vector<ContactPoint>& points_;
  ContactWorks& works_;
  std::vector<ContactPoint> held_;               // copy of the points after set_active_set()
  std::vector<std::pair<int, int>> held_pairs_;  // ascending
  std::vector<char> released_;                   // by pair: no longer held sticking
  std::vector<double> integrals_;
  std::vector<char> modes_;  // of the active contacts, after Phase::smooth
};

}  // namespace twinarm
