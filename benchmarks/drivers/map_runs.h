// The runs that a map of stability consists of, as bench_map times them: the S-103 with its gripper
// locked follows its twin through the paper's motion, held by three springs whose gains differ from
// cell to cell.
#pragma once

#include <array>
#include <vector>

#include "coupling/batch/batch_run.h"
#include "coupling/target/operator_motion.h"

namespace twinarm::bench {

// assets/robots/s103, without its meshes; the gripper at the top of its way, one body with the
// quill.
Model<double> locked_s103();

struct MapLaw {
  const char* name;
  CouplingSpec::Type type;
  SpringSpace measure;
  double k, b;
  double quill;  // its part of them: it is a thousand times as light, and would be unstable
};
inline constexpr std::array<MapLaw, 3> kMapLaws{
    {{"world", CouplingSpec::Type::torsional, SpringSpace::world, 300, 8, 1e-3},
     {"joint", CouplingSpec::Type::torsional, SpringSpace::joint, 300, 8, 1e-3},
     {"linear", CouplingSpec::Type::linear, SpringSpace::world, 3000, 60, 0.1}}};

// A map of k against b about the law's gains, all cells of it stable.
class MapRuns {
 public:
  MapRuns(const MapLaw& law, Discretization treatment, bool energy, std::size_t cells,
          std::size_t threads, double duration);
  MapRuns(const MapRuns&) = delete;

  void run();        // side by side; the twin's motion is tabulated by the first call alone
  void run_fresh();  // all that a map does: with the tables
  void run_alone();  // one by one, each with a twin of its own; errors, and no energies
  std::size_t steps() const { return steps_; }  // of the last call, all cells
  // Processor time of the thread that had most of it [s]: the wall clock of a machine with nothing
  // else to do.
  double busiest() const;
  std::size_t lanes() const { return runs_.front().lanes(); }

 private:
  // part(thread, first cell, number of cells), shared out to the threads.
  template <class Part>
  void share_out(const Part& part);
  std::size_t run_one(const BatchCell& cell) const;

  Model<double> model_ = locked_s103();
  HandMapping mapping_;
  AutomaticMotion hand_{mapping_};
  BatchSetup setup_;
  std::vector<BatchCell> cells_;
  std::vector<BatchResult> results_;
  std::vector<BatchRun> runs_;  // by thread
  std::size_t steps_ = 0;
  std::vector<double> seconds_;  // by thread
};

}  // namespace twinarm::bench
