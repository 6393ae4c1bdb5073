// A motion that is known: what moves, where and when it is looked at, and what should be seen.
//
// One aggregate holds a whole case; run_trajectory() runs it with any integrator. A case of one
// evaluation (accelerations, torques, energies in one state) is one whose only time is 0: no step
// is taken, and no integrator is asked. How to add one: docs/develop/adding_a_case.md.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/forces/force_source.h"
#include "solver/integration/integrator.h"
#include "solver/linear_algebra/nan_max.h"

namespace twinarm {

class Simulation;

// What moves. Made anew for every run.
struct CaseScene {
  Model<double> model{};
  State<double> start{};
  // Rewindable too (checkpointable.h) where a time lies between two steps.
  std::vector<std::shared_ptr<ForceSource>> sources{};
  bool conserves = true;  // energy is kept, so that its drift tells something
  // Energy of the sources, beside that of gravity [J].
  std::function<double(const State<double>&)> stored{};
  // Loops, laws of prescribed joints: once, before the first step.
  std::function<void(Simulation&)> prepare{};
};

// By what it is run.
struct Lane {
  Integrator integrator = Integrator::rk4;
  double step = 1e-3;       // [s]; of dopri5 the longest
  double tolerance = 1e-9;  // of dopri5, relative and absolute
};
inline Lane rk4_lane(double step = 1e-3) {
  return {Integrator::rk4, step};
}
inline Lane dopri5_lane(double tolerance = 1e-10) {
  return {Integrator::dopri5, 0.1, tolerance};
}

using CaseReadings = std::vector<double>;
inline CaseReadings rounded(std::initializer_list<long double> values) {
  return {values.begin(), values.end()};
}
using CaseObserver = std::function<CaseReadings(const Model<double>&, const State<double>&)>;
using CaseReference = std::function<CaseReadings(double)>;
// One number from what was seen at one time and what should have been.
using CaseMeasure = double (*)(const CaseReadings& seen, const CaseReadings& exact);

double max_difference(const CaseReadings& seen, const CaseReadings& exact);
double relative_to_largest(const CaseReadings& seen, const CaseReadings& exact);

// Mistakes that a case must notice.
void more_gravity(CaseScene& scene);  // by 0.1 %
// 0.1 % in mass and in two of the moments of inertia of every body, about its origin, body axes.
void more_inertia(CaseScene& scene);

// In place of times: the first places where `zero` changes its sign, found with the integrator's
// own step. A reading more, the time, comes before those of `observe`.
struct CaseEvents {
  std::function<double(const Model<double>&, const State<double>&)> zero{};
  int count = 0;
  double until = 0;  // a run in which they have not all come by then fails [s]
};

struct TrajectoryCase {
  std::function<CaseScene()> scene;
  std::vector<double> times{};          // ascending [s]; with events, none
  std::vector<std::string> readings{};  // what observe() gives, in order, with unit: "angle [rad]"
  CaseObserver observe = [](const Model<double>&, const State<double>&) { return CaseReadings{}; };
  // Computed in the case at every time; with events, for the number of the event, from 1 on.
  CaseReference reference;
  Lane lane{};  // in which it is judged
  CaseMeasure measure = max_difference;
  void (*mutant)(CaseScene&) = more_gravity;  // with this mistake the error is above the tolerance
  CaseEvents events{};
  // The reference is what a scheme gives at its step: no lane but its own.
  bool of_its_lane = false;
  bool at_times_only = false;  // the reference is known at the times and nowhere between

  bool has_steps() const { return events.count > 0 || times.back() > 0; }
  bool takes_lanes() const { return has_steps() && !of_its_lane; }
};

// One evaluation, in the state at the start.
TrajectoryCase evaluation(std::function<CaseScene()> scene, std::vector<std::string> readings,
                          CaseObserver observe, CaseReadings exact,
                          CaseMeasure measure = relative_to_largest);
// Of the same motion the times of events alone.
TrajectoryCase times_of(TrajectoryCase motion, CaseEvents events, CaseReference reference);

// Runs a TrajectoryCase in any lane.
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
