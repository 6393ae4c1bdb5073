// What a field of the passes is, stated once, where the field is (Workspace::describe and its
// like): inspection, documentation and the search for the first bad number all read it there.
#pragma once

namespace twinarm {

struct Quantity {
  // How the field is indexed: one entry of a body; one of each velocity of its joint; nv x nv
  // numbers from Workspace::iD on.
  enum class By { body, velocity, square };

  const char* name;
  int pass;  // of aba() that leaves it, 1 to 3; 0: an input, or of another algorithm
  By by;
  const char* meaning;
  // Angular and linear part where they differ: "rad/s; m/s". Of what belongs to a joint: where the
  // joint turns, and where it shifts.
  const char* unit;
  const char* equation;  // and where it stands in RBDA
};

}  // namespace twinarm
