// Runs cases in engines, one row for each engine, scheme and step.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "benchmarks/drivers/timing.h"
#include "benchmarks/engines/engine.h"
#include "benchmarks/scenes/scene.h"

namespace twinarm::bench {

// One engine with one scheme and step in one case.
struct Row {
  Engine* engine;
  std::string name;  // of its kind
  const SceneCase* test;
  Scheme scheme;
  double h;  // or the tolerance
  double error = NAN;
  long steps = 0;                 // of a fixed step; 0: adaptive
  std::vector<double> seconds{};  // by repetition: CPU time of the whole run
  std::string stopped{};          // why it did not come to its end
};

constexpr double kOnceIsEnough = 2;  // CPU seconds: a run that takes longer is not repeated

// What its first run is expected to take, and all its runs [CPU seconds, roughly].
double expected_seconds(const Row& row, double budget);
double expected_of_all(const Row& row, int repetitions, double budget);

// Each once for its error, which is not timed, then in `repetitions` turns for its time: in a turn
// all rows run one after the other, so that what disturbs the machine for a while disturbs all of
// them. A run that takes longer than `budget` [s] is stopped, and says so.
void measure(std::vector<Row>& rows, int repetitions, double budget, Stages& stages);

}  // namespace twinarm::bench
