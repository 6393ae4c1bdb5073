// When a force is computed: at every step and stage, or once in so many steps and held between.
#pragma once

#include <limits>
#include <stdexcept>

#include "solver/forces/force_source.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class Hold {
 public:
  // 0 steps: none is held. Throws std::invalid_argument for an implicit force that is to be held.
  Hold(int steps, Treatment treatment) : every_(steps) {
    if (steps > 0 && treatment != Treatment::explicit_)
      throw std::invalid_argument("a held force is explicit: it cannot see the end of the step");
  }
  void begin_step() {
    fresh_ = every_ == 0 || steps_ % every_ == 0;
    ++steps_;
  }
  bool is_fresh() const { return fresh_; }  // compute it now
  void computed() {
    if (every_ > 0) fresh_ = false;
  }
  void visit_memory(Memory& memory) {
    memory.visit_index(steps_, std::numeric_limits<int>::max() / 2);
  }

 private:
  int every_, steps_ = 0;
  bool fresh_ = true;
};

}  // namespace twinarm
