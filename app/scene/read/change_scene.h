// Changes of a scene's tree, before it is read. A place in it is named by the way to
// it from the top:
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
                const std::string& where, DiagnosticList& faults);

// "coupling[0].stiffness=800", "coupling.stiffness=800" (all), "coupling.NAME.stiffness=800",
// "robot.q.joint1=0.5", "gravity=0,0,-1.62", "gravity[2]=-1.62".
struct Change {
  std::string path, value;
};
// Throws InputError for what has no '='.
Change parse_change(const std::string& text);
// To a scene's tree; adds a fault where the path leads nowhere. Tables and keys below the top that
// are missing are made: the reader knows whether there are such. With another `type` a coupling
// loses the keys that the new one has not (app/scene/read/scene_keys.h). `line`: what it writes
// stands there.
void apply(const Change& change, int line, Value& scene, DiagnosticList& faults);

}  // namespace twinarm
