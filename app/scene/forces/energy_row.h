// One row of the energy balance.
#pragma once

#include <string>

namespace twinarm {

// What a row is of. Programs ask for this: the name of a row is for people, JSON and recordings.
enum class LedgerKind {
  gravity,
  actuator,
  wrench,
  joint_damping,
  joint_friction,
  joint_limit,
  joint_mimic,
  limit_stabilisation,
  coupling_spring,
  coupling_damper,
  coupling_implicit,
  coupling_other,  // `as_printed`, `drive`, and the impulse of a coupling
  contact,         // impulse of a pair
  contact_normal,
  contact_friction,
  contact_impact,
  contact_stabilisation,
  constraint,
  constraint_stabilisation,
  tree,  // impulse through the joint that carries a tree
  outside,
  numerical,
  earlier  // read from a recording, or of what ran before a change
};

// In recordings and JSON; always the last row.
inline constexpr const char* kNumericalRow = "numerical";

struct LedgerRow {
  LedgerKind kind = LedgerKind::earlier;
  std::string name;
  double work = 0;  // [J]
};

}  // namespace twinarm
