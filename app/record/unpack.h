// A recorded run made again, from the files that the recording holds: those on the disk may have
// changed, or be gone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/record/recording_reader.h"
#include "app/simulate/simulate_input.h"

namespace twinarm {

// "coupling[0].stiffness=800", "coupling.stiffness=800" (all), "coupling.NAME.stiffness=800",
// "robot.q.joint1=0.5", "gravity=0,0,-1.62", "gravity[2]=-1.62".
struct Change {
  std::string path, value;
};
// Throws InputError for what has no '='.
Change parse_change(const std::string& text);
// To a scene's tree; adds a fault where the path leads nowhere. Tables and keys below the top that
// are missing are made: the reader knows whether there are such. With another `type` a coupling
// loses the keys that the new one has not (app/scene/coupling_keys.h). `line`: what it writes
// stands there.
void apply(const Change& change, int line, TomlValue& scene, FaultList& faults);

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
