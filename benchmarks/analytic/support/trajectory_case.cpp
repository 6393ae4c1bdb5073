#include "benchmarks/analytic/support/trajectory_case.h"

#include <chrono>
#include <limits>
#include <map>
#include <mutex>

#include "solver/dynamics/energy_momentum.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// Simulation of a case up to given times or events.
class Run {
 public:
  Run(const TrajectoryCase& c, CaseScene& scene, const Integration& integration,
      std::vector<TrajectoryPoint>* recording)
      : case_(c),
        scene_(scene),
        integration_(integration),
        recording_(recording),
        simulation_(scene.model, scene.start) {
    simulation_.set_integrator(integration.integrator, integration.tolerance);
    for (const auto& source : scene.sources) simulation_.add(*source);
    if (scene.prepare) scene.prepare(simulation_);
    energy_at_start_ = record();
  }

  // State at t >= the time of the last call; empty if the run stopped early.
  std::optional<State<double>> at(double t) {
    const double rounding = 1e-9 * integration_.step;
    if (adaptive()) {
      while (t - now_ > rounding)
        if (!advance(t - now_)) return {};
      return simulation_.state();
    }
    while (t - now_ > integration_.step - rounding)
      if (!advance(integration_.step)) return {};
    if (t - now_ <= rounding) return simulation_.state();
    return side_step(simulation_, t - now_);
  }

  // State and time of the next sign change of the event function.
  std::optional<State<double>> next_event(double& t) {
    const auto sign = [&](const State<double>& x) {
      const double value = case_.events.zero(scene_.model, x);
      return value > 0 ? 1 : value < 0 ? -1 : 0;
    };
    if (sign_ == 0) sign_ = sign(simulation_.state());
    while (now_ < case_.events.until) {
      const State<double> before = simulation_.state();
      const double start = now_;
      if (!advance(integration_.step)) return {};
      const int after = sign(simulation_.state());
      if (after == 0 || sign_ == 0 || after == sign_) {
        if (after != 0) sign_ = after;
        continue;
      }
      sign_ = after;
      const State<double> end = simulation_.state();
      simulation_.set_state(before);
      double low = 0, high = now_ - start;
      for (double middle = high / 2; low < middle && middle < high; middle = (low + high) / 2)
        (sign(side_step(simulation_, middle)) == after ? high : low) = middle;
      const State<double> event = side_step(simulation_, high);
      t = start + high;
      simulation_.set_state(end);
      return event;
    }
    return {};
  }

  std::optional<double> energy_drift() const {
    if (!scene_.conserves || !case_.has_steps() || !(max_kinetic_ > 0)) return {};
    return energy_error_ / max_kinetic_;
  }
  long steps() const { return steps_; }

 private:
  bool adaptive() const { return integration_.integrator == Integrator::dopri5; }

  // One step of h; of dopri5 at most h.
  bool advance(double h) {
    const StepReport report = simulation_.step(h, adaptive());
    if (!report.ok()) return false;
    // A product has less rounding than a sum of many steps.
    ++steps_;
    now_ = adaptive() ? now_ + report.h : static_cast<double>(steps_) * integration_.step;
    energy_error_ = std::max(energy_error_, std::abs(record() - energy_at_start_));
    return true;
  }

  double record() {  // returns the energy
    const State<double>& x = simulation_.state();
    if (!scene_.conserves && !recording_) return 0;
    const double kinetic = kinetic_energy(scene_.model, x);
    max_kinetic_ = std::max(max_kinetic_, kinetic);
    const double stored = scene_.stored ? scene_.stored(x) : 0;
    const double energy = kinetic + potential_energy(scene_.model, x) + stored;
    if (recording_) recording_->push_back({now_, case_.observe(scene_.model, x), energy});
    return energy;
  }

  const TrajectoryCase& case_;
  CaseScene& scene_;
  Integration integration_;
  std::vector<TrajectoryPoint>* recording_;
  Simulation simulation_;
  double now_ = 0, energy_at_start_ = 0, energy_error_ = 0, max_kinetic_ = 0;
  long steps_ = 0;
  int sign_ = 0;  // last nonzero sign of the event function
};

