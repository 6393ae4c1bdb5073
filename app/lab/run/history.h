// What the lab remembers of a run: frames with memory, and what came from outside in each step,
// within a bound of bytes; the oldest goes first. A frame, once in, never changes and may be read
// by any thread that holds it; the history itself belongs to one thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/snapshot.h"
#include "app/lab/run/lab_scene.h"
#include "app/record/recording.h"
#include "coupling/device/device_motion.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// What the lab remembers of an instant: a frame of a recording, and what moved the robot in it.

// A spring from a point of a body to where the mouse is. World axes.
struct MousePoint {
  int body = 0;
  Vector3 p_L = Vector3::Zero();      // on the body, link axes [m]
  Vector3 goal_W = Vector3::Zero();   // [m]
  Vector3 force_W = Vector3::Zero();  // on the body, of the last step [N]
};

// The hand at the end of the step; absent where no coupling can be led by one.
struct LabHandFrame {
  bool leads = false;              // false: the scene's own hand moves the robot
  std::array<double, 6> theta{};   // of the (virtual) Omni [rad]
  std::vector<double> q_K;         // the driven joints' targets, at the start of the step [rad, m]
  std::vector<double> qd_K;        // and how fast they went on from there [rad/s, m/s]
  std::array<double, 3> torque{};  // of its motors [N m]
  Vector3 force_W = Vector3::Zero();  // on the stylus, world axes [N]
  bool gripper_closed = false;
  int mode = 0;  // DeviceWatchdog::Mode
};

// Of a run beside this one (variants.h). Stopped: where it stopped, and at that time.
struct LabFrame;
struct VariantFrame {
  std::shared_ptr<const LabFrame> frame;
  bool stopped = false;
};

struct LabFrame {
  RecordedFrame recorded;
  std::optional<LabHandFrame> hand;
  std::optional<MousePoint> pull;
  // At the end of recorded.memory: the books of pulls, once there were any. What a scene's header
  // describes goes without.
  std::size_t outside_bytes = 0;
  double input_stamp = 0;  // of the newest input that this frame has seen, as its sender gave it
  // Of the thread, since the frame before: processor time per step, mean and largest [s]; run time
  // over the wall time that was asked for (1: it keeps up).
  double step_time = 0, longest_step = 0, pace = 1;
  std::vector<VariantFrame> lanes;  // of the runs beside this one, from the second lane on
};

// A spring-damper from a point of a body to a goal in the world.
struct PullInput {
  int body = 0;
  Vector3 p_L = Vector3::Zero();     // link axes [m]
  Vector3 goal_W = Vector3::Zero();  // [m]
  double k = 0, b = 0;               // [N/m], [N s/m]
  double most = 0;                   // of the spring's force [N]
};

// What came from outside in one step of a run: with it the step can be taken again, bit for bit.
struct LabInput {
  long step = 0;                 // that it went into; the first of a run is 1
  std::optional<HandStep> hand;  // where a hand led; else the scene's own did
  std::optional<PullInput> pull;
  double stamp = 0;  // of the newest command in it, as its sender gave it
};

// Names of ledger rows, by the numbers in frames.
struct LabNames {
  std::vector<std::string> rows, momentum_rows;
};

std::size_t bytes_of(const LabFrame& frame);  // with its lanes

class LabHistory {
 public:
  using Frame = std::shared_ptr<const LabFrame>;
  static constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
  explicit LabHistory(std::size_t max_bytes = kMaxBytes) : max_(max_bytes) {}

  // Later than all before, else those that are not earlier are forgotten.
  Frame add(LabFrame frame);
  // Of the step that was just taken. Steps without a hand and a pull need not be told.
  void add(const LabInput& input);
  // From the newest frame on the run is another one, with these changes; then its first frame is
  // added, in place of the last one of the old run.
  void begin_segment(std::vector<Change> changes);

  bool empty() const { return frames_.empty(); }
  std::size_t size() const { return frames_.size(); }
  const Frame& frame(std::size_t n) const { return frames_[n]; }  // 0: the oldest
  const Frame& newest() const { return frames_.back(); }
  // The last frame at or before t; the oldest where all are later. Not of an empty history.
  std::size_t at(double t) const;
  std::size_t bytes() const { return bytes_; }
  std::size_t max_bytes() const { return max_; }
  // What came in that step; null: nothing, or it is no longer remembered.
  const LabInput* input(long step) const;
  // A branch from frame n: what came after it is forgotten here and given back, the frame included.
  LabHistory cut(std::size_t n);

  // Saved: the frames since the last change that a recording's header cannot describe (another
  // knob, another one who moves the robot, a pull); `twinarm replay` repeats them bit for bit.
  struct Saved {
    std::size_t frames = 0;
    double from = 0, to = 0;  // [s]
  };
  // Throws InputError where the file cannot be written, and where nothing is remembered.
  Saved save(const LabScene& scene, const LabNames& names, const std::vector<std::size_t>& led,
             const std::filesystem::path& file) const;  // led: LabRun::led()

 private:
  struct Segment {
    long first_step;
    std::vector<Change> changes;
  };
  void trim();
  long first_step_to_save() const;
  std::string log_of_hand() const;

  std::size_t max_, bytes_ = 0;
  std::deque<Frame> frames_;
  std::deque<LabInput> inputs_;
  std::deque<Segment> segments_;
};

}  // namespace twinarm
