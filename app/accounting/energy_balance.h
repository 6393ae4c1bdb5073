// Energy balance: work on the bodies since the start of a run, by source.
//
//   T(t) - T(0) = gravity + actuators + wrenches + damping + friction + couplings + numerical
// Gravity is exact, by its potential; so is a constant torque on a joint whose velocity is the rate
// of its coordinate. The others are integrals of power over each step: trapezoidal rule for
// integrators of order 1 and 2, Simpson's rule for order 4, Lobatto's rule of order 6 for order 5,
// at states of side steps, so that the residual `numerical` is the integrator's error
// (energy drift).
//
// Coupling force: k e + b (v_K - v), e' = v_K - v. Row `spring` is the work of the target on the
// spring minus the change of k e^2 / 2; row `damper` the work of the damper on the link. An
// implicit spring-damper applies its force at the start of the step minus m* dv/h, dv the change of
// the link's velocity; the work of this term over (v + v')/2 is the row `implicit` (numerical
// damping). The work of an as-published law beyond a spring and a relative damper is `as_printed`,
// all work of a god object `drive`. hand() is the work of the target, force times v_K; it is not in
// the sum.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/accounting/posed_states.h"
#include "app/robot/robot_input.h"
#include "app/scene/forces/given_forces.h"
#include "app/scene/forces/reported_forces.h"
#include "app/scene/forces/scene_couplings.h"
#include "solver/integration/integrator.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class EnergyBalance {
 public:
  // All must outlive it; `couplings` may be null.
  EnergyBalance(const RobotInput& input, GivenForces& given, SceneCouplings* couplings,
                Integrator integrator, bool others_want_inner, PosedStates& poses);

  // Inner quadrature nodes within a step, in (0, 1).
  std::span<const double> inner_nodes() const { return nodes_; }
  std::span<const double> weights() const { return weights_; }  // of all nodes, ends included
  // A step of h from the state of the last call (or the start), with the states at inner_nodes().
  void add_step(double h, const std::vector<State<double>>& inner, const State<double>& end);
  const State<double>& now() const { return now_; }
  std::vector<EnergyRow> rows() const;  // `numerical` last
  // Reading requires a run with the same rows.
  void serialize(StateArchive& memory);
  std::vector<EnergyRow> input_work() const;  // work of the targets, by coupling

 private:
  struct Actuator {
    const NamedJoint* joint;
    bool is_exact;  // its velocity is the rate of its coordinate
  };
  struct Friction {
    std::string joint;
    std::size_t iv, nv;
  };
  void find_rows(Integrator integrator, bool others_want_inner);
  using Side = SceneCouplings::Side;  // one-sided limit at a kink of the target's motion
  std::vector<double> powers(const State<double>& x, Side side) const;  // as integrals_
  double elastic_energy(std::size_t c, const State<double>& x) const;   // k e^2 / 2
  double spring_energy(std::size_t i, const State<double>& x) const;    // k (l - l0)^2 / 2
  struct Energies {
    double kinetic, potential;  // [J]
  };
  Energies energies(const State<double>& x) const;
  void add_implicit(double h, const State<double>& end);
  std::size_t coupling_count() const { return couplings_ ? couplings_->size() : 0; }

  const RobotInput& input_;
  GivenForces& given_;
  std::vector<Actuator> actuators_;
  std::vector<Friction> damped_, friction_;
  SceneCouplings* couplings_;
  // Three per coupling at the end: target on spring (k e . v_K), damper on link, target on damper.
  std::vector<EnergyRow> integrals_;
  std::vector<double> implicit_;  // h force - m* dv over the mean velocity, by coupling
  std::vector<double> nodes_, weights_;
  PosedStates& poses_;
  mutable Workspace<double> w_;
  State<double> start_, now_;
  Energies at_start_;
  std::vector<double> power_now_;
};

// Detects numerical energy growth before a run diverges.
//
// Rows examined: residual `numerical`, `implicit` of couplings, stabilisation of constraints and
// contacts. In a stable run they stay small; an instability grows exponentially. Alarm: a row that
// grew in each of four windows of equal length, by a factor of 1.5 or more from window to window,
// and now exceeds
//   - the largest kinetic energy before these windows, and the weight times 1e-6 m,
//   - a quarter of the largest kinetic energy so far.
// Windows have 16 steps, 32, 64, ..., to detect slow growth too. Burst alarm: within one window of
// 16 steps a row grew by more than ten times the largest kinetic energy before (and ten times the
// weight times 1 mm), to more than half of the largest so far. Losses never raise an alarm.
struct Alarm {
  std::string row;   // of the energy balance
  double t = 0;      // [s]
  double work = 0;   // [J]
  double since = 0;  // start of its windows [s]
};

class EnergyAlarm {
 public:
  static constexpr long kWindow = 16;  // steps

  explicit EnergyAlarm(double weight) : floor_(1e-6 * weight) {}
  // To be called every kWindow steps; returns an alarm at most once.
  std::optional<Alarm> look(double t, double kinetic, const std::vector<EnergyRow>& rows);

 private:
  static constexpr std::size_t kScales = 16, kMarks = 5;
  static constexpr long kCoarser = 2;
  struct Mark {
    double t = 0, max_kinetic = 0;
    std::vector<EnergyRow> rows;
  };
  struct Scale {
    std::array<Mark, kMarks> marks;  // newest last
    std::size_t count = 0;
  };
  std::optional<Alarm> burst(const Scale& finest) const;
  std::optional<Alarm> examine(const Scale& scale) const;

  double floor_, max_kinetic_ = 0;
  long count_ = 0;
  bool has_alarmed_ = false;
  std::array<Scale, kScales> scales_;
};

}  // namespace twinarm
