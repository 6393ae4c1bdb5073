// A recorded run made again, from the files that the recording holds: those on the disk may have
// changed, or be gone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/record/recording_reader.h"
#include "app/run/simulate_input.h"
#include "app/scene/read/change_scene.h"

namespace twinarm {

// The recording's files in a temporary folder, which goes with it.
class UnpackedRun {
 public:
  // Throws InputError where a file cannot be written, or would not lie in the folder.
  explicit UnpackedRun(const RecordingHeader& header);
  UnpackedRun(const UnpackedRun&) = delete;
  UnpackedRun& operator=(const UnpackedRun&) = delete;

  // What the run was given, its paths those of the copies.
  SimulateOptions options(const std::vector<Change>& changes = {}) const;
  // Faults of such a run: copies by the names of their originals, and what a change brought in by
  // that change.
  InputError as_typed(const InputError& error, const std::vector<Change>& changes = {}) const;

 private:
  std::filesystem::path copy_of(const std::filesystem::path& original) const;
  void lead_to_copies(TomlValue& value) const;
  struct Folder {  // made, and removed with all that is in it
    Folder();
    ~Folder();
    std::filesystem::path path;
  };
  const RecordingHeader& header_;
  Folder folder_;
};

}  // namespace twinarm
