// A run to be shown: a recording, or a scene or robot that is let run for it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/snapshot.h"
#include "app/record/recording.h"
#include "app/record/recording_reader.h"
#include "app/record/unpack.h"
#include "app/run/simulate_input.h"
#include "app/support/progress.h"

namespace twinarm {

// A recorded instant, as what there is to be seen of it.

// Of the step that ended here; at the start of the one that begins here.
struct RunInstant {
  State<double> x;
  std::vector<Vector3> pulls;
  std::vector<RecordedContact> contacts;
};

// Whether forces do: by the joints between the body and the world.
bool moves_by_forces(const Model<double>& model, std::size_t body);

RunInstant instant_of(const RecordedFrame& frame, const Model<double>& model);
// `couplings`: of the scene; null for a robot alone. Contacts of other scenes are left out.
Snapshot moment_of(const SimulateInput& input, SceneCouplings* couplings,
                   const RunInstant& instant);

struct FilmedRun {
  std::string name;  // of a run beside another: its file's; empty: the scene's
  std::unique_ptr<const Recording> recording;  // null where it was let run
  std::unique_ptr<const UnpackedRun> files;    // of the recording: meshes are read later
  SimulatePlan plan;
  std::vector<RunInstant> shown;   // one a picture
  std::vector<RunInstant> around;  // of the whole run, some hundred: for framing, scales, trails

  const Model<double>& model() const { return plan.input.robot.model; }
  Snapshot moment(const RunInstant& instant) const {
    return moment_of(plan.input, plan.input.couplings.get(), instant);
  }
};

struct FilmTimes {
  std::optional<double> at;  // of a still [s]; left out: the end of a recording, the start else
  bool is_film = false;
  std::optional<double> from, to;  // of a film; left out: all of it
  double interval = 0;             // between two pictures [s of the run]
  bool waits = false;  // beyond its end a recording stands still: beside one that goes on
};

// Two recordings at the same instants, to the end of the longer one. Throws InputError.
std::vector<FilmedRun> film_pair(const std::filesystem::path& left,
                                 const std::filesystem::path& right, FilmTimes times);

// `camera` is only checked, before a long run is made for it. Throws InputError.
FilmedRun film_run(const RobotOptions& options, const FilmTimes& times, const std::string& camera,
                   Progress& progress);

}  // namespace twinarm
