// What the lab remembers of a run: frames with memory, and what came from outside in each step,
// within a bound of bytes; the oldest goes first. A frame, once in, never changes and may be read
// by any thread that holds it; the history itself belongs to one thread at a time.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/lab/run/lab_frame.h"
#include "app/lab/run/lab_scene.h"

namespace twinarm {

std::size_t bytes_of(const LabFrame& frame);  // with its lanes

class LabHistory {
 public:
  using Frame = std::shared_ptr<const LabFrame>;
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;
  explicit LabHistory(std::size_t most_bytes = kMostBytes) : most_(most_bytes) {}

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
  std::size_t most_bytes() const { return most_; }
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

  std::size_t most_, bytes_ = 0;
  std::deque<Frame> frames_;
  std::deque<LabInput> inputs_;
  std::deque<Segment> segments_;
};

}  // namespace twinarm
