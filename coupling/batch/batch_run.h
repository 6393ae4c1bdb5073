// Batched runs of one coupled robot, one cell of a parameter map per SIMD lane, each with its own
// gains, step and motion.
//
// Equivalent to Simulation with linear and torsional couplings (coupling/laws/spring_damper.h) and
// semi-implicit Euler; results differ by rounding. Cells of equal step, motion and lever arms share
// a table of the KVR's motion and form batches: pass many of them in one call. The lane of a
// diverged cell stops; a batch ends when all its lanes have.
//
// SI units. Cost of a step of the S-103: benchmarks/drivers/bench_map.cpp.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "coupling/analysis/tracking.h"
#include "coupling/batch/kernel/batch_state.h"
#include "coupling/laws/coupling.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// A target robot, at `rest` except for the driven joints.
struct BatchTarget {
  const OperatorMotion* motion = nullptr;
  DrivenJoints joints;
  State<double> rest;
};

struct BatchSpring {
  SpringKind kind = SpringKind::world;
  Discretization discretization = Discretization::explicit_;
  bool absolute_damper = false;
  std::size_t target = 0;  // index in BatchSetup::targets
  int body = 0;
};

struct BatchSetup {
  const Model<double>* model = nullptr;  // model and motions must outlive the run
  State<double> start;
  std::vector<BatchTarget> targets;
  std::vector<BatchSpring> springs;
  std::vector<std::size_t> measured;  // coordinates with tracking errors to the first target
  double duration = 0;                // [s]; the last step may be shorter
};

// One run. Vectors by spring and by body of the model.
struct BatchCell {
  struct Gains {
    double k = 0, b = 0;
    Vector3 p_L = Vector3::Zero();  // link axes; linear springs only
  };
  double h = 1e-3;              // [s]
  double speed = 1, delay = 0;  // of all motions: DelayedMotion
  std::vector<Gains> springs;
};

struct BatchResult {
  std::size_t steps = 0;  // steps taken
  bool finished = false;  // false: diverged
  // By measured joint, as tracking_error(); infinite if diverged.
  std::vector<double> max_error, mean_error;
  // By measured joint, of a finished cell: range of the first target.
  std::vector<double> target_lower, target_upper;
  // Residual of the energy balance [J]: change of kinetic, potential and spring energy minus the
  // work of operator, dampers and joint damping (trapezoidal rule); the sum of the rows `numerical`
  // and `coupling/*/implicit` of `twinarm simulate`.
  double energy_created = 0;
  // Minimum over time of the operator's accumulated work on springs and dampers [J], <= 0
  // (passivity observer).
  double input_work_min = 0;
};

// Errors: joints other than revolute, prismatic, screw and fixed, mimic joints, Coulomb friction,
// springs on immovable links. Empty if the batch can run.
std::vector<Diagnostic> batch_faults(const BatchSetup& setup);

class BatchRun {
 public:
  // Throws InputError with batch_faults().
  explicit BatchRun(const BatchSetup& setup);
  // Runs all cells; out has the same size. One instance per thread. Allocates between batches, not
  // in a step. Throws InputError before the first run if a step size is invalid or too small.
  void run(std::span<const BatchCell> cells, std::span<BatchResult> out);
  std::size_t lanes() const { return driver_->lanes(); }  // SIMD width of the instruction set

  // For one number of lanes.
  class Driver {
   public:
    virtual ~Driver() = default;
    virtual void run(std::span<const BatchCell> cells, std::span<BatchResult> out) = 0;
    virtual std::size_t lanes() const = 0;
  };

 private:
  std::unique_ptr<Driver> driver_;
};

}  // namespace twinarm
