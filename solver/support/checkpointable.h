// Sources and the steps that are thrown away (side_step of solver/stepping/simulation.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/support/state_archive.h"

namespace twinarm {

// A source that is asked for a step which then is not taken must be as before. What it remembers
// from step to step (held forces, last positions, stick anchors, warm starts) it names in
// serialize(): it is put aside and taken back by that, or written down for a restart elsewhere
// (solver/support/state_archive.h). A source that is not Rewindable refuses side steps.
class Checkpointable {
 public:
  virtual ~Checkpointable() = default;
  virtual void serialize(StateArchive&) {}
  virtual void keep() {
    StateArchive memory;
    serialize(memory);
    kept_memory_ = memory.bytes();
  }
  virtual void restore() noexcept {
    StateArchive memory(kept_memory_);
    serialize(memory);
  }

 private:
  std::string kept_memory_;
};

// Keeps what sources remember, and takes it back at the end of its scope.
class SavedSources {
 public:
  explicit SavedSources(std::vector<Checkpointable*> sources) : sources_(std::move(sources)) {
    for (Checkpointable* source : sources_) source->keep();
  }
  SavedSources(const SavedSources&) = delete;
  ~SavedSources() {
    for (Checkpointable* source : sources_) source->restore();
  }

 private:
  std::vector<Checkpointable*> sources_;
};

}  // namespace twinarm
