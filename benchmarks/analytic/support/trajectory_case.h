// A known motion: mechanism, times, readings, and their reference values.
//
// run_trajectory() runs a case with any integrator. A case of one evaluation (accelerations,
// torques, energies in one state) has the only time 0: no step is taken. How to add a case:
// docs/develop/adding_a_case.md.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/forces/force_source.h"
#include "solver/integration/integrator.h"
#include "solver/linear_algebra/nan_max.h"
#include "solver/spatial/pose.h"

namespace twinarm {

class Simulation;

// Mechanism and initial state; created for every run.
struct CaseScene {
  Model<double> model{};
  State<double> start{};
  // Checkpointable if a time lies between two steps.
  std::vector<std::shared_ptr<ForceSource>> sources{};
  bool conserves = true;  // whether energy is constant
  // Potential energy of the sources [J].
  std::function<double(const State<double>&)> stored{};
  // Adds loops and prescribed motions before the first step.
  std::function<void(Simulation&)> prepare{};
};

// The same scene for every run; its sources must have no internal state.
inline std::function<CaseScene()> fixed(CaseScene scene) {
  return [scene = std::move(scene)] { return scene; };
}

// Integrator and step of a run.
struct Integration {
  Integrator integrator = Integrator::rk4;
  double step = 1e-3;       // [s]; maximum step of dopri5
  double tolerance = 1e-9;  // of dopri5, relative and absolute
};
inline Integration rk4_with(double step = 1e-3) {
  return {Integrator::rk4, step};
}
inline Integration dopri5_with(double tolerance = 1e-10) {
  return {Integrator::dopri5, 0.1, tolerance};
}

using CaseReadings = std::vector<double>;
template <class... Number>
CaseReadings values(Number... numbers) {
  return {static_cast<double>(numbers)...};
}
inline CaseReadings values(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
using CaseObserver = std::function<CaseReadings(const Model<double>&, const State<double>&)>;
using CaseReference = std::function<CaseReadings(double)>;
// The same, evaluated once at each time: it may take as long as a run. For any thread.
CaseReference cached(CaseReference reference);
// Error of the readings at one time.
using CaseMeasure = double (*)(const CaseReadings& seen, const CaseReadings& exact);

double max_difference(const CaseReadings& seen, const CaseReadings& exact);
double relative_to_largest(const CaseReadings& seen, const CaseReadings& exact);

// Mutants, with which a case must fail.
void more_gravity(CaseScene& scene);  // by 0.1 %
// By 0.1 % mass, Ixx and Izz of every body, about its origin, body axes.
void more_inertia(CaseScene& scene);

// Instead of times: the first instants at which `zero` changes its sign, located with the
// integrator's own step. Their time is the first reading, before those of `observe`.
struct CaseEvents {
  std::function<double(const Model<double>&, const State<double>&)> zero{};
  int count = 0;
  double until = 0;  // the run fails if not all have occurred by then [s]
};

struct TrajectoryCase {
  std::function<CaseScene()> scene;
  std::vector<double> times{};          // ascending [s]; none with events
  std::vector<std::string> readings{};  // names of observe()'s values, with unit: "angle [rad]"
  CaseObserver observe = [](const Model<double>&, const State<double>&) { return CaseReadings{}; };
  CaseReference reference;    // by time; with events, by the number of the event, from 1
  Integration integration{};  // of the case's error
  CaseMeasure measure = max_difference;
  void (*mutant)(CaseScene&) = more_gravity;  // its error must exceed the tolerance
  CaseEvents events{};
  // The reference is the result of one scheme at one step.
  bool needs_its_integrator = false;
  bool at_times_only = false;  // the reference is known at these times only

  bool has_steps() const { return events.count > 0 || times.back() > 0; }
  bool takes_any_integrator() const { return has_steps() && !needs_its_integrator; }
};

// One evaluation in the initial state.
TrajectoryCase evaluation(CaseScene scene, std::vector<std::string> readings, CaseObserver observe,
                          CaseReadings exact, CaseMeasure measure = relative_to_largest);
// The same with another integrator or step.
inline TrajectoryCase integrated_by(const Integration& integration, TrajectoryCase motion) {
  motion.integration = integration;
  return motion;
}
// The same motion, of which only the times of events are checked.
TrajectoryCase times_of(TrajectoryCase motion, CaseEvents events, CaseReference reference);

struct TrajectoryResult {
  double error = 0;                      // maximum over all times; NAN if the run stopped early
  std::optional<double> energy_drift{};  // max |E - E0| over the largest kinetic energy
  double seconds = 0;
  long steps = 0;
};

// Recorded at the start and after every step.
struct TrajectoryPoint {
  double t;
  CaseReadings seen;
  double energy;  // kinetic + gravity + sources [J]
};

TrajectoryResult run_trajectory(const TrajectoryCase& c, const Integration& integration,
                                std::vector<TrajectoryPoint>* recording = nullptr);

// Error of the mutant with the case's integrator and step.
double mutant_error(const TrajectoryCase& c);

// Order of convergence from errors with the steps h, 2h, 4h ..: slope of log2(error) through the
// first three that exceed rounding and whose two slopes agree to 0.3; empty if there are none.
std::optional<double> slope_of(const std::vector<double>& errors, double rounding);
double rounding_of(const TrajectoryCase& c);  // 1e-12 of the largest reading

// With the given step, its double and so on; empty for dopri5.
std::optional<double> observed_order(const TrajectoryCase& c, const Integration& integration);

}  // namespace twinarm
