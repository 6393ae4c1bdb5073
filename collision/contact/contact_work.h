// Work and impulses of all contacts so far, by pair of geometries.
#pragma once

#include <vector>

#include "collision/contact/contact_point.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class ContactWorks {
 public:
  ContactWorks() { all.reserve(256); }  // so that a pair that touches for the first time takes none

  // Those of pairs that have worked before are found, others come in.
  ContactWork& of(int a, int b);
  void visit_memory(Memory& memory, std::size_t geometries);

  std::vector<ContactWork> all;  // ascending by (a, b)
};

}  // namespace twinarm
