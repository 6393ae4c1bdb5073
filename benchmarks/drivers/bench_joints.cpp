// Time per body by joint type: forward dynamics of chains of 16 bodies, every joint type in every
// scalar, ns per body (and per state, for batches). Prints a table.
#include <cstdio>
#include <utility>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/timing.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/model_builder.h"
#include "solver/model/convert_model.h"

namespace twinarm::bench {
namespace {

constexpr int kBodies = 16;

Model<double> chain_of(JointType type) {
  ModelBuilder builder;
  for (int i = 0; i < kBodies; ++i) {
    const std::string number = std::to_string(i);
    const double a = 0.3 * i;  // different for each body
    BodyInertia body{1 + 0.1 * i, {0.05, 0.01 * i, 0.02}, Matrix3::Zero()};
    body.inertia.diagonal() << 0.02, 0.03 + 0.001 * i, 0.04;
    Matrix3 R = Matrix3::Identity();
    R.topLeftCorner<2, 2>() << std::cos(a), -std::sin(a), std::sin(a), std::cos(a);
    builder.add_body("link" + number, i, "joint" + number, type, {R, {0.1, 0.02, 0.03}},
                     {std::cos(a), 0.3, std::sin(a)}, body, {.pitch = 0.01});
  }
  return builder.build();
}

// Forward dynamics in one scalar.
template <class S>
std::function<void()> forward_dynamics_of(const Model<double>& in_double) {
  const Model<S> model = convert<S>(in_double);
  State<S> x(model);
  Forces<S> forces(model);
  std::vector<S> shift;
  for (std::size_t k = 0; k < model.nv; ++k) {
    shift.push_back(S(0.1 * static_cast<double>(k % 7)));
    x.qd[k] = S(0.2), forces.tau[k] = S(0.5);
  }
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      joint.integrate(x.q.data() + model.iq[i], shift.data() + model.iv[i],
                      x.q.data() + model.iq[i]);
    });
  return [=, w = Workspace<S>(model)]() mutable { aba(model, x, forces, w); };
}

int run(int repetitions, double seconds) {
  constexpr std::pair<const char*, double> scalars[] = {
      {"double", 1}, {"batch4", 4}, {"batch8", 8}, {"dual8", 1}};  // name, states
  std::vector<std::function<void()>> jobs;
  for (const JointType type : all_joint_types) {
    const Model<double> model = chain_of(type);
    jobs.push_back(forward_dynamics_of<double>(model));
    jobs.push_back(forward_dynamics_of<Batch<4>>(model));
    jobs.push_back(forward_dynamics_of<Batch<8>>(model));
    jobs.push_back(forward_dynamics_of<Dual<8>>(model));
  }
  const std::vector<Timing> times = time_interleaved(jobs, repetitions, seconds);

  std::printf("aba(), ns per body and state, chains of %d bodies\n%-12s", kBodies, "joint");
  for (const auto& [name, states] : scalars) std::printf("%9s", name);
  std::printf("\n");
  std::size_t next = 0;
  for (const JointType type : all_joint_types) {
    std::printf("%-12s", name_of(type));
    for (const auto& [name, states] : scalars)
      std::printf("%9.1f", times[next++].ns / kBodies / states);
    std::printf("\n");
  }
  return 0;
}

}  // namespace
}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  CLI::App program("Time per body by joint type.", "bench_joints");
  bool quick = false;
  program.add_flag("--quick", quick, "one short repetition");
  return run_program(program, argc, argv, [&] { return quick ? run(1, 1e-4) : run(7, 0.01); });
}
