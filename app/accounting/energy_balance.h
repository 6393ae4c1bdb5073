// Where the joules come from: work done on the bodies from the start of a run, row by row.
//
//   KE(t) - KE(0) = gravity + actuators + wrenches + damping + friction + couplings + numerical
// Gravity is exact, by its potential; so is a constant torque on a joint whose velocity is the rate
// of its coordinate. All others are integrals of power over each step: by the trapezoidal rule for
// integrators of order 1 and 2, by Simpson's rule and by Lobatto's of order 6 for those of order 4
// and 5, at states that a side step finds, so that `numerical` is the integrator's error and not
// the ledger's.
//
// A coupling pulls with k e + b (v_K - v). Row `spring` is what the hand puts into the spring less
// the rise of k e^2 / 2, for e' = v_K - v; row `damper` is the power of the damper on the link. An
// implicit treatment pulls with what it had at the start of the step less m* dv/h, dv the change of
// the link's velocity; what that works besides, over (v + v')/2, is its row `implicit`: numerical
// damping. What a law as printed works besides a spring and a relative damper is `as_printed`, and
// all that a god object works `drive`. `hand` is the work of the kinematic side, the pull over v_K;
// it does not count in the sum.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

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
  EnergyBalance(const RobotInput& input, const std::vector<GivenWrench>& wrenches,
                SceneCouplings* couplings, Integrator integrator, bool others_want_inner);

  // Where within a step, as parts of it, the state is asked for besides its ends.
  std::span<const double> inner_nodes() const;
  std::span<const double> weights() const { return weights_; }  // the ends included
  // A step of h from the state of the last call (or the start), by way of inner_nodes().
  void add_step(double h, const std::vector<State<double>>& inner, const State<double>& end);
  const State<double>& now() const { return now_; }
  std::vector<EnergyRow> rows() const;  // `numerical` last
  // The sums so far; the rows of another run must be the same.
  void serialize(StateArchive& memory);
  std::vector<EnergyRow> hand() const;  // by the names of the couplings

 private:
  struct Actuator {
    const NamedJoint* joint;
    bool is_exact;
  };
  struct Friction {
    std::string joint;
    std::size_t iv, nv;
  };
  void find_rows(Integrator integrator, bool others_want_inner);
  using Side = SceneCouplings::Side;  // of a corner in the motion of a kinematic robot
  std::vector<double> powers(const State<double>& x, Side side) const;  // by integrals_
  double elastic_energy(std::size_t c, const State<double>& x) const;   // k e^2 / 2
  void add_implicit(double h, const State<double>& end);
  std::size_t coupling_count() const { return couplings_ ? couplings_->size() : 0; }

  const RobotInput& input_;
  const std::vector<GivenWrench>& wrenches_;
  std::vector<Actuator> actuators_;
  std::vector<Friction> damped_, rubbing_;
  SceneCouplings* couplings_;
  // The last three of each coupling: k e . v_K (hand on spring), damper on link, hand on damper.
  std::vector<EnergyRow> integrals_;
  std::vector<double> implicit_;         // work of each coupling's treatment
  std::vector<double> nodes_, weights_;  // inner nodes; weights of all, the ends included
  mutable Kinematics k_;
  State<double> start_, now_;
  std::vector<double> power_now_;
};

// Says when something creates energy without bound: a run that will explode says so before it does.
//
// Looked at are the rows of what no law of nature does: `numerical`, what implicit treatments of
// couplings do besides their springs, and what stabilises constraints and contacts. In a sound run
// they stay small; an instability grows by a factor in each length of time. So an alarm is a row
// that over four windows of equal length grew, from window to window by half as much again at
// least, and now exceeds
//   - the largest kinetic energy before those windows, and what the weight is worth over 1e-6 m,
//   - a quarter of the largest kinetic energy so far.
// A run where that holds has lost count of its energy. Windows have 16 steps, 32, 64 and so on, so
// that slow growth is seen too. What bursts within one window of 16 steps and may be over after it
// is a row that grew by more than ten times the largest kinetic energy before (and ten times what
// the weight is worth over 1 mm), to more than half of the largest so far. Losses are bounded, and
// never alarm.
struct Alarm {
  std::string row;   // of the ledger
  double t = 0;      // [s]
  double work = 0;   // [J]
  double since = 0;  // its windows began then [s]
};

class EnergyAlarm {
 public:
  static constexpr long kWindow = 16;  // steps

  explicit EnergyAlarm(double weight) : floor_(1e-6 * weight) {}
  // After every kWindow steps; the first that alarms, once in all.
  std::optional<Alarm> look(double t, double kinetic, const std::vector<EnergyRow>& rows);

 private:
  static constexpr std::size_t kScales = 16, kMarks = 5;
  static constexpr long kCoarser = 2;
  struct Mark {
    double t = 0, max_kinetic = 0;
    std::vector<EnergyRow> rows;
  };
  struct Scale {
    std::array<Mark, kMarks> marks;  // the last one is the newest
    std::size_t count = 0;
  };
  std::optional<Alarm> burst(const Scale& finest) const;
  std::optional<Alarm> examine(const Scale& scale) const;

  double floor_, max_kinetic_ = 0;
  long count_ = 0;
  bool is_told_ = false;
  std::array<Scale, kScales> scales_;
};

}  // namespace twinarm
