#include <algorithm>
#include <cmath>

#include "benchmarks/analytic/loop_cases.h"
#include "benchmarks/analytic/loop_runs.h"
#include "solver/kinematics.h"
#include "solver/simulation.h"

namespace twinarm {
namespace {

TrajectoryCase as_motion(const LoopCase& c) {
  TrajectoryCase motion;
  motion.statement = "";
  motion.scene = [c] {
    CaseScene scene{c.model, c.start};
    if (c.source) scene.sources = {c.source};
    scene.conserves = !c.source;
    scene.prepare = [loops = c.loops](Simulation& simulation) { simulation.set_loops(loops); };
    return scene;
  };
  for (const LoopCase::Sample& sample : c.reference) motion.times.push_back(sample.t);
  motion.readings = c.readings;
  motion.observe = [read = c.read](const Model<double>& model, const State<double>& x) {
    Kinematics k(model);
    forward_kinematics(model, x, k);
    return read(x, k);
  };
  motion.reference = [samples = c.reference](double t) {
    const auto nearest = std::min_element(
        samples.begin(), samples.end(), [t](const LoopCase::Sample& a, const LoopCase::Sample& b) {
          return std::abs(a.t - t) < std::abs(b.t - t);
        });
    return nearest->values;
  };
  motion.lane = rk4_lane(c.step);
  motion.of_its_lane = true;
  motion.at_times_only = true;
  return motion;
}

}  // namespace

std::shared_ptr<const TrajectoryCase> loop_motion(std::string_view case_name) {
  struct NamedLoop {
    std::string_view name;
    LoopCase (*make)();
  };
  constexpr NamedLoop all[] = {
      {"D1-hinge", pendulum_on_hinge},
      {"D1-circle", pendulum_on_circle},
      {"D2-2", [] { return windows(2); }},
      {"D3", squeezer},
      {"D4", bricard},
      {"D5-springs", [] { return governor(Couplers::springs); }},
      {"D5-rods", [] { return governor(Couplers::rods); }},
      {"D6", slider_crank},
  };
  for (const NamedLoop& one : all)
    if (one.name == case_name) return std::make_shared<const TrajectoryCase>(as_motion(one.make()));
  return nullptr;
}

}  // namespace twinarm
