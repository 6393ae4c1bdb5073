// History of a run: frames with checkpoints, and the external inputs of each step, limited in bytes
// (the oldest are removed first). A stored frame never changes and may be read by any thread that
// holds it; the history itself is not thread-safe.
#pragma once

#include <deque>

#include "app/lab/run/lab_scene.h"
#include "coupling/device/device_motion.h"

namespace twinarm {

// Mouse spring at the end of a step.
struct MouseSpringState {
  int body = 0;
  Vector3 p_L = Vector3::Zero();      // point of the body, link axes [m]
  Vector3 goal_W = Vector3::Zero();   // [m]
  Vector3 force_W = Vector3::Zero();  // on the body, mean over the step [N]
};

// Operator input at the end of a step.
struct OperatorFrame {
  bool active = false;             // false: the scene's own motion drives the target robot
  std::array<double, 6> theta{};   // of the (virtual) Omni [rad]
  std::vector<double> q_K;         // targets of the driven joints at the start of the step [rad, m]
  std::vector<double> qd_K;        // and their rates [rad/s, m/s]
  std::array<double, 3> torque{};  // of the device's motors [N m]
  Vector3 force_W = Vector3::Zero();  // on the stylus, world axes [N]
  bool gripper_closed = false;
  int mode = 0;  // DeviceWatchdog::Mode
};

// Frame of a variant (variants.h). Of a stopped one: the last, at the time of its stop.
struct LabFrame;
struct VariantFrame {
  std::shared_ptr<const LabFrame> frame;
  bool stopped = false;
};

struct LabFrame {
  RecordedFrame recorded;
  std::optional<OperatorFrame> hand;  // absent: no coupling can be driven by an operator
  std::optional<MouseSpringState> mouse;
  // Length of the mouse spring's energy account at the end of recorded.memory; a saved recording
  // does not contain it.
  std::size_t outside_bytes = 0;
  double input_stamp = 0;  // of the newest input in this frame, as sent by the client
  // Since the frame before: processor time per step, mean and maximum [s]; real-time factor divided
  // by the requested one.
  double step_time = 0, longest_step = 0, pace = 1;
  double residual = 0;                 // of contacts and limits in the last step [m/s, rad/s]
  int asleep = 0;                      // bodies (solver/stepping/island_sleep.h)
  std::vector<VariantFrame> variants;  // from the second on
};

// Spring-damper from a point of a body to a goal in the world.
struct MouseSpringInput {
  int body = 0;
  Vector3 p_L = Vector3::Zero();     // link axes [m]
  Vector3 goal_W = Vector3::Zero();  // [m]
  double k = 0, b = 0;               // [N/m], [N s/m]
  double max_force = 0;              // of the spring [N]
};

// External inputs of the step [t, t + h]. Repeating the step with them reproduces it bit for bit.
struct LabInput {
  long step = 0;                   // the first of a run is 1
  double t = 0, h = 0;             // [s]
  std::optional<DeviceStep> hand;  // absent: the scene's own motion
  std::optional<MouseSpringInput> mouse;
  double stamp = 0;  // of the newest command in it, as sent by the client
};

// The operator motion of a step, extrapolated to the step [t, t + h].
DeviceStep shifted_to(double t, double h, DeviceStep step);

// Names of the rows of energy and momentum balance, by the numbers in frames.
struct LabNames {
  std::vector<std::string> rows, momentum_rows;
};

std::size_t bytes_of(const LabFrame& frame);  // with its variants

class LabHistory {
 public:
  using Frame = std::shared_ptr<const LabFrame>;
  static constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
  explicit LabHistory(std::size_t max_bytes = kMaxBytes) : max_(max_bytes) {}

  // Removes stored frames of the same or a later step.
  Frame add(LabFrame frame);
  // Inputs of the step just taken. Steps without operator and mouse input need not be added.
  void add(const LabInput& input);
  // From the newest frame on a run with these changes follows; its first frame, added next,
  // replaces the last one of the old run.
  void begin_segment(std::vector<Change> changes);

  bool empty() const { return frames_.empty(); }
  std::size_t size() const { return frames_.size(); }
  const Frame& frame(std::size_t n) const { return frames_[n]; }  // 0: the oldest
  const Frame& newest() const { return frames_.back(); }
  // Index of the last frame at or before t; 0 if all are later. The history must not be empty.
  std::size_t at(double t) const;
  std::size_t bytes() const { return bytes_; }
  std::size_t max_bytes() const { return max_; }
  std::vector<LabInput> inputs_after(long step) const;
  // Null: no input in that step, or already removed.
  const LabInput* input(long step) const;
  const LabInput* input_at(double t) const;  // of the step that contains [t, t + epsilon)
  // Starts a branch at frame n: moves everything after it, and a copy of frame n, to the result.
  LabHistory cut(std::size_t n);

  // Saves the frames since the last event that a recording's header cannot describe (a changed
  // parameter, another input source, a mouse spring); `twinarm replay` repeats them bit for bit.
  // `driven`: InputOverride::couplings(). Throws InputError: file not writable, or empty history.
  void save(const LabScene& scene, const LabNames& names, const std::vector<std::size_t>& driven,
            const std::filesystem::path& file) const;

 private:
  struct Segment {
    long first_step;
    std::vector<Change> changes;
  };
  void trim();
  long first_step_to_save() const;
  std::string operator_log() const;

  std::size_t max_, bytes_ = 0;
  std::deque<Frame> frames_;
  std::deque<LabInput> inputs_;
  std::deque<Segment> segments_;
};

}  // namespace twinarm
