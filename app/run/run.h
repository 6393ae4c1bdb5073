// A run of `twinarm simulate`: steps on a time grid, samples at any time, energy accounting.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/accounting/energy_balance.h"
#include "app/accounting/momentum_balance.h"
#include "app/robot/robot_input.h"
#include "app/run/simulate_input.h"
#include "app/scene/forces/add_contacts.h"
#include "solver/dynamics/kinematics.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

class SteppedRun;  // app/run/stepped_run.h

// Diagnostic::code if a run cannot be resumed from the state of another one.
inline constexpr std::string_view kOtherMemory = "run.other-memory";

// Where to resume an earlier run, and its last step.
struct RunStart {
  std::string memory;
  long last_step = std::numeric_limits<long>::max();
  // true: start in the state of the input instead of `memory`, at this step and time.
  bool anew = false;
  long step = 0;
  double time = 0;  // [s]
};

// A spring or damper beyond its stability limit, by linear theory.
struct StabilityViolation {
  enum class Kind { coupling, joint_damper };
  Kind kind = Kind::coupling;
  std::size_t index = 0;  // in SceneDescription::couplings; of a damper the body of the joint
  std::string name, scheme;
  double step = 0, max_step = 0;  // held force: interval of evaluations [s]
  double product = 0, limit = 0;  // omega h and its stability limit
  std::string gain, fix;          // name of the gain; suggested fix
  double max_gain = 0;  // stable at this step (of a time constant the minimum); 0: none, or unknown
};

// Why a run diverged.
struct PostMortem {
  double time = 0;                         // of the last valid state [s]
  long step = 0;                           // number of the failed step, from 1
  std::string body, joint, field, reason;  // the first quantity of ABA that is not finite, its body
  int pass = 0;  // of the field; 0: an input of ABA, or coordinates and velocities
  bool by_energy = false;
  double kinetic_energy = 0, energy_bound = 0;  // [J]; of the last valid state
  // Added by app/diagnose/post_mortem.h:
  std::vector<std::string> words;
  std::vector<StabilityViolation> violations;
  std::string recording;      // of the last steps
  std::string row;            // of the energy balance, with the largest growth in them
  double row_growth = 0;      // [J]
  std::string fastest_joint;  // in the last valid state
};

struct SimulateResult {
  long steps = 0;
  double end = 0;  // [s]; of a diverged run the last valid time
  std::vector<EnergyRow> energy_balance;
  std::vector<MomentumRow> momentum;
  std::vector<EnergyRow> input_work;  // work of the targets of couplings; not part of the sum
  std::vector<std::string> warnings;
  int contacts = 0;  // active contact points at the last step
  // Largest of all steps: residual of contacts and limits [m/s, rad/s], penetration [m].
  double residual = 0, penetration = 0;
  std::optional<PostMortem> post_mortem;
  std::optional<Alarm> alarm;
  std::string alarm_words;  // text of the alarm
  std::string checkpoint;   // of a diverged run: its state 1,000 to 2,000 steps before
};

struct RunWatch {
  std::function<void(const std::string&)> warn;  // before the run; also in the result
  // At the times of the plan, in their order.
  std::function<void(double t, const State<double>&)> sample = [](double, const State<double>&) {};
  std::function<void(SteppedRun&)> look;           // at the start and after each step
  std::function<std::string(const Alarm&)> alarm;  // at most once; returns its text
  std::function<void(double t)> tick;              // after each step; may throw
  // Called within long steps; true ends the step, and tick(), which must throw, is called.
  bool (*interrupted)() = nullptr;
};

// The part of SteppedRun::memory() that Simulation::serialize reads.
StateArchive simulation_memory(const std::string& memory);

// Samples between two grid times are computed by a side step from the earlier one and do not change
// the run. `start`: resumes there, bit by bit. Throws InputError if it is of another scene.
SimulateResult run_plan(const SimulateInput& input, const RunPlan& plan, const RunWatch& watch,
                        const RunStart* start = nullptr);

// Columns of a run: output of `simulate`, frames of recordings, plots of pages.
struct RunColumn {
  std::string name, unit;  // "q/arm1" [rad], "links/hand/x" [m], "kinetic_energy" [J]
  std::string kind, of;    // "coordinate" of "arm1"; as in app/web/src/protocol/run.ts

  std::string with_unit() const { return name + "[" + unit + "]"; }
};

// Coordinates, velocities, positions of the links' origins; kinetic and potential energy last.
std::vector<RunColumn> run_columns(const RobotInput& input);
// Their values; k: kinematics of x.
std::vector<double> run_values(const RobotInput& input, const State<double>& x,
                               const Kinematics& k);

double weight_of(const Model<double>& model);  // [N]
// Default of RunPlan::energy_bound [J], after an energy alarm or without one.
double default_energy_bound(const Model<double>& model, const State<double>& start, bool alarmed);

// Post-mortem of a failed step from t; `last`: the last valid state.
PostMortem examine_end(const StepReport& report, const Simulation& simulation,
                       const State<double>& last, double t, long step);

// Warnings; empty if there is nothing to warn of.

// Floating-base robots with semi-implicit Euler, whose steps in joint coordinates conserve momentum
// only to first order in the step. Not with event-driven steps, nor with contacts or limits under
// gravity, which determine the momentum.
std::string drift_warning(const Simulation& simulation, const RunPlan& plan);

std::string deep_start_warning(const SceneContacts& contacts, ContactMode mode);

// Times that differ by less than this fraction of a step are equal.
inline constexpr double kSameTime = 1e-9;

// Times n * step of a run with fixed steps; the last is `duration`, which may be infinite [s].
class TimeGrid {
 public:
  TimeGrid(double step, double duration) : step_(step), duration_(duration) {
    if (std::isinf(duration_)) return;
    const double whole = std::floor(duration_ / step_ + kSameTime);
    steps_ = static_cast<long>(whole);
    if (duration_ - whole * step_ > kSameTime * step_) ++steps_;
  }
  long steps() const { return steps_; }
  double time(long n) const { return n >= steps_ ? duration_ : static_cast<double>(n) * step_; }
  // Whether t after n steps is a time of the grid.
  bool contains(long n, double t) const { return std::abs(t - time(n)) <= kSameTime * step_; }
  // Length of the step from t, which need not be on the grid: the last step may be shorter.
  double length(double t) const {
    const double rest = duration_ - t;
    return rest < step_ * (1 - kSameTime) ? rest : step_;
  }

 private:
  double step_, duration_;
  long steps_ = std::numeric_limits<long>::max();
};

}  // namespace twinarm
