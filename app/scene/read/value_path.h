// A place in the tree of a scene, named by the way to it from the top:
//
//   step                       of the scene itself
//   gravity[2]                 in a list, from 0
//   coupling[0].stiffness      of one of several [[coupling]]
//   coupling.stiffness         of all of them
//   coupling.pull.stiffness    of the one with name = "pull"
//   robot.q.joint1, body.shape.sphere.radius, coupling.target.q.joint1
#pragma once

#include <string>
#include <vector>

#include "app/data/value.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

struct ValuePath {
  struct Part {
    std::string name;
    long index = -1;  // -1: none is given; -2: what stands in the brackets is no index
  };
  explicit ValuePath(const std::string& path);
  std::string text;
  std::vector<Part> parts;  // at least one
};

// Where a path leads; `table`: in what its last part stands.
struct PathTarget {
  Value *value, *table;
};

// Keys that tables leave out and a path may make: whether there are such, the reader of the scene
// knows.
enum class MadeKeys { last, all_below_top };

// All places that are meant; what is made stands in `line`. Throws InputError, at `where` and with
// the nearest names, where the path leads nowhere.
std::vector<PathTarget> find_targets(Value& scene, const ValuePath& path, MadeKeys made, int line,
                                     const std::string& where);

// Puts the number there, in `line`, by which later faults are known. Adds a fault at `where` where
// the path does not lead to numbers.
void set_number(Value& scene, const std::string& path, double value, int line,
                const std::string& where, FaultList& faults);

}  // namespace twinarm
