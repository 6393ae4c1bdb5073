// Save and restore of the internal state of sources around steps whose result is discarded
// (side_step() of solver/stepping/simulation.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/support/state_archive.h"

namespace twinarm {

// serialize() visits the state that a source keeps between steps (held forces, last positions,
// stick anchors, warm starts). It is used for save and restore, and for restarts
// (solver/support/state_archive.h). side_step() rejects sources that are not Checkpointable.
class Checkpointable {
 public:
  virtual ~Checkpointable() = default;
  virtual void serialize(StateArchive&) {}
  virtual void keep() {
    StateArchive archive;
    serialize(archive);
    saved_ = archive.bytes();
  }
  virtual void restore() noexcept {
    StateArchive archive(std::move(saved_));  // once: without a copy, which could fail
    serialize(archive);
  }

 private:
  std::string saved_;
};

// Saves the state of sources and restores it at the end of the scope.
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
