// A recorded run made again, from the files that the recording holds: those on the disk may have
// changed, or be gone.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/accounting/energy_balance.h"
#include "app/record/recording_reader.h"
#include "app/run/simulate_input.h"
#include "app/scene/read/change_scene.h"
#include "solver/support/state_archive.h"

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

// Whether the file begins as a recording, is named like one, or there is only its .part.
bool is_recording(const std::filesystem::path& file);

// Adds a fault where options were given that change a model or its state: a recording has both.
void check_recorded(const RobotOptions& given, DiagnosticList& faults);

// Opened again, for inspection.
struct RecordedInstant {
  SimulatePlan prepared;          // its state is that of the instant; so are the points of wrenches
  StateArchive memory;            // for Simulation::serialize of a simulation that is built alike
  double t = 0;                   // of the frame [s]
  std::vector<EnergyRow> ledger;  // up to it [J]
  // The files that it was made from: meshes are read when contacts are set up, which is later.
  std::shared_ptr<const UnpackedRun> files;
};

// The last frame at or before `at`; left out: the last of all. Prepared for semi-implicit steps;
// `prepared.run.integrator` is that of the run. Throws InputError.
RecordedInstant open_instant(const std::filesystem::path& file, std::optional<double> at);

}  // namespace twinarm
