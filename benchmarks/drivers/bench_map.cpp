// Steps per second of many coupled runs, as in parameter maps, with coupling, integration and
// measures, by cells, threads and lanes; scripts/measure/map_throughput draws them.
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/engines/engine.h"
#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "coupling/batch/batch_model.h"
#include "coupling/batch/batch_run.h"
#include "coupling/target/operator_motion.h"
#include "solver/dynamics/dynamics.h"

namespace twinarm::bench {
namespace {

using Json = nlohmann::ordered_json;

// assets/robots/s103 with the gripper at its upper limit, one body with the quill.
Model<double> locked_s103() {
  RobotFileOptions options;
  options.geometry = RobotFileOptions::Geometry::optional;
  RobotDescription robot = read_urdf(TWINARM_SOURCE_DIR "/assets/robots/s103/s103.urdf", options);
  JointDescription& lift = robot.joints.back();  // of the gripper
  lift.origin.xyz += lift.upper * lift.axis;
  lift.type = JointDescription::Type::fixed;
  return ModelWithoutFixedJoints(build_model(robot)).model;
}

// A map of k against b: the S-103 tracks its target robot through the paper's motion, by three
// linear springs with implicit dampers whose gains differ from cell to cell; all cells are stable.
class MapRuns {
 public:
  MapRuns(std::size_t cells, std::size_t threads, double duration)
      : results_(cells), seconds_(threads) {
    setup_.model = &model_;
    setup_.start = State<double>(model_);
    BatchTarget target{&hand_, {{"joint1", "joint2", "joint3"}, "", 0, 0}, setup_.start};
    const TargetRobot kvr(model_, hand_, mapping_, target.joints);
    setup_.start.q = kvr.start().x.q;
    setup_.targets = {target};
    for (const int body : {1, 2, 3})
      setup_.springs.push_back({SpringKind::linear, Discretization::semi_implicit, false, 0, body});
    setup_.duration = duration;
    setup_.measured = {0, 1, 2};
    for (std::size_t c = 0; c < cells; ++c) {
      const double share = static_cast<double>(c) / static_cast<double>(cells);
      const double k = 3000 * (0.5 + share), b = 60 * (1 - 0.5 * share);
      BatchCell cell;
      cell.springs = {
          {k, b, {0.2, 0, 0.3}},
          {k, b, {0.3, 0, 0.1}},
          {0.1 * k, 0.1 * b, {0.05, 0, -0.3}}};  // of the quill, which has little inertia
      cells_.push_back(cell);
    }
  }
  MapRuns(const MapRuns&) = delete;

  // Batched, with the table of the target's motion in each thread, as in a map.
  void run() {
    share_out([&](std::size_t first, std::size_t n) {
      BatchRun(setup_).run({cells_.data() + first, n}, {results_.data() + first, n});
    });
  }
  // One cell at a time, each with its own target robot; errors but no energies.
  void run_alone() {
    share_out([&](std::size_t first, std::size_t n) {
      for (std::size_t c = first; c < first + n; ++c) results_[c].steps = run_one(cells_[c]);
    });
  }
  std::size_t steps() const {  // of the last call, all cells
    std::size_t steps = 0;
    for (const BatchResult& result : results_) steps += result.steps;
    return steps;
  }
  // Largest CPU time of a thread [s]: the wall time of an idle machine.
  double busiest() const { return std::ranges::max(seconds_); }
  std::size_t lanes() const { return BatchRun(setup_).lanes(); }

