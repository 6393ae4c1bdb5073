// Runs of a parameter map, as timed by bench_map: the S-103 with locked gripper tracks its target
// robot through the paper's motion, by three springs whose gains differ from cell to cell.
#pragma once

#include <array>
#include <vector>

#include "coupling/batch/batch_run.h"
#include "coupling/target/operator_motion.h"

namespace twinarm::bench {

// assets/robots/s103 without meshes; the gripper at its upper limit, one body with the quill.
Model<double> locked_s103();

struct MapLaw {
  const char* name;
  CouplingSpec::Type type;
  SpringSpace measure;
  double k, b;
  double quill;  // factor of the gains of the quill, whose inertia is a thousand times smaller
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

  void run();        // batched; only the first call tabulates the motion of the target
  void run_fresh();  // batched, with the tables, as in a map
  void run_alone();  // one cell at a time, each with its own target robot; errors but no energies
  std::size_t steps() const { return steps_; }  // of the last call, all cells
  // Largest CPU time of a thread [s]: the wall time of an idle machine.
  double busiest() const;
  std::size_t lanes() const { return runs_.front().lanes(); }

 private:
  // Calls part(thread, first cell, number of cells) in all threads.
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
