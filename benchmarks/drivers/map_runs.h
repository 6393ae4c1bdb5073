// Runs of a parameter map, as timed by bench_map: the S-103 with locked gripper tracks its target
// robot through the paper's motion, by three springs whose gains differ from cell to cell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include "benchmarks/engines/engine.h"
#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "coupling/batch/batch_model.h"
#include "coupling/batch/batch_run.h"
#include "coupling/target/operator_motion.h"

namespace twinarm::bench {

// assets/robots/s103 with the gripper at its upper limit, one body with the quill.
inline Model<double> locked_s103() {
  RobotFileOptions options;
  options.geometry = RobotFileOptions::Geometry::optional;
  RobotDescription robot = read_urdf(TWINARM_SOURCE_DIR "/assets/robots/s103/s103.urdf", options);
  JointDescription& lift = robot.joints.back();  // of the gripper
  lift.origin.xyz += lift.upper * lift.axis;
  lift.type = JointDescription::Type::fixed;
  return ModelWithoutFixedJoints(build_model(robot)).model;
}

struct MapLaw {
  const char* name;
  SpringKind kind;
  double k, b;
  double quill;  // factor of the gains of the quill, whose inertia is a thousand times smaller
};
inline constexpr std::array<MapLaw, 3> kMapLaws{{{"world", SpringKind::world, 300, 8, 1e-3},
                                                 {"joint", SpringKind::joint, 300, 8, 1e-3},
                                                 {"linear", SpringKind::linear, 3000, 60, 0.1}}};

// A map of k against b about the law's gains, all cells of it stable.
class MapRuns {
 public:
  MapRuns(const MapLaw& law, Discretization discretization, std::size_t cells, std::size_t threads,
          double duration)
      : results_(cells) {
    setup_.model = &model_;
    setup_.start = State<double>(model_);
    BatchTarget target{&hand_, {{"joint1", "joint2", "joint3"}, "", 0, 0}, setup_.start};
    const TargetRobot kvr(model_, hand_, mapping_, target.joints);
    setup_.start.q = kvr.start().x.q;
    setup_.targets = {target};
    for (const int body : {1, 2, 3})
      setup_.springs.push_back({law.kind, discretization, false, 0, body});
    setup_.duration = duration;
    setup_.measured = {0, 1, 2};
    for (std::size_t c = 0; c < cells; ++c) {
      const double share = static_cast<double>(c) / static_cast<double>(cells);
      const double k = law.k * (0.5 + share), b = law.b * (1 - 0.5 * share);
      BatchCell cell;
      cell.springs = {{k, b, {0.2, 0, 0.3}},
                      {k, b, {0.3, 0, 0.1}},
                      {k * law.quill, b * law.quill, {0.05, 0, -0.3}}};
      cells_.push_back(cell);
    }
    for (std::size_t t = 0; t < threads; ++t) runs_.emplace_back(setup_);
  }
  MapRuns(const MapRuns&) = delete;

  // Batched; only the first call tabulates the motion of the target.
  void run() {
    share_out([&](std::size_t t, std::size_t first, std::size_t n) {
      runs_[t].run({cells_.data() + first, n}, {results_.data() + first, n});
    });
  }
  // Batched, with the tables, as in a map.
  void run_fresh() {
    share_out([&](std::size_t, std::size_t first, std::size_t n) {
      BatchRun fresh(setup_);
      fresh.run({cells_.data() + first, n}, {results_.data() + first, n});
    });
  }
  // One cell at a time, each with its own target robot; errors but no energies.
  void run_alone() {
    share_out([&](std::size_t, std::size_t first, std::size_t n) {
      for (std::size_t c = first; c < first + n; ++c) results_[c].steps = run_one(cells_[c]);
    });
  }
  std::size_t steps() const { return steps_; }  // of the last call, all cells
  // Largest CPU time of a thread [s]: the wall time of an idle machine.
  double busiest() const { return *std::ranges::max_element(seconds_); }
  std::size_t lanes() const { return runs_.front().lanes(); }

 private:
  // Calls part(thread, first cell, number of cells) in all threads.
  template <class Part>
  void share_out(const Part& part) {
    const std::size_t threads = runs_.size(), share = (cells_.size() + threads - 1) / threads;
    const auto of_thread = [&](std::size_t t) {
      const double began = thread_seconds();
      const std::size_t first = std::min(t * share, cells_.size());
      part(t, first, std::min(share, cells_.size() - first));
      seconds_[t] = thread_seconds() - began;
    };
    seconds_.assign(threads, 0);
    std::vector<std::thread> workers;
    for (std::size_t t = 1; t < threads; ++t) workers.emplace_back(of_thread, t);
    of_thread(0);
    for (std::thread& worker : workers) worker.join();
    steps_ = 0;
    for (const BatchResult& result : results_) steps_ += result.steps;
  }
  std::size_t run_one(const BatchCell& cell) const {
    const BatchTarget& target = setup_.targets.front();
    TargetRobot kvr(model_, hand_, mapping_, target.joints);
    kvr.set_pose(target.rest);
    std::vector<std::unique_ptr<Coupling>> couplings;
    Simulation simulation(model_, setup_.start);
    for (std::size_t s = 0; s < setup_.springs.size(); ++s) {
      const BatchSpring& spring = setup_.springs[s];
      const BatchCell::Gains& gains = cell.springs[s];
      CouplingSpec spec;
      if (spring.kind == SpringKind::linear) spec.type = CouplingSpec::Type::linear;
      if (spring.kind == SpringKind::joint) spec.measure = SpringSpace::joint;
      spec.discretization = spring.discretization;
      spec.springs = {{"spring", spring.body, gains.p_L, gains.k, gains.b}};
      couplings.push_back(make_coupling(spec, model_, kvr));
      simulation.add(*couplings.back());
    }
    std::array<double, 3> largest{}, sum{};
    std::size_t steps = 0;
    for (; simulation.state().t < setup_.duration - 0.5 * cell.h; ++steps) {
      simulation.step(cell.h);
      for (std::size_t j = 0; j < 3; ++j) {
        const double e = std::abs(kvr.end().x.q[j] - simulation.state().q[j]);
        largest[j] = std::max(largest[j], e);
        sum[j] += e;
      }
    }
    // Uses the errors, so that the compiler cannot remove them.
    return std::isfinite(largest[0] + sum[0] + largest[1] + sum[1] + largest[2] + sum[2]) ? steps
                                                                                          : 0;
  }

  Model<double> model_ = locked_s103();
  OperatorMapping mapping_;
  AutomaticMotion hand_{mapping_};
  BatchSetup setup_;
  std::vector<BatchCell> cells_;
  std::vector<BatchResult> results_;
  std::vector<BatchRun> runs_;  // by thread
  std::size_t steps_ = 0;
  std::vector<double> seconds_;  // by thread
};

}  // namespace twinarm::bench
