// Invalid input of couplings and target robots: joints of several degrees of freedom, step sizes
// that are not positive and finite or too small.
#include <doctest/doctest.h>

#include <limits>

#include "coupling/batch/batch_run.h"
#include "solver/forces/joint_stops.h"
#include "solver/support/diagnostics.h"
#include "tests/coupling/analysis/laws.h"
#include "tests/support/problem_of.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kBadSteps[] = {0.0, -1e-3, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()};

// revolute - plate (fixed) - spherical.
Model<double> mixed_chain() {
  ModelBuilder builder;
  const BodyInertia inertia{1, Vector3::Zero(), 0.1 * Matrix3::Identity()};
  const Pose X{Matrix3::Identity(), {0.5, 0, 0}};
  builder.add_body("link1", 0, "hinge", JointType::revolute, {}, Vector3::UnitZ(), inertia);
  builder.add_body("link2", 1, "plate", JointType::fixed, X, Vector3::UnitZ(), inertia);
  builder.add_body("link3", 2, "ball", JointType::spherical, X, Vector3::UnitZ(), inertia);
  return builder.build();
}

}  // namespace

TEST_CASE("couplings of joint coordinates reject joints of several degrees of freedom") {
  const Model<double> model = mixed_chain();
  const SteadyHand hand;
  TargetRobot kvr(model, hand, SteadyHand::mapping(), {{"hinge"}, "", 0, 0});
  CouplingSpec torsional, pd;
  torsional.measure = SpringSpace::joint;
  pd.type = CouplingType::stable_pd;
  for (CouplingSpec spec : {torsional, pd}) {
    spec.name = "held";
    spec.springs = {{"s", 1, Vector3::Zero(), 10, 1}};
    CHECK(problem_of([&] { make_coupling(spec, model, kvr); }) == "");
    for (const auto& [body, words] :
         {std::pair{2, "joint 'plate': the joint has 0 degrees of freedom, must have one"},
          std::pair{3, "joint 'ball': the joint has 3 degrees of freedom, must have one"}}) {
      spec.springs[0].body = body;
      const std::string text = problem_of([&] { make_coupling(spec, model, kvr); });
      CAPTURE(text);
      CHECK(text.find(words) != std::string::npos);
    }
  }
  torsional.measure = SpringSpace::world;  // a torque on the link: any joint
  torsional.springs = {{"s", 2, Vector3::Zero(), 10, 1}, {"t", 3, Vector3::Zero(), 10, 1}};
  CHECK(problem_of([&] { make_coupling(torsional, model, kvr); }) == "");
  const std::vector<JointStops::Stop> stops{{2, -1, 1, 10, 1}};
  CHECK(problem_of([&] { JointStops("stops", model, stops); }) != "");
}

TEST_CASE("a target robot rejects driving a fixed or a spherical joint, and names each") {
  const Model<double> model = mixed_chain();
  const SteadyHand hand;
  const auto refused = [&](const DrivenJoints& joints) {
    return problem_of([&] { TargetRobot(model, hand, SteadyHand::mapping(), joints); });
  };
  CHECK(refused({{"hinge"}, "", 0, 0}) == "");
  CHECK(refused({{"hinge"}, "hinge", 0, 0}) == "");
  const std::string two = refused({{"plate", "hinge", "ball"}, "", 0, 0});
  CHECK(two.find("joint 'plate': it has 0 degrees of freedom") != std::string::npos);
  CHECK(two.find("joint 'ball': it has 3 degrees of freedom") != std::string::npos);
  CHECK(two.find("hinge") == std::string::npos);
  CHECK(refused({{"hinge"}, "plate", 0, 1}).find("joint 'plate'") != std::string::npos);
}

TEST_CASE("an as-published coupling with hold_steps 0 is evaluated at every step") {
  const Model<double> model = chain_of_three(7);
  const SteadyHand hand = hand_at({0.3, -0.2, 0.4}, {0.5, 0.4, -0.6});
  for (const CouplingType type : {CouplingType::linear, CouplingType::torsional}) {
    State<double> end[2];
    for (const int hold : {0, 1}) {
      CouplingSpec spec;
      spec.name = "printed";
      spec.type = type;
      spec.printed = true;
      spec.options.hold_steps = hold;
      spec.springs = chain_springs(10, 0.1);
      Coupled coupled(model, hand, kThreeJoints, spec, State<double>(model));
      for (int n = 0; n < 20; ++n) coupled.simulation.step(1e-3);
      end[hold] = coupled.simulation.state();
    }
    CHECK(end[0].q == end[1].q);
    CHECK(end[0].qd == end[1].qd);
    CHECK(end[0].q[0] != 0);
  }
}

TEST_CASE("a tracking run and predictions reject a step size that is not positive and finite") {
  const Model<double> model = chain_of_three(3);
  const SteadyHand hand;
  TrackingSetup tracking;
  tracking.kvr_model = tracking.dvr_model = &model;
  tracking.motion = &hand;
  tracking.joints.turned = kThreeJoints;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Constant(1, 1, 1.0);
  for (const double h : kBadSteps) {
    CAPTURE(h);
    tracking.h = h;
    CHECK_THROWS_AS(TrackingSystem{tracking}, InputError);
    CHECK_THROWS_AS(spectral_radius(one, {{one, one, one}}, Integrator::rk4, h), InputError);
    CHECK_THROWS_AS(
        max_stiffness_factor(one, one, one, SteppingScheme::euler, h, HoldConstant::damping_ratio),
        InputError);
    CHECK_THROWS_AS(max_target_radius(1, 1, 1, 1, h), InputError);
  }
}

TEST_CASE("batched runs reject a step size that is invalid or too small before any run") {
  const Model<double> model = chain_of_three(3);
  const SteadyHand hand;
  BatchSetup setup;
  setup.model = &model;
  setup.start = State<double>(model);
  setup.targets = {{&hand, {kThreeJoints, "", 0, 0}, setup.start}};
  setup.duration = 0.1;
  BatchRun batch(setup);
  std::vector<double> bad(std::begin(kBadSteps), std::end(kBadSteps));
  bad.insert(bad.end(), {1e-300, 1e-9});  // their table of the motion would not fit in memory
  for (const double h : bad) {
    CAPTURE(h);
    std::vector<BatchCell> cells(3);
    cells[2].h = h;
    std::vector<BatchResult> results(3);
    CHECK_THROWS_AS(batch.run(cells, results), InputError);
    CHECK(results[0].steps == 0);
  }
}