TrajectoryResult measure(const TrajectoryCase& c, CaseScene scene, const Integration& integration,
                         std::vector<TrajectoryPoint>* recording) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  TrajectoryResult result;
  Run run(c, scene, integration, recording);
  const auto compare = [&](const CaseReadings& seen, double argument) {
    result.error = nan_max(result.error, c.measure(seen, c.reference(argument)));
    return !std::isnan(result.error);
  };
  const auto at_time = [&](double t) {
    const auto x = run.at(t);
    return x && compare(c.observe(scene.model, *x), t);
  };
  const auto at_event = [&](int n) {
    double t = 0;
    const auto x = run.next_event(t);
    if (!x) return false;
    CaseReadings seen = c.observe(scene.model, *x);
    seen.insert(seen.begin(), t);
    return compare(seen, n);
  };
  bool ok = std::ranges::all_of(c.times, at_time);
  for (int n = 1; ok && n <= c.events.count; ++n) ok = at_event(n);
  if (!ok) result.error = kNothing;
  result.energy_drift = run.energy_drift();
  result.steps = run.steps();
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

double max_reference(const TrajectoryCase& c) {
  double largest = 0;
  const auto include = [&](double argument) {
    for (const double value : c.reference(argument)) largest = std::max(largest, std::abs(value));
  };
  for (const double t : c.times) include(t);
  for (int n = 1; n <= c.events.count; ++n) include(n);
  return largest;
}

}  // namespace

double max_difference(const CaseReadings& seen, const CaseReadings& exact) {
  if (seen.size() != exact.size()) return kNothing;
  double error = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    error = nan_max(error, std::abs(seen[i] - exact[i]));
  return error;
}

double relative_to_largest(const CaseReadings& seen, const CaseReadings& exact) {
  double largest = 0;
  for (const double value : exact) largest = std::max(largest, std::abs(value));
  return max_difference(seen, exact) / largest;
}

CaseReference cached(CaseReference reference) {
  struct Known {
    std::mutex lock;
    std::map<double, CaseReadings> at;
  };
  return [reference = std::move(reference), known = std::make_shared<Known>()](double t) {
    const std::lock_guard held(known->lock);
    const auto found = known->at.find(t);
    return found != known->at.end() ? found->second : known->at[t] = reference(t);
  };
}

TrajectoryCase evaluation(CaseScene scene, std::vector<std::string> readings, CaseObserver observe,
                          CaseReadings exact, CaseMeasure measure) {
  return {.scene = fixed(std::move(scene)),
          .times = {0},
          .readings = std::move(readings),
          .observe = std::move(observe),
          .reference = [exact](double) { return exact; },
          .measure = measure};
}

TrajectoryCase times_of(TrajectoryCase motion, CaseEvents events, CaseReference reference) {
  motion.times = {}, motion.readings = {}, motion.observe = TrajectoryCase{}.observe;
  motion.reference = std::move(reference), motion.measure = max_difference;
  motion.events = std::move(events);
  return motion;
}

void more_gravity(CaseScene& scene) {
  scene.model.gravity = 1.001 * scene.model.gravity;
}

void more_inertia(CaseScene& scene) {
  for (Inertia<double>& inertia : scene.model.I) {
    inertia.m *= 1.001;
    inertia.I.xx *= 1.001;
    inertia.I.zz *= 1.001;
  }
}

TrajectoryResult run_trajectory(const TrajectoryCase& c, const Integration& integration,
                                std::vector<TrajectoryPoint>* recording) {
  return measure(c, c.scene(), integration, recording);
}

double mutant_error(const TrajectoryCase& c) {
  CaseScene scene = c.scene();
  c.mutant(scene);
  return measure(c, std::move(scene), c.integration, nullptr).error;
}

std::optional<double> slope_of(const std::vector<double>& errors, double rounding) {
  for (std::size_t i = 0; i + 2 < errors.size(); ++i) {
    if (!(errors[i] > rounding)) continue;
    const double fine = std::log2(errors[i + 1] / errors[i]);
    const double coarse = std::log2(errors[i + 2] / errors[i + 1]);
    // Least squares through three points at equal distances.
    if (fine > 0.5 && std::abs(fine - coarse) < 0.3) return (fine + coarse) / 2;
  }
  return {};
}

double rounding_of(const TrajectoryCase& c) {
  return 1e-12 * max_reference(c);
}

std::optional<double> observed_order(const TrajectoryCase& c, const Integration& integration) {
  if (!c.takes_any_integrator() || integration.integrator == Integrator::dopri5) return {};
  const double rounding = rounding_of(c);
  std::vector<double> errors;
  double h = integration.step;
  for (int i = 0; i < 9; ++i, h *= 2) {
    CaseScene scene = c.scene();
    scene.conserves = false;  // its energy is not needed
    errors.push_back(measure(c, std::move(scene), {integration.integrator, h}, nullptr).error);
    if (const auto slope = slope_of(errors, rounding)) return slope;
  }
  return {};
}

}  // namespace twinarm
