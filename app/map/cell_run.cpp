#include "app/map/cell_run.h"

#include "app/support/interrupt.h"

namespace twinarm {

CellValues run_cell(const MapJob& job, const SimulatePlan& plan) {
  CellMeasure measure(plan, measured_joints(*plan.input.scene, job.measured_coupling));
  RunWatch watch;
  watch.sample = [](double, const State<double>&) {};
  watch.interrupted = is_interrupted;
  watch.tick = [](double) { check_interrupt(); };
  watch.look = [&](RunView& run) { measure.look(run); };
  return measure.values(run_plan(plan.input, plan.run, watch));
}

}  // namespace twinarm
