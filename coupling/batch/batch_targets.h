// Table of the KVR's motion, one row per step, shared by all lanes of a batch.
#pragma once

#include <cstddef>
#include <vector>

#include "coupling/batch/batch_model.h"
#include "coupling/batch/batch_run.h"

namespace twinarm {

// Row format: LaneSpring in batch_state.h.
struct BatchMotion : BatchTables {
  struct Frame {
    std::size_t motion, energy;  // offsets of a spring in the rows
  };
  std::vector<Frame> places;  // by spring
  std::size_t joints = 0;
  double last_step = 0;           // [s]
  std::vector<double> low, high;  // of q_K, by joint

  explicit BatchMotion(const BatchSetup& setup);
  // Table for the step, motion and lever arms of a cell.
  void fill(const BatchSetup& setup, const ModelWithoutFixedJoints& merged, const BatchCell& cell);

 private:
  struct Reader;  // of a spring's numbers
  void fill_step(std::size_t n, const BatchSetup& setup, const std::vector<Reader>& readers,
                 const std::vector<TargetRobot>& kvrs);
  void find_velocity_jumps(const BatchSetup& setup, double h);
  void find_range();
};

}  // namespace twinarm
