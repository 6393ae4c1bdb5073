// Timing of several jobs with comparable conditions on a loaded machine; progress of the programs.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace twinarm::bench {

struct Timing {
  double ns = 0;      // thread CPU time of one call of the job, median of the repetitions
  double spread = 0;  // (longest - shortest) / median
};

// In every repetition all jobs run one after the other, each for about `seconds`, so that a
// temporary load affects all.
std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& jobs,
                                     int repetitions, double seconds);

// `redrawn`: one line that is overwritten on a terminal; elsewhere a line every 5 s at most.
enum class StageLines { all, redrawn };

// Progress on stderr: a line at the start of each stage, with the estimated time left. The time of
// a stage is assumed to be proportional to its weight.
class Stages {
 public:
  Stages(std::string program, double total, StageLines lines = StageLines::all)
      : program_(std::move(program)),
        total_(total),
        redrawn_(lines == StageLines::redrawn && isatty(STDERR_FILENO) == 1) {}
  ~Stages() {
    if (redrawn_) std::cerr << "\r\033[K" << std::flush;
  }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  void begin(const std::string& what, double weight = 1) {
    std::cerr << (redrawn_ ? "\r\033[K" : "") << program_ << ": ";
    if (done_ > 0)
      std::cerr << std::lround(100 * done_ / total_) << " %, about "
                << std::lround(seconds() / done_ * (total_ - done_)) << " s left: ";
    std::cerr << what << (redrawn_ ? "" : "\n") << std::flush;
    printed_ = seconds();
    done_ += weight;
  }
  // One of many short stages.
  void begin_seldom(const std::string& what, double weight) {
    if (seconds() - printed_ < (redrawn_ ? 0.1 : 5))
      done_ += weight;
    else
      begin(what, weight);
  }
  // Reduces the total weight; a negative weight increases it.
  void skip(double weight) { total_ -= weight; }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  std::string program_;
  double total_, done_ = 0, printed_ = 0;
  bool redrawn_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace twinarm::bench
