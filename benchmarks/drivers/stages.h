// How far a program has come, a line on stderr as each of its stages begins, with the time left:
// stages of equal weight are expected to take equally long.
#pragma once

#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>

namespace twinarm::bench {

class Stages {
 public:
  Stages(std::string program, double total) : program_(std::move(program)), total_(total) {}

  void begin(const std::string& what, double weight = 1) {
    std::cerr << program_ << ": ";
    if (done_ > 0)
      std::cerr << std::lround(100 * done_ / total_) << " %, about "
                << std::lround(seconds() / done_ * (total_ - done_)) << " s left: ";
    std::cerr << what << std::endl;
    done_ += weight;
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  std::string program_;
  double total_, done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace twinarm::bench
