// How far a measurement has come and how long it still takes, on stderr: one line that is drawn
// again on a terminal, a line for each run elsewhere.
//
// What runs will take is guessed from their scenes; the guesses of those to come are scaled by what
// those that are done took, and once a run was seen its repetitions are known. CPU time becomes
// time of the clock by the ratio so far, so that other work on the machine is counted in.
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "benchmarks/drivers/peer_run.h"

namespace twinarm::bench {

class Progress {
 public:
  Progress(int repetitions, double budget);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void expect(const Row& row);                           // one that will come
  void begin(const Row& row, const std::string& again);  // says so; seldom of repetitions
  void saw(const Row& row, bool to_be_repeated);         // its first run is done
  void repeated(double seconds);                         // a repetition is, and took so long

 private:
  struct Guess {
    bool contacts;
    double seconds;  // CPU time of one run
  };
  Guess guess(const Row& row) const;
  double left() const;   // by the clock [s]
  double clock() const;  // since the start [s]

  int repetitions_;
  double budget_;
  bool terminal_;
  std::vector<Guess> guesses_;  // of all rows, in their order
  std::size_t seen_ = 0;        // rows
  // Of what was seen, without and with contacts; at the start alike.
  std::array<double, 2> guessed_{1e-3, 1e-3}, taken_{1e-3, 1e-3};
  double to_repeat_ = 0, spent_ = 0, drawn_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace twinarm::bench
