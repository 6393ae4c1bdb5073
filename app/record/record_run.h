// Records a run, and replays a recorded one.
#pragma once

#include "app/record/unpack.h"
#include "app/run/stepped_run.h"

namespace twinarm {

RecordingHeader header_of(const SimulateOptions& options, const SimulatePlan& prepared,
                          std::vector<std::string> command);

// Fills in the contents of frames: integrator, step, columns, couplings, geometries.
void describe_frames(const SimulatePlan& prepared, RecordingHeader& header);

// Without the rows of the balances; with memory, or with q and qd.
RecordedFrame frame_of(SteppedRun& run, const SimulatePlan& prepared, bool with_memory = true);

// Adds those rows, by index of their names; new names are appended.
void add_energy_balances(const SteppedRun& run, std::vector<std::string>& names,
                         std::vector<std::string>& momentum_names, RecordedFrame& frame);

// RunWatch::look of a recorded run.
class RunRecorder {
 public:
  // `every` 0: each step. keyframe_every: as of RecordingWriter.
  RunRecorder(const std::filesystem::path& file, RecordingHeader header,
              const SimulatePlan& prepared, double every = 0,
              long keyframe_every = recording_format::kKeyframeEvery);
  void look(SteppedRun& run);
  void write(SteppedRun& run);
  void alarm(const std::string& words) { writer_.alarm(words); }
  void finish(const std::string& how) { writer_.finish(how); }

 private:
  RecordingWriter writer_;
  const SimulatePlan& prepared_;
  double every_, next_ = 0;
};

// Runs the plan and records it into options.record, as `twinarm simulate --record`; also if it is
// interrupted, before Interrupted is thrown again. `watch` needs `look`, and `tick` for interrupts.
SimulateResult record_plan(const SimulateOptions& options, const SimulatePlan& prepared,
                           RunWatch watch);

// A run resumed at a recorded step.
struct Replay {
  long step = 0;            // first step
  double from = 0, to = 0;  // [s]
  std::size_t first = 0;    // frame of the recording
  std::uint64_t hash = 0;   // of that frame, and of the state restored from it
  std::uint64_t hash_again = 0;
  std::size_t compared = 0, equal = 0;           // later frames, and those with equal state
  double first_different = -1;                   // [s]; negative: none
  std::vector<std::string> bodies;               // free bodies of a scene (no coordinates)
  std::vector<RecordedFrame> frames;             // of the branch, at the recorded steps
  std::vector<std::string> rows, momentum_rows;  // names of the rows of the frames' balances
};

// The same run, or with changes a branch. Throws InputError.
Replay replay(const Recording& recording, std::size_t first, const std::vector<Change>& changes);

// A branch and its recording: tables and a figure.

// Changes of the balances since the branch began.
struct ComparedWork {
  std::string name;
  double recorded = 0, branch = 0;  // [J]
};
struct ComparedMomentum {
  std::string name;
  Eigen::Matrix<double, 6, 1> recorded, branch;  // linear [N s], angular [N m s]
};
struct ComparedBalances {
  std::vector<ComparedWork> works;
  std::vector<ComparedMomentum> momenta;
};
ComparedBalances compared_balances(const Replay& recorded, const Replay& branch);

// The values that differ most, then both balances with their differences.
void print_branch(const Recording& recording, const Replay& recorded, const Replay& branch);
// The value that differs most, and the rows of the energy balance that do. Throws InputError.
void draw_branch(const Recording& recording, const Replay& recorded, const Replay& branch,
                 const std::vector<std::string>& changes, const std::filesystem::path& file);

}  // namespace twinarm
