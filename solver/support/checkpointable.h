// Sources and the steps that are thrown away (side_step of solver/stepping/simulation.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/support/state_archive.h"

namespace twinarm {

// A source that is asked for a step which then is not taken must be as before. What it remembers
// from step to step (held forces, last positions, stick anchors, warm starts) it names in
// visit_memory(): it is put aside and taken back by that, or written down for a restart elsewhere
// (solver/support/state_archive.h). A source that is not Rewindable refuses side steps.
class Rewindable {
 public:
  virtual ~Rewindable() = default;
  virtual void visit_memory(Memory&) {}
  virtual void keep() {
    Memory memory;
    visit_memory(memory);
    kept_memory_ = memory.bytes();
  }
  virtual void go_back() noexcept {
    Memory memory(kept_memory_);
    visit_memory(memory);
  }

 private:
  std::string kept_memory_;
};

// Keeps what sources remember, and takes it back at the end of its scope.
class SavedSources {
 public:
  explicit SavedSources(std::vector<Rewindable*> sources) : sources_(std::move(sources)) {
    for (Rewindable* source : sources_) source->keep();
  }
  SavedSources(const SavedSources&) = delete;
  ~SavedSources() {
    for (Rewindable* source : sources_) source->go_back();
  }

 private:
  std::vector<Rewindable*> sources_;
};

}  // namespace twinarm
