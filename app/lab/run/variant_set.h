// Runs of one scene side by side, on one clock: for each its own value of one path. The first is
// the run itself, that hands, knobs and recordings are about; the others stand beside it
// (variants.h).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/record/unpack.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct LaneSet {
  static constexpr std::size_t kMost = 7;  // that colours tell apart

  std::string path;                 // as of a Change: "integrator", "coupling.stiffness"
  std::vector<std::string> values;  // by lane
  std::optional<Vector3> apart;     // from one to the next [m]; none: by the width of the scene

  bool empty() const { return values.empty(); }
  Change change(std::size_t lane) const { return {path, values[lane]}; }
};

// "integrator=semi-implicit,rk4"; commas within brackets are of the value. Throws InputError.
LaneSet parse_lanes(const std::string& text);

// What is wrong with it whatever the scene is; nothing: it may be tried.
struct LaneFault {
  std::string rule, remedy;
};
std::optional<LaneFault> fault_of(const LaneSet& lanes);

// Behind all others: changes are applied in their order. One to the same path goes.
void put(std::vector<Change>& changes, const Change& change);

}  // namespace twinarm
