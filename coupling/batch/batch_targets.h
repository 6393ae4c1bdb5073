// The KVR's motion over a run as a table, one row for each step: what all lanes of a batch read.
#pragma once

#include <cstddef>
#include <vector>

#include "coupling/batch/batch_model.h"
#include "coupling/batch/batch_run.h"

namespace twinarm {

// Rows as LaneSpring in batch_state.h describes them, and the measured joints' coordinates.
struct BatchMotion {
  struct Place {
    std::size_t motion, energy;  // where a spring's numbers begin in a row
  };
  std::vector<Place> places;  // by spring
  std::size_t motion_stride = 0, energy_stride = 0, joints = 0;
  std::size_t steps = 0;          // the last one may be shorter
  double last_step = 0;           // [s]
  std::vector<double> motion;     // steps rows
  std::vector<double> energy;     // steps + 1 rows; none where nobody wants energies
  std::vector<char> is_corner;    // by row of `energy`: BatchWork
  std::vector<double> q_K;        // steps + 1 rows
  std::vector<double> low, high;  // of q_K, by joint

  explicit BatchMotion(const BatchSetup& setup);
  // Of a cell's step, motion and levers. Looks at the hands as Simulation's couplings do.
  void fill(const BatchSetup& setup, const ModelWithoutFixedJoints& lumped, const BatchCell& cell);

 private:
  struct Reader;  // of a spring's numbers
  void fill_step(std::size_t n, const BatchSetup& setup, const std::vector<Reader>& readers,
                 const std::vector<TargetRobot>& kvrs);
  void find_corners(const BatchSetup& setup, double h);
  void find_range();
};

}  // namespace twinarm
