// Times of several jobs, taken so that their ratios are fair on a machine with other work on it.
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

// In every repetition all jobs run one after the other, each for about `seconds`: what disturbs the
// machine for a while disturbs all of them.
std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& jobs,
                                     int repetitions, double seconds);

// How far a program has come, a line on stderr as each of its stages begins, with the time left:
// stages of equal weight are expected to take equally long.

// Of many short stages, one line is drawn again on a terminal, and elsewhere few are said.
enum class SceneLines { all, redrawn };

class Stages {
 public:
  Stages(std::string program, double total, SceneLines lines = SceneLines::all)
      : program_(std::move(program)),
        total_(total),
        redrawn_(lines == SceneLines::redrawn && isatty(STDERR_FILENO) == 1) {}
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
    said_ = seconds();
    done_ += weight;
  }
  // One of many alike.
  void begin_seldom(const std::string& what, double weight) {
    if (seconds() - said_ < (redrawn_ ? 0.1 : 5))
      done_ += weight;
    else
      begin(what, weight);
  }
  // What was expected and does not come; below zero: what comes and was not expected.
  void skip(double weight) { total_ -= weight; }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  std::string program_;
  double total_, done_ = 0, said_ = 0;
  bool redrawn_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace twinarm::bench
