// Which contacts are held during a smooth piece of the motion, where steps locate their events in
// time (solver/impulses/event_source.h), and the work of these.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "collision/contact/contact_bodies.h"
#include "solver/impulses/event_source.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// Work and impulses of all contacts so far, by pair of geometries.
class ContactWorks {
 public:
  ContactWorks() { all.reserve(256); }  // so that a pair that touches for the first time takes none

  // Those of pairs that have worked before are found, others come in.
  ContactWork& of(int a, int b);
  void serialize(StateArchive& memory, std::size_t geometries);

  std::vector<ContactWork> all;  // ascending by (a, b)
};

class ContactActiveSet final : public EventSource {
 public:
  // `points`: the contacts found last; `works` takes what commit_work() counts.
  ContactActiveSet(ContactBodies& bodies, std::vector<ContactPoint>& points, ContactWorks& works)
      : bodies_(bodies), points_(points), works_(works) {}

  void hold(const ConstraintFrame& frame, bool struck) noexcept override;
  void restore_active_set() noexcept override;
  void look(const ConstraintFrame& frame, NextEvent& nearest) const noexcept override;
  void modes(std::vector<char>& modes) const noexcept override;
  std::span<double> works() noexcept override { return flow_works_; }
  void commit_work() noexcept override;

  // A solution in Phase::flow: what each held one does, and its works.
  void begin_flow() { modes_.clear(); }
  void take_flow(ContactPoint& point, const ImpulseConstraint& c, double h, double normal,
                 double friction);

 private:
  // Of each pair: works of normal force and friction, impulse, moment.
  static constexpr std::size_t kFlowNumbers = 8;

  ContactBodies& bodies_;
  std::vector<ContactPoint>& points_;
  ContactWorks& works_;
  std::vector<ContactPoint> held_;               // the points as hold() left them
  std::vector<std::pair<int, int>> held_pairs_;  // ascending
  std::vector<double> flow_works_;
  std::vector<char> modes_;  // of the held, after a flow
};

}  // namespace twinarm
