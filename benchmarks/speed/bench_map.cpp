// Steps of many coupled runs side by side, as maps of stability take them: the S-103 with its
// gripper locked, coupling, integration and measures included. Beside each stands the batch's aba()
// alone, in the same rounds: their ratio is what the machine's mood does not change. Prints a
// table.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "benchmarks/speed/timing.h"
#include "coupling/automatic_motion.h"
#include "coupling/batch_lump.h"
#include "coupling/batch_run.h"
#include "solver/convert.h"
#include "solver/dynamics.h"
#include "solver/model_builder.h"

namespace twinarm::speed {
namespace {

// assets/robots/s103, without its meshes; the gripper at the top of its way, one body with the
// quill.
Model<double> locked_s103() {
  const auto inertia = [](double m, double x, double z, double xx, double xz, double yy,
                          double zz) {
    BodyInertia body{m, {x, 0, z}, Matrix3::Zero()};
    body.inertia << xx, 0, xz, 0, yy, 0, xz, 0, zz;
    return body;
  };
  ModelBuilder builder;
  const auto hinge = [&](const char* name, const char* joint, int parent, double x, double z,
                         const BodyInertia& body) {
    return builder.add_body(name, parent, joint, JointType::revolute,
                            {Matrix3::Identity(), {x, 0, z}}, Vector3::UnitZ(), body);
  };
  const int arm1 =
      hinge("arm1", "joint1", 0, 0, 0.25,
            inertia(5.011098, 0.0702135, 0.2152552, 0.0751362, -0.0242963, 0.1473617, 0.0832843));
  const int arm2 =
      hinge("arm2", "joint2", arm1, 0.25, 0.365,
            inertia(2.981285, 0.1612192, 0.0704552, 0.0196957, 0.0038870, 0.0668750, 0.0523253));
  const int quill = hinge("quill", "joint3", arm2, 0.35, 0.31625,
                          inertia(0.45, 0.0000325, -0.2742602, 0.0113, 0, 0.0113, 0.00006));
  builder.add_body("gripper", quill, "gripper_lift", JointType::fixed, {}, Vector3::UnitZ(),
                   inertia(0.14, 0, -0.5337274, 0.0002, 0, 0.0002, 0.0001));
  return builder.build();
}

struct Law {
  const char* name;
  CouplingSpec::Type type;
  Measure measure;
  double k, b;
  double quill;  // its part of them: it is a thousand times as light, and would be unstable
};
constexpr std::array<Law, 3> kLaws{
    {{"world", CouplingSpec::Type::torsional, Measure::world, 300, 8, 1e-3},
     {"joint", CouplingSpec::Type::torsional, Measure::joint, 300, 8, 1e-3},
     {"linear", CouplingSpec::Type::linear, Measure::world, 3000, 60, 0.1}}};
constexpr std::array kTreatments{Treatment::explicit_, Treatment::semi_implicit,
                                 Treatment::implicit};
constexpr std::array kTreatmentNames{"explicit", "semi-implicit", "implicit"};

// A map of k against b about the law's gains, all of them stable.
struct Map {
  Model<double> model = locked_s103();
  HandMapping mapping;
  AutomaticMotion hand{mapping};
  BatchSetup setup;
  std::vector<BatchCell> cells;
  std::vector<BatchResult> results;
  std::vector<BatchRun> runs;  // by thread