 private:
  // Calls part(first cell, number of cells) in all threads.
  template <class Part>
  void share_out(const Part& part) {
    const std::size_t threads = seconds_.size(), share = (cells_.size() + threads - 1) / threads;
    const auto of_thread = [&](std::size_t t) {
      const double began = thread_seconds();
      const std::size_t first = std::min(t * share, cells_.size());
      part(first, std::min(share, cells_.size() - first));
      seconds_[t] = thread_seconds() - began;
    };
    std::vector<std::thread> workers;
    for (std::size_t t = 1; t < threads; ++t) workers.emplace_back(of_thread, t);
    of_thread(0);
    for (std::thread& worker : workers) worker.join();
  }
  std::size_t run_one(const BatchCell& cell) const {
    const BatchTarget& target = setup_.targets.front();
    TargetRobot kvr(model_, hand_, mapping_, target.joints);
    kvr.set_pose(target.rest);
    std::vector<std::unique_ptr<Coupling>> couplings;
    Simulation simulation(model_, setup_.start);
    for (std::size_t s = 0; s < setup_.springs.size(); ++s) {
      const BatchCell::Gains& gains = cell.springs[s];
      CouplingSpec spec;
      spec.type = CouplingSpec::Type::linear;
      spec.discretization = setup_.springs[s].discretization;
      spec.springs = {{"spring", setup_.springs[s].body, gains.p_L, gains.k, gains.b}};
      couplings.push_back(make_coupling(spec, model_, kvr));
      simulation.add(*couplings.back());
    }
    Eigen::Array3d largest = Eigen::Array3d::Zero(), sum = largest;
    std::size_t steps = 0;
    for (; simulation.state().t < setup_.duration - 0.5 * cell.h; ++steps) {
      simulation.step(cell.h);
      const Eigen::Map<const Eigen::Array3d> q_K(kvr.end().x.q.data());
      const Eigen::Array3d e = (q_K - Eigen::Array3d::Map(simulation.state().q.data())).abs();
      largest = largest.max(e);
      sum += e;
    }
    // Uses the errors, so that the compiler cannot remove them.
    return (largest + sum).isFinite().all() ? steps : 0;
  }

  Model<double> model_ = locked_s103();
  OperatorMapping mapping_;
  AutomaticMotion hand_{mapping_};
  BatchSetup setup_;
  std::vector<BatchCell> cells_;
  std::vector<BatchResult> results_;
  std::vector<double> seconds_;  // by thread, of the last call
};

struct Quickest {
  double wall = std::numeric_limits<double>::infinity(), busiest = wall;  // [s]
};

// Minimum of several calls.
Quickest quickest(MapRuns& map, bool alone, bool quick) {
  using Clock = std::chrono::steady_clock;
  Quickest best;
  double all = 0;
  for (int n = 0; n < (quick ? 1 : 3) || (n < 50 && all < (quick ? 0 : 0.15)); ++n) {
    const auto start = Clock::now();
    if (alone)
      map.run_alone();
    else
      map.run();
    const double took = std::chrono::duration<double>(Clock::now() - start).count();
    best.wall = std::min(best.wall, took);
    best.busiest = std::min(best.busiest, map.busiest());
    all += took;
    if (all > 2) break;
  }
  return best;
}

Json measure_throughput(bool quick) {
  Json rows = Json::array();
  const double duration = quick ? 0.3 : 3;
  const std::size_t max_cells = quick ? 16 : 1024, max_alone = quick ? 4 : 16;
  for (const bool alone : {true, false})
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}})
      for (std::size_t cells = 1; cells <= (alone ? max_alone : max_cells); cells *= 2) {
        MapRuns map(cells, threads, duration);
        const Quickest best = quickest(map, alone, quick);
        const auto steps = static_cast<double>(map.steps());
        rows.push_back({{"lanes", alone ? 1 : map.lanes()},
                        {"threads", threads},
                        {"cells", cells},
                        {"steps_per_second", steps / best.wall},
                        {"steps_per_cpu_second", steps / best.busiest}});
      }
  return rows;
}

int measure(bool quick) {
  const Json all = {{"isa", name_of(best_isa())}, {"throughput", measure_throughput(quick)}};
  std::cout << all.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace twinarm::bench

int main(int argc, char** argv) {
  CLI::App program("Steps of parameter maps per second; prints JSON.", "bench_map");
  bool quick = false;
  program.add_flag("--quick", quick, "short runs of few cells");
  return twinarm::bench::run_program(program, argc, argv,
                                     [&] { return twinarm::bench::measure(quick); });
}
