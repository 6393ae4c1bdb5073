// What a simulation says of sources that break it or do not fit it.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "solver/simulation.h"
#include "tests/solver/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

struct ConstantTorque final : ForceSource {
  std::size_t velocity = 0;
  double value = 0;
  bool implicit = false;
  void add_forces(const State<double>&, const Kinematics&, Forces<double>& f) noexcept override {
    f.tau[velocity] += value;
  }
  bool needs_semi_implicit() const override { return implicit; }
};

Model<double> chain(int n) {
  Random random(9);
  ModelBuilder builder;
  for (int i = 1; i <= n; ++i)
    builder.add_body("link" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     JointType::revolute, {random.rotation(), random.vector(0.3)}, random.vector(1),
                     random.inertia());
  return builder.build();
}

}  // namespace

TEST_CASE("a torque that is not a number is reported with the joint it acts on") {
  const Model<double> model = chain(5);
  for (int joint = 1; joint <= 5; ++joint) {
    ConstantTorque torque;
    torque.velocity = model.iv[static_cast<std::size_t>(joint)];
    torque.value = std::numeric_limits<double>::quiet_NaN();
    Simulation simulation(model, State<double>(model));
    simulation.add(torque);
    const StepReport report = simulation.step(1e-3);
    CHECK_FALSE(report.finite);
    CHECK(report.bad_body == joint);
    CHECK(std::string(report.bad_field) == "tau");
  }
}

TEST_CASE("a source that is refused does not act") {
  const Model<double> model = chain(1);
  ConstantTorque torque;
  torque.implicit = true;
  torque.value = 1;
  Simulation simulation(model, State<double>(model));
  simulation.set_integrator(Integrator::rk4);
  CHECK_THROWS_AS(simulation.add(torque), std::invalid_argument);
  Simulation untouched(model, State<double>(model));
  untouched.set_integrator(Integrator::rk4);
  simulation.step(0.1);
  untouched.step(0.1);
  CHECK(simulation.state().qd[0] == untouched.state().qd[0]);
}
