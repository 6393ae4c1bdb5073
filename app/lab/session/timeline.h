// What is remembered of the session's run: its history, what came after the instant at which the
// last branch began, and the scene that a recording of it needs. Any thread; no call takes longer
// than copying pointers.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/session/scene_builder_thread.h"

namespace twinarm {

class Timeline {
 public:
  using Frame = LabHistory::Frame;
  explicit Timeline(std::size_t max_bytes) : history_(max_bytes), before_(max_bytes) {}

  // From now on it is another run; led: LabRun::led().
  void begin(std::shared_ptr<const Built> scene, std::vector<std::size_t> led);
  void add(LabFrame frame, const LabNames& names);
  void add(const LabInput& input);
  void forget();
  // Back to an instant, where a branch begins. Null: it is no longer remembered.
  Frame branch(double t);

  // What came from outside in a step of the branch that was left, and whether more is known.
  struct Known {
    LabInput input;
    bool goes_on = false;
  };
  Known known_input(long step) const;

  // The newest instant, or that at t; `before`: the same time in the branch that was left.
  struct View {
    std::shared_ptr<const Built> scene;
    double first = 0, last = 0;  // that are remembered [s]
    Frame frame, before;
  };
  View view(std::optional<double> t) const;
  std::vector<Frame> frames(double from) const;
  std::shared_ptr<const Built> scene() const;
  void save(const std::filesystem::path& file) const;  // throws InputError

 private:
  mutable std::mutex mutex_;
  LabHistory history_, before_;
  std::shared_ptr<const Built> scene_;
  LabNames names_;
  std::vector<std::size_t> led_;
};

}  // namespace twinarm
