// Sources and the steps that are thrown away (Simulation::side_step).
#pragma once

#include <utility>
#include <vector>

#include "solver/support/state_archive.h"

namespace twinarm {

// A source that is asked for a step which then is not taken must be as before. What it remembers
// from step to step (held forces, last positions, stick anchors, warm starts) it puts aside in
// keep() and takes back in go_back(); a source that remembers nothing leaves both as they are. A
// source that is not Rewindable refuses side steps.
class Rewindable {
 public:
  virtual ~Rewindable() = default;
  virtual void keep() {}
  virtual void go_back() noexcept {}
  // The same fields, written down or taken back, for a restart elsewhere
  // (solver/support/state_archive.h).
  virtual void visit_memory(Memory&) {}
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
