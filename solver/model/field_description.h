// Description of a variable of the algorithms (Workspace::describe, Forces::describe,
// FullTrace::describe): used by the inspector, the documentation and first_bad_quantity().
#pragma once

namespace twinarm {

struct Quantity {
  // Index of the entries of a body: the body; each velocity of its joint; nv x nv entries from
  // Workspace::iD.
  enum class By { body, velocity, square };

  const char* name;
  int pass;  // of aba() that writes it, 1 to 3; 0: input
  By by;
  const char* meaning;
  // "rad/s; m/s": angular; linear part. Of joint quantities: revolute; prismatic joint.
  const char* unit;
  const char* equation;  // with the place in RBDA
};

}  // namespace twinarm
