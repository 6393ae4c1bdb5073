// A run to be rendered: a recording, or a simulation of a scene or robot.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/scene_view.h"
#include "app/record/recording.h"
#include "app/record/recording_reader.h"
#include "app/record/unpack.h"
#include "app/run/simulate_input.h"
#include "app/support/progress.h"

namespace twinarm {

// Coupling forces and contacts are those of the step that ended here; at the start of the first.
struct RunInstant {
  State<double> x;
  std::vector<Vector3> coupling_forces;
  std::vector<RecordedContact> contacts;
  std::string memory;  // serialized state of the run; of a recording: memory_at()
};

RunInstant instant_of(const RecordedFrame& frame, const Model<double>& model);
// `couplings`: of the scene; null for a robot alone.
Snapshot snapshot_of(const SimulateInput& input, SceneCouplings* couplings,
                     const RunInstant& instant);

struct FilmedRun {
  std::string name;  // of two runs side by side: the file's; empty: the scene's
  std::unique_ptr<const Recording> recording;  // null for a simulation
  std::unique_ptr<const UnpackedRun> files;    // of the recording: meshes are read later
  SimulatePlan plan;
  std::vector<RunInstant> shown;   // one per picture
  std::vector<RunInstant> around;  // up to 240 of the whole run: for framing, scales, trails

  const Model<double>& model() const { return plan.input.robot.model; }
  Snapshot snapshot(const RunInstant& instant) const {
    return snapshot_of(plan.input, plan.input.couplings.get(), instant);
  }
};

// With framing and scales of the run; set_view() comes next.
SceneView view_of(const FilmedRun& run);

struct FilmTimes {
  std::optional<double> at;  // of a still [s]; default: end of a recording, start of a simulation
  bool is_film = false;
  std::optional<double> from, to;  // of a film; default: the whole run
  double interval = 0;             // between two pictures [s of the run]
  bool waits = false;              // a recording keeps its last frame beyond its end
};

// Two recordings at the same instants, to the end of the longer one. Throws InputError.
std::vector<FilmedRun> film_pair(const std::filesystem::path& left,
                                 const std::filesystem::path& right, FilmTimes times);

// Checks `camera` before it simulates. Throws InputError.
FilmedRun film_run(const RobotOptions& options, const FilmTimes& times, const std::string& camera,
                   Progress& progress);

}  // namespace twinarm
