// A step with couplings among the sources takes nothing from the heap and gives the same bits.
#include <doctest/doctest.h>

#include <cstring>

#include "tests/coupling/one_joint.h"
#include "tests/coupling/two_link.h"
#include "tests/solver/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

struct Run {
  CouplingSpec spec;
  Integrator integrator;
};
std::vector<Run> runs() {
  const TwoLink arm;
  const auto gains = arm.springs(1200, 40), point_gains = arm.springs(22000, 400);
  std::vector<Run> list;
  for (const Integrator integrator :
       {Integrator::euler, Integrator::semi_implicit, Integrator::rk4}) {
    for (const Measure measure : {Measure::world, Measure::joint})
      list.push_back({torsional(gains, measure), integrator});
    list.push_back({linear(point_gains), integrator});
    list.push_back({linear(point_gains), integrator});
    list.back().spec.type = CouplingSpec::Type::matched;
    for (const auto type : {CouplingSpec::Type::torsional, CouplingSpec::Type::linear})
      list.push_back({printed(type, gains, {}), integrator});
  }
  for (const Treatment treatment : {Treatment::semi_implicit, Treatment::implicit}) {
    for (const Measure measure : {Measure::world, Measure::joint})
      list.push_back({torsional(gains, measure, treatment), Integrator::semi_implicit});
    list.push_back({linear(point_gains, treatment), Integrator::semi_implicit});
  }
  return list;
}

struct System {
  Model<double> model = TwoLink().model();
  AutomaticMotion hand{HandMapping{}, 0.05};  // corners within the run
  std::unique_ptr<TrackingSystem> system;
  explicit System(const Run& run, KvrRates rates) {
    TrackingSetup setup;
    setup.kvr_model = setup.dvr_model = &model;
    setup.hand = &hand;
    setup.joints.turned = {"joint1", "joint2"};
    setup.couplings = {run.spec};
    setup.integrator = run.integrator;
    setup.kvr_rates = rates;
    system = std::make_unique<TrackingSystem>(setup);
  }
};

}  // namespace

TEST_CASE("a step with a coupling takes nothing from the heap: all laws, treatments, integrators") {
  for (const Run& run : runs())
    for (const KvrRates rates : {KvrRates::from_hand, KvrRates::backward_difference}) {
      System s(run, rates);
      CAPTURE(static_cast<int>(run.integrator));
      CAPTURE(static_cast<int>(run.spec.treatment));
      CAPTURE(run.spec.printed);
      CHECK(allocations_in([&] {
              for (int n = 0; n < 160; ++n) s.system->simulation().step(1e-3);
            }) == 0);
    }
}

TEST_CASE("a coupled run gives the same bits when it is run again") {
  for (const Run& run : runs()) {
    const auto end = [&] {
      System s(run, KvrRates::from_hand);
      for (int n = 0; n < 160; ++n) s.system->simulation().step(1e-3);
      return s.system->simulation().state();
    };
    const State<double> a = end(), b = end();
    CHECK(std::memcmp(a.q.data(), b.q.data(), 2 * sizeof(double)) == 0);
    CHECK(std::memcmp(a.qd.data(), b.qd.data(), 2 * sizeof(double)) == 0);
  }
}

TEST_CASE("a coupling that is implicit is refused by rk4 and by explicit Euler") {
  const TwoLink arm;
  for (const Treatment treatment : {Treatment::semi_implicit, Treatment::implicit})
    for (const Integrator integrator : {Integrator::rk4, Integrator::euler}) {
      CHECK_THROWS_AS(
          System({linear(arm.springs(1, 1), treatment), integrator}, KvrRates::from_hand),
          std::invalid_argument);
      CHECK_THROWS_AS(System({torsional(arm.springs(1, 1), Measure::joint, treatment), integrator},
                             KvrRates::from_hand),
                      std::invalid_argument);
    }
}
