// Changes of a scene's tree before it is read. Paths:
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
    long index = -1;  // -1: none; -2: not a valid index
  };
  explicit ValuePath(const std::string& path);
  std::string text;
  std::vector<Part> parts;  // at least one
};

// A value that a path denotes, and the table or list that contains it.
struct PathTarget {
  Value *value, *table;
};

// Missing keys that a path may add; the reader of the scene checks whether they are valid.
enum class MadeKeys { last, all_below_top };

// All values that the path denotes; added ones get the line number `line`. Throws InputError at
// `where`, with the nearest names, if there are none.
std::vector<PathTarget> find_targets(Value& scene, const ValuePath& path, MadeKeys made, int line,
                                     const std::string& where);

// Sets the numbers at the path and their line number, by which later diagnostics can be attributed.
// Adds a diagnostic at `where` if the path does not denote numbers.
void set_number(Value& scene, const std::string& path, double value, int line,
                const std::string& where, DiagnosticList& faults);

// "coupling[0].stiffness=800", "coupling.stiffness=800" (all), "coupling.NAME.stiffness=800",
// "robot.q.joint1=0.5", "gravity=0,0,-1.62", "gravity[2]=-1.62".
struct Change {
  std::string path, value;
};
// Throws InputError if there is no '='.
Change parse_change(const std::string& text);
// Applies the change to a scene's tree, with line number `line`. Missing tables and keys below the
// top are added. A changed `type` removes the keys that the new type of coupling does not have
// (fit_keys_to_type).
void apply(const Change& change, int line, Value& scene, DiagnosticList& faults);

}  // namespace twinarm
