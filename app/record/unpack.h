// A recorded run made again, from the files that the recording holds: those on the disk may have
// changed, or be gone.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "app/record/recording_reader.h"
#include "app/run/simulate_input.h"
#include "app/scene/read/change_scene.h"

namespace twinarm {

// A recorded run as options of a new one, and the other way round. The paths of the latter are made
// absolute.
SimulateOptions options_of(const RecordedRun& run);
RecordedRun recorded_run(const SimulateOptions& options);

// The recording's files in a temporary folder, which goes with it.
class UnpackedRun {
 public:
  // Throws InputError where a file cannot be written, or would not lie in the folder.
  explicit UnpackedRun(RecordingHeader header);
  UnpackedRun(const UnpackedRun&) = delete;
  UnpackedRun& operator=(const UnpackedRun&) = delete;

  const RecordingHeader& header() const { return header_; }
  const std::filesystem::path& folder() const { return folder_.path; }
  // What the run was given, its paths those of the copies. Copies that something else has removed
  // are written again; the recorded run must outlive what is read with these options.
  SimulateOptions options(const std::vector<Change>& changes = {}) const;
  // Faults of such a run: copies by the names of their originals, and what a change brought in by
  // that change.
  InputError as_typed(const InputError& error, const std::vector<Change>& changes = {}) const;

 private:
  void write_missing() const;
  std::filesystem::path copy_of(const std::filesystem::path& original) const;
  void lead_to_copies(Value& value) const;
  struct Folder {  // made, and removed with all that is in it
    Folder();
    ~Folder();
    std::filesystem::path path;
  };
  RecordingHeader header_;
  Folder folder_;
  mutable std::mutex writing_;
};

}  // namespace twinarm
