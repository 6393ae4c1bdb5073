// The C++ side of scripts/measure/bench_python: times calls of the passes.
//
//   bench_python ROBOT.urdf
//
// stdin: the number of states, then q, qd and a third vector of nv numbers for each; then lines
// "ALGORITHM CALLS", each answered by the CPU time of a call [ns].
#include <map>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/engines/engine.h"
#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "solver/dynamics/dynamics.h"

namespace twinarm::bench {
namespace {

std::vector<double> numbers(std::size_t count) {
  std::vector<double> all(count);
  for (double& number : all) std::cin >> number;
  return all;
}

int answer(const std::filesystem::path& file) {
  RobotFileOptions options;
  options.geometry = RobotFileOptions::Geometry::optional;
  const Model<double> model = build_model(read_urdf(file, options));
  std::size_t count = 0;
  std::cin >> count;
  std::vector<State<double>> x(count, State<double>(model));
  std::vector<Forces<double>> forces(count, Forces<double>(model));
  for (std::size_t i = 0; i < count; ++i) {
    x[i].q = numbers(model.nq);
    x[i].qd = numbers(model.nv);
    forces[i].tau = numbers(model.nv);
  }
  Workspace<double> w(model);
  std::vector<double> M(model.nv * model.nv);
  const std::map<std::string, std::function<void(std::size_t)>> algorithms{
      {"aba", [&](std::size_t i) { aba(model, x[i], forces[i], w); }},
      {"rnea", [&](std::size_t i) { rnea(model, x[i], forces[i].tau, forces[i].f_ext, w); }},
      {"crba", [&](std::size_t i) { crba(model, x[i], w, M); }}};
  std::string name;
  for (std::size_t calls = 0; std::cin >> name >> calls;) {
    const auto& call = algorithms.at(name);
    const double start = thread_seconds();
    for (std::size_t i = 0; i < calls; ++i) call(i % count);
    std::cout << 1e9 * (thread_seconds() - start) / static_cast<double>(calls) << std::endl;
  }
  return 0;
}

}  // namespace
}  // namespace twinarm::bench

int main(int argc, char** argv) {
  CLI::App program("The C++ side of scripts/measure/bench_python.", "bench_python");
  std::filesystem::path robot;
  program.add_option("robot", robot, "URDF")->required();
  return twinarm::bench::run_program(program, argc, argv,
                                     [&] { return twinarm::bench::answer(robot); });
}
