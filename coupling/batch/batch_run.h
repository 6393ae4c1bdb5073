// Many runs of one coupled robot at once: a cell of a map is a run of its own, with gains, masses,
// a step and a motion of its own, and a register of the processor holds as many of them as it has
// doubles.
//
// A run is that of Simulation with linear and torsional couplings (coupling/laws/spring_damper.h)
// and the semi-implicit integrator: same forces, same order in time, same sampling of the hand;
// results differ by rounding. Cells of equal step, motion and levers share the table of the KVR's
// motion and fill the lanes of a batch together: give many of those in one call. A lane whose cell
// has left all bounds stands still; a batch ends when all its lanes do.
//
// Units are SI and radians; of a prismatic joint the error is in metres. Cost of a step of the
// S-103: benchmarks/drivers/bench_map.cpp.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "coupling/analysis/tracking.h"
#include "coupling/laws/coupling.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// What pulls: a KVR, which stands at `rest` but for the joints that the hand turns.
struct BatchTarget {
  const OperatorMotion* hand = nullptr;
  HandMapping mapping;
  DrivenJoints joints;
  State<double> rest;
};

struct BatchSpring {
  CouplingSpec::Type type = CouplingSpec::Type::torsional;  // torsional or linear
  SpringSpace measure = SpringSpace::world;                 // of a torsional one
  Discretization treatment = Discretization::explicit_;
  bool absolute_damper = false;  // does not see the target's velocity
  std::size_t target = 0;        // index in BatchSetup::targets
  int body = 0;                  // whose k, b and lever each cell gives
};

struct BatchSetup {
  const Model<double>* model = nullptr;  // must outlive the run; so must the hands
  State<double> start;
  std::vector<BatchTarget> targets;
  std::vector<BatchSpring> springs;
  std::vector<std::size_t> measured;  // coordinates whose error against the first target is wanted
  double duration = 0;                // [s]; where it is no multiple of h the last step is shorter
  double bound = 1e3;   // a cell stops where |q_K - q_D|, summed over them, is not below this
  bool energy = false;  // compute energy_created and hand_work_least too
};

// One run. Vectors by spring and by body of the model.
struct BatchCell {
  struct Gains {
    double k = 0, b = 0;
    Vector3 p_L = Vector3::Zero();  // link axes; linear springs only
  };
  double h = 1e-3;              // [s]
  double speed = 1, delay = 0;  // of all hands: coupling/target/operator_motion.h
  std::vector<Gains> springs;
  std::vector<double> mass_factor;  // on mass, first moment and inertia; empty: 1 for all
};

struct BatchResult {
  static constexpr std::size_t kWindows = 4;
  std::size_t steps = 0;  // taken; less than the whole run's where the cell has stopped
  bool finished = false;  // false: it left all bounds
  // By measured joint, over t = 0, h, 2h ...; maximum and time average (trapezoidal) as
  // tracking_error(). All infinite in a cell that has stopped, as are the quarters from then on.
  std::vector<double> max_error, mean_error;
  // By measured joint, of a cell that has finished: where the first target was at those moments.
  std::vector<double> twin_low, twin_high;
  // The largest error of any measured joint within each quarter of the run: whether it grows.
  std::array<double, kWindows> window_error{};
  // KE + PE + springs' energy at the end less the start, less the work of hand and dampers (of
  // joints too) by the trapezoidal rule: what came from nowhere. It is the sum of the rows
  // `numerical` and `coupling/*/implicit` of `twinarm simulate`.
  double energy_created = 0;
  // The least that the hand's work on springs and dampers, summed from the start, ever was; below
  // zero the hand was given energy (passivity observer). At most 0.
  double hand_work_least = 0;
};

// What a batch cannot run: other joints than revolute, prismatic, screw and fixed, mimics, Coulomb
// friction, springs on what cannot move. Empty: it can.
std::vector<Diagnostic> batch_faults(const BatchSetup& setup);

class BatchRun {
 public:
  // Throws InputError with batch_faults().
  explicit BatchRun(const BatchSetup& setup);
  ~BatchRun();
  BatchRun(BatchRun&&) noexcept;
  BatchRun& operator=(BatchRun&&) noexcept;

  // Any number of cells, in any order; out is as long. Not for several threads at once: each has a
  // BatchRun of its own. Allocates between batches, never in a step. Throws InputError where the
  // step of a cell is not positive and finite; then none has run.
  void run(std::span<const BatchCell> cells, std::span<BatchResult> out);
  std::size_t lanes() const;  // runs at once, by the level of the instruction set

 private:
  class Driver;
  template <int N>
  class BatchRunnerN;
  std::unique_ptr<Driver> driver_;
};

}  // namespace twinarm
