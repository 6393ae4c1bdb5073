// A run taken up again at a recorded step.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/record/recording_reader.h"
#include "app/record/unpack.h"

namespace twinarm {

struct Replay {
  long step = 0;            // where it began
  double from = 0, to = 0;  // [s]
  std::size_t first = 0;    // frame of the recording
  std::uint64_t hash = 0;   // of that frame, and of the run that was built again from it
  std::uint64_t hash_again = 0;
  std::size_t compared = 0, equal = 0;           // frames after it, by hash
  double first_different = -1;                   // [s]; negative: none
  std::vector<std::string> bodies;               // free ones of a scene, which no coordinate tells
  std::vector<RecordedFrame> frames;             // of the branch, at the steps that are recorded
  std::vector<std::string> rows, momentum_rows;  // names of the numbers in the frames' ledgers
};

// The run itself where there are no changes, else a fork. Throws InputError.
Replay replay(const Recording& recording, std::size_t first, const std::vector<Change>& changes);

}  // namespace twinarm
