// Restores a recorded run from the files in the recording.
#pragma once

#include <mutex>

#include "app/record/recording_reader.h"
#include "app/scene/read/change_scene.h"
#include "app/support/files.h"

namespace twinarm {

// The recording's files in a temporary folder, which the destructor removes.
class UnpackedRun {
 public:
  // Throws InputError if a file cannot be written, or would be outside the folder.
  explicit UnpackedRun(RecordingHeader header);

  const RecordingHeader& header() const { return header_; }
  const std::filesystem::path& folder() const { return copies_.folder(); }
  // Options of the run with the paths of the copies; missing copies are written again. *this must
  // outlive what is read with these options.
  SimulateOptions options(const std::vector<Change>& changes = {}) const;
  // The run with such options; its diagnostics name the original paths.
  SimulatePlan prepare(const SimulateOptions& options) const;
  // Diagnostics of such a run with the original paths; those caused by a change name that change.
  InputError with_original_paths(const InputError& error,
                                 const std::vector<Change>& changes = {}) const;

 private:
  void write_missing() const;
  std::filesystem::path copy_of(const std::filesystem::path& original) const;
  void redirect_paths(Value& value) const;
  RecordingHeader header_;
  TemporaryFiles copies_{"twinarm-replay"};
  mutable std::mutex writing_;
};

// Whether the file is a recording by its contents or name, or only its .part exists.
bool is_recording(const std::filesystem::path& file);

// Rejects options that change model or state: a recording has both.
void check_recorded(const RobotOptions& given, DiagnosticList& faults);

// Memory of frame n. Of a frame without it, the run is repeated from the keyframe before: with the
// same bits only if this is the program that recorded it. `files`: of the recording. Throws
// InputError.
std::string memory_at(const Recording& recording, std::size_t n, const UnpackedRun& files);

// State of a frame. Throws InputError if it is of another model.
State<double> recorded_state(RecordedFrame frame, const Model<double>& model);

// State of a recorded run, for inspection.
struct RecordedInstant {
  SimulatePlan prepared;                     // with the state and wrenches of the instant
  StateArchive memory;                       // for Simulation::serialize of the same simulation
  double t = 0;                              // of the frame [s]
  std::vector<EnergyRow> energy_balance;     // up to t [J]
  std::shared_ptr<const UnpackedRun> files;  // for meshes, which contacts read later
};

// The last frame at or before `at` (default: the last). Prepared for semi-implicit steps;
// `prepared.run.integrator` is that of the run. Throws InputError.
RecordedInstant open_instant(const std::filesystem::path& file, std::optional<double> at);

}  // namespace twinarm
