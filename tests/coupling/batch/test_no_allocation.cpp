// A step with couplings does not allocate and is deterministic.
#include <doctest/doctest.h>

#include <cstring>

#include "tests/coupling/analysis/laws.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"
#include "tests/coupling/batch/single_runs.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

struct Run {
  CouplingSpec spec;
  Integrator integrator;
};
std::vector<Run> runs() {
  const TwoLink arm;
  std::vector<Run> list;
  for (const Law& law : all_laws()) {
    std::vector<Spring> springs =
        law.on_joint() || law.on_orientation() ? arm.springs(1200, 40) : arm.springs(22000, 400);
    for (Spring& spring : springs) spring.k_rotational = 1200, spring.b_rotational = 40;
    const bool in_stages =
        law.discretization == Discretization::explicit_ && !law.own && !law.is(CouplingType::weld);
    for (const Integrator integrator :
         {Integrator::euler, Integrator::semi_implicit, Integrator::rk4})
      if (in_stages || integrator == Integrator::semi_implicit)
        list.push_back({spec_of(law, springs), integrator});
  }
  return list;
}

struct System {
  Model<double> model = TwoLink().model();
  AutomaticMotion hand{OperatorMapping{}, 0.05};  // velocity jumps within the run
  std::unique_ptr<TrackingSystem> system;
  explicit System(const Run& run, TargetRates rates) {
    TrackingSetup setup;
    setup.kvr_model = setup.dvr_model = &model;
    setup.motion = &hand;
    setup.joints.turned = {"joint1", "joint2"};
    setup.couplings = {run.spec};
    setup.integrator = run.integrator;
    setup.kvr_rates = rates;
    system = std::make_unique<TrackingSystem>(setup);
  }
};

}  // namespace

TEST_CASE("a step with a coupling does not allocate: all laws, discretizations, integrators") {
  for (const Run& run : runs())
    for (const TargetRates rates : {TargetRates::from_operator, TargetRates::backward_difference}) {
      System s(run, rates);
      CAPTURE(static_cast<int>(run.integrator));
      CAPTURE(run.spec.name);
      CHECK(allocations_in([&] {
              for (int n = 0; n < 160; ++n) s.system->simulation().step(1e-3);
            }) == 0);
    }
}

TEST_CASE("the serialised state of a coupling continues the run bit-identically") {
  for (Run run : runs()) {
    CAPTURE(run.spec.name);
    if (!run.spec.printed && run.spec.discretization == Discretization::explicit_)
      run.spec.hold_steps = 7;
    run.spec.options.hold_steps = 7;
    run.spec.options.difference = Difference::older;  // needs the last two evaluations
    if (run.integrator != Integrator::semi_implicit) continue;
    System first(run, TargetRates::from_operator), second(run, TargetRates::from_operator);
    for (int n = 0; n < 59; ++n) first.system->simulation().step(1e-3);
    StateArchive written;
    first.system->coupling(0).serialize(written);
    StateArchive read(written.bytes());
    second.system->coupling(0).serialize(read);
    CHECK(read.at_end());
    second.system->simulation().set_state(first.system->simulation().state());
    for (int n = 0; n < 40; ++n) {
      first.system->simulation().step(1e-3);
      second.system->simulation().step(1e-3);
    }
    const State<double>&a = first.system->simulation().state(),
          &b = second.system->simulation().state();
    CHECK(std::memcmp(a.q.data(), b.q.data(), 2 * sizeof(double)) == 0);
    CHECK(std::memcmp(a.qd.data(), b.qd.data(), 2 * sizeof(double)) == 0);
  }
}

TEST_CASE("an implicit coupling is rejected by rk4 and by explicit Euler") {
  for (const Law& law : all_laws()) {
    const bool in_stages =
        law.discretization == Discretization::explicit_ && !law.own && !law.is(CouplingType::weld);
    if (in_stages) continue;
    CAPTURE(law.name);
    for (const Integrator integrator : {Integrator::rk4, Integrator::euler})
      CHECK_THROWS_AS(
          System({spec_of(law, TwoLink().springs(1, 1)), integrator}, TargetRates::from_operator),
          std::invalid_argument);
  }
}

TEST_CASE("batched runs do not allocate in a step: a longer run allocates no more") {
  Random random(86);
  CellBench bench(tree_for_lanes(random, Axes::any), kBatchLaws[0], Discretization::implicit,
                  false);
  const std::vector<BatchCell> cells(9, bench.random_cell(random));
  std::vector<BatchResult> results(cells.size());
  const auto allocations_over = [&](double duration) {
    bench.setup.duration = duration;
    BatchRun batch(bench.setup);
    batch.run(cells, results);  // results have their sizes now
    return allocations_in([&] { batch.run(cells, results); });
  };
  CHECK(allocations_over(0.4) == allocations_over(0.1));
}