  Map(const Law& law, Treatment treatment, bool energy, std::size_t count, std::size_t threads,
      double duration) {
    setup.model = &model;
    setup.start = State<double>(model);
    BatchTarget target{&hand, mapping, {{"joint1", "joint2", "joint3"}, "", 0, 0}, setup.start};
    const KinematicRobot kvr(model, hand, mapping, target.joints);
    setup.start.q = kvr.start().x.q;
    setup.targets = {target};
    for (const int body : {1, 2, 3})
      setup.springs.push_back({law.type, law.measure, treatment, false, 0, body});
    setup.duration = duration;
    setup.energy = energy;
    setup.measured = {0, 1, 2};
    for (std::size_t c = 0; c < count; ++c) {
      const double share = static_cast<double>(c) / static_cast<double>(count);
      const double k = law.k * (0.5 + share), b = law.b * (1 - 0.5 * share);
      BatchCell cell;
      cell.springs = {{k, b, {0.2, 0, 0.3}},
                      {k, b, {0.3, 0, 0.1}},
                      {k * law.quill, b * law.quill, {0.05, 0, -0.3}}};
      cells.push_back(cell);
    }
    results.resize(count);
    for (std::size_t t = 0; t < threads; ++t) runs.emplace_back(setup);
  }
  Map(const Map&) = delete;
  void run() {
    const std::size_t threads = runs.size(), share = (cells.size() + threads - 1) / threads;
    const auto part = [&](std::size_t t) {
      const std::size_t first = std::min(t * share, cells.size());
      const std::size_t n = std::min(share, cells.size() - first);
      runs[t].run({&cells[first], n}, {&results[first], n});
    };
    if (threads == 1) return part(0);
    std::vector<std::thread> workers;
    for (std::size_t t = 0; t < threads; ++t) workers.emplace_back(part, t);
    for (std::thread& worker : workers) worker.join();
  }
  double steps() const {
    double sum = 0;
    for (const BatchResult& result : results) sum += static_cast<double>(result.steps);
    return sum;
  }
};

// The batch's forward dynamics alone, at as many lanes as the map has: one call for each state.
template <int N>
class PassesAlone {
 public:
  explicit PassesAlone(const Model<double>& lumped)
      : model_(convert<Batch<N>>(lumped)), w_(model_), forces_(model_) {
    for (int k = 0; k < kCalls; ++k) {
      State<Batch<N>> x(model_);
      for (std::size_t d = 0; d < x.q.size(); ++d)
        for (int lane = 0; lane < N; ++lane) {
          x.q[d].set(lane, std::sin(1.0 + k + 0.7 * static_cast<double>(d) + 0.3 * lane));
          x.qd[d].set(lane, std::cos(2.0 + k + 0.7 * static_cast<double>(d) + 0.3 * lane));
        }
      states_.push_back(x);
    }
  }
  static constexpr int kCalls = 8, kStates = kCalls * N;
  void run() {
    for (const State<Batch<N>>& x : states_) passes<Batch<N>>().aba(model_, x, forces_, w_);
  }

 private:
  Model<Batch<N>> model_;
  Workspace<Batch<N>> w_;
  Forces<Batch<N>> forces_;
  std::vector<State<Batch<N>>> states_;
};

// All laws and treatments, in turn with the passes alone.
template <int N>
void compare_with_passes(int repetitions, double seconds) {
  PassesAlone<N> alone(LumpedModel(locked_s103()).model);
  std::printf("ns per step of a cell, one core, %d lanes; beside it the batch's aba() alone\n", N);
  for (const bool energy : {false, true})
    for (const Law& law : kLaws)
      for (std::size_t t = 0; t < kTreatments.size(); ++t) {
        Map map(law, kTreatments[t], energy, 4 * N, 1, 1.0);
        const std::vector<Timing> times =
            time_interleaved({[&] { map.run(); }, [&] { alone.run(); }}, repetitions, seconds);
        const double step = times[0].ns / map.steps(), aba = times[1].ns / alone.kStates;
        std::printf("%-7s %-14s %-12s %7.1f %7.1f  ratio %.2f\n", law.name, kTreatmentNames[t],
                    energy ? "with energies" : "", step, aba, step / aba);
      }
}

// Wall clock: cells, threads.
void throughput(double duration) {
  std::printf("million steps per second by the wall clock, linear semi-implicit\n");
  for (const bool energy : {false, true})
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}})
      for (const std::size_t cells : {std::size_t{16}, std::size_t{128}, std::size_t{1024}}) {
        Map map(kLaws[2], Treatment::semi_implicit, energy, cells, threads, duration);
        double best = 1e300;
        for (int repetition = 0; repetition < 3; ++repetition) {
          const auto start = std::chrono::steady_clock::now();
          map.run();
          best = std::min(
              best,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
        std::printf("%zu threads, %4zu cells%s: %6.1f\n", threads, cells,
                    energy ? ", with energies" : "", map.steps() / best / 1e6);
      }
}

}  // namespace
}  // namespace twinarm::speed

int main(int argc, char** argv) {
  const std::string_view option = argc > 1 ? argv[1] : "";
  if (argc > 2 || (option != "" && option != "--quick")) {
    std::fputs("bench_map [--quick]\n", stderr);
    return 2;
  }
  const bool quick = option == "--quick";
  const int repetitions = quick ? 3 : 9;
  const double seconds = quick ? 0.01 : 0.05;
  using namespace twinarm;
  switch (best_isa()) {
    case Isa::v4:
      speed::compare_with_passes<8>(repetitions, seconds);
      break;
    case Isa::v3:
    case Isa::generic:
      speed::compare_with_passes<4>(repetitions, seconds);
  }
  speed::throughput(quick ? 0.3 : 3);
}
