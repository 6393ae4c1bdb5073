// Runs a TrajectoryCase in any lane.
#pragma once

#include <optional>

#include "benchmarks/analytic/support/trajectory_case.h"

namespace twinarm {

struct LaneResult {
  double error = 0;  // largest measure of all times; not a number where the run stopped by itself
  std::optional<double> energy_drift{};  // max |E - E0| over the largest kinetic energy
  double seconds = 0;
  long steps = 0;  // that were done
};

// A run to look at: a point at the start and after every step.
struct TrajectoryPoint {
  double t;
  CaseReadings seen;
  double energy;  // kinetic, of gravity, of the sources [J]
};

LaneResult run_lane(const TrajectoryCase& c, const Lane& lane,
                    std::vector<TrajectoryPoint>* recording = nullptr);

// The same with the case's mistake in it, in its own lane.
double mutant_error(const TrajectoryCase& c);

// Of errors with the steps h, 2h, 4h ..: by how much, in powers of two, they fall when the step
// halves. The slope through the first three that are above rounding and whose two slopes agree to
// 0.3; nothing where no three do.
std::optional<double> slope_of(const std::vector<double>& errors, double rounding);
double rounding_of(const TrajectoryCase& c);  // 1e-12 of the largest reading

// The slope of the lane's step, its double and so on. Nothing for dopri5.
std::optional<double> observed_order(const TrajectoryCase& c, const Lane& lane);

}  // namespace twinarm
