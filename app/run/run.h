// A run of `twinarm simulate`: steps on a grid, samples at any time, the ledger.
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

// A run between two steps, as a recording sees it.
class RunView {
 public:
  virtual ~RunView() = default;
  virtual long step() const = 0;  // that was taken last; 0 at the start
  virtual const Simulation& simulation() const = 0;
  virtual const SceneContacts* contacts() const = 0;      // null for a URDF
  virtual std::vector<EnergyRow> ledger() const = 0;      // `numerical` last
  virtual std::vector<EnergyRow> hand() const = 0;        // work of the kinematic sides so far
  virtual std::vector<MomentumRow> momentum() const = 0;  // likewise
  virtual std::string memory() = 0;                       // all that the run goes on from
};

// Fault::code where a run cannot take over the memory of an earlier one.
inline constexpr std::string_view kOtherMemory = "run.other-memory";

// A step of an earlier run to begin at, and the last one to take.
struct RunStart {
  std::string memory;
  long last_step = std::numeric_limits<long>::max();
  // Without memory: anew, in the state of the input, counted from so many steps and that time.
  bool anew = false;
  long step = 0;
  double time = 0;  // [s]
};

// A spring or damper against the limit that the method sets to it, by linear theory.
struct StabilityViolation {
  enum class Kind { coupling, joint_damper };
  Kind kind = Kind::coupling;
  std::size_t index = 0;  // in SceneDescription::couplings; of a damper the body of the joint
  std::string name, scheme;
  double step = 0, max_step = 0;  // of a held force: between two evaluations [s]
  double product = 0, limit = 0;  // w h, and the largest that holds
  std::string gain, fix;          // which one; of what is beyond its limit, what would hold
  double max_gain = 0;  // that holds at this step (of a time constant the least); 0: none, or
                        // not asked for
};

// Why a run stopped by itself.
struct PostMortem {
  double time = 0;  // of the last good state [s]
  long step = 0;    // the number of the bad one, from 1
  // The first bad quantity in the order of the passes, and the body in whose row it stands.
  std::string body, joint, field, reason;
  int pass = 0;  // of the field; 0: an input of the passes, or coordinates and velocities
  bool by_energy = false;
  double kinetic_energy = 0, energy_bound = 0;  // [J]; of the last good state
  // What app/diagnose/post_mortem.h adds.
  std::vector<std::string> words;
  std::vector<StabilityViolation> suspects;
  std::string recording;      // of the last steps
  std::string row;            // of the ledger: it grew most in them
  double row_growth = 0;      // [J]
  std::string fastest_joint;  // in the last good state: mostly the one that ran away
};

struct SimulateResult {
  long steps = 0;
  double end = 0;  // [s]; where the run stopped by itself: the last good time
  std::vector<EnergyRow> ledger;
  std::vector<MomentumRow> momentum;
  std::vector<EnergyRow> hand;  // of the kinematic sides of couplings; outside the sum
  std::vector<std::string> warnings;
  int contacts = 0;  // points that press, at the last step
  std::optional<PostMortem> post_mortem;
  std::optional<Alarm> alarm;
  std::string alarm_words;  // by whoever watched
  std::string checkpoint;   // where a run stopped: the memory of some 1,000 to 2,000 steps before
};

struct RunWatch {
  std::function<void(const std::string&)> warn;  // of the start, before the run; also in the result
  std::function<void(double t, const State<double>&)> sample;  // times of the plan, in their order
  std::function<void(RunView&)> look;                          // at the start and after each step
  std::function<std::string(const Alarm&)> alarm;              // says it; once at most
  std::function<void(double t)> tick;                          // after each step; may throw
  // Asked within long steps; true ends the step, and tick() follows, which is to throw.
  bool (*interrupted)() = nullptr;
};

// Of RunView::memory() the part that Simulation::serialize reads.
StateArchive simulation_memory(const std::string& memory);

// Samples between two points of the grid are reached by a side step from the earlier one; the run
// is the same, whatever is sampled.
// `start`: goes on from there, with the same bits. Throws InputError where it is of another scene.
SimulateResult run_plan(const SimulateInput& input, const RunPlan& plan, const RunWatch& watch,
                        const RunStart* start = nullptr);

// The numbers of a run at one time: what `simulate` prints, a recording keeps in each frame, and
// pages plot. A new one is a column here.
struct RunColumn {
  std::string name, unit;  // "q/arm1" [rad], "links/hand/x" [m], "kinetic_energy" [J]
  std::string kind, of;    // "coordinate" of "arm1"; as in app/web/src/protocol/run.ts

  std::string with_unit() const { return name + "[" + unit + "]"; }
};

// Coordinates, velocities, positions of the links' origins; kinetic and potential energy last.
std::vector<RunColumn> run_columns(const RobotInput& input);
// In their order; k belongs to x.
std::vector<double> run_values(const RobotInput& input, const State<double>& x,
                               const Kinematics& k);

// How a run ends that stops by itself.
double weight_of(const Model<double>& model);  // [N]
// RunPlan::energy_bound where none is given [J].
double default_energy_bound(const Model<double>& model, const State<double>& start);

// After a bad step from t, `last` the last good state: what is bad first, and which joint is
// fastest.
PostMortem examine_end(const StepReport& report, const Simulation& simulation,
                       const State<double>& last, double t, long step);

// What a run warns of besides its result; each is empty where there is nothing to warn of.

// Floating-base robots under semi-implicit Euler, whose steps in joint coordinates do not conserve
// the momentum of a tree with joints: the drift is of first order in the step. Not with events
// located in time, nor with contacts or limits under gravity, which set the momentum themselves.
std::string drift_warning(const Simulation& simulation, const RunPlan& plan);

// Bodies that penetrate one another deeply at the start.
std::string deep_start_warning(const SceneContacts& contacts, ContactMode mode);

// Steps whose equation was not solved, and steps in which not all events were located.
std::string unsolved_warning(long unsolved, long steps);
std::string unlocated_warning(long unlocated, long steps);

// The times of a run of fixed steps.

// Two times within this part of a step are the same one.
inline constexpr double kSameTime = 1e-9;

// t = n step, the last one `duration`, which may be infinite; both [s].
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
  // Whether a run that stands at t after n steps stands on the grid.
  bool holds(long n, double t) const { return std::abs(t - time(n)) <= kSameTime * step_; }
  // Of the step from t, which need not lie on the grid: the last one is shorter where the duration
  // is no multiple of the step.
  double length(double t) const {
    const double rest = duration_ - t;
    return rest < step_ * (1 - kSameTime) ? rest : step_;
  }

 private:
  double step_, duration_;
  long steps_ = std::numeric_limits<long>::max();
};

}  // namespace twinarm
