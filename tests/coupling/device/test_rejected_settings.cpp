// Invalid settings of couplings, batches and devices: too many ticks, and the digits of errors.
#include <doctest/doctest.h>

#include <memory>
#include <string>

#include "coupling/batch/batch_run.h"
#include "coupling/device/virtual_omni.h"
#include "coupling/target/scripted_motion.h"
#include "solver/support/diagnostics.h"
#include "tests/coupling/analysis/laws.h"
#include "tests/support/problem_of.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("a virtual Omni rejects a delay of too many ticks before it takes memory for them") {
  const auto hand = std::make_shared<SteadyHand>();
  VirtualOmniSettings settings;
  settings.parameters.rate = 1e5;
  settings.delay_to_host = settings.delay_to_motors = 1;
  CHECK_NOTHROW(VirtualOmni(hand, settings));
  for (const double rate : {1e9, 1e300}) {
    settings.parameters.rate = rate;
    CHECK_THROWS_AS(VirtualOmni(hand, settings), InputError);
  }
}

TEST_CASE("errors of couplings, batches and devices show small numbers by their digits") {
  const auto is_shown = [](const std::string& text) {
    CAPTURE(text);
    return text.find("-1e-09") != std::string::npos;
  };
  const Model<double> model = chain_of_three(3);
  const auto hand = std::make_shared<SteadyHand>();
  TargetRobot kvr(model, *hand, SteadyHand::mapping(), {kThreeJoints, "", 0, 0});
  CouplingSpec spec;
  spec.name = "held";
  spec.springs = {{"s", 1, Vector3::Zero(), -1e-9, 1}};
  CHECK(is_shown(problem_of([&] { make_coupling(spec, model, kvr); })));
  spec.springs[0].k = 1;
  spec.type = CouplingType::weld;
  spec.reference.impedance = -1e-9;
  CHECK(is_shown(problem_of([&] { make_coupling(spec, model, kvr); })));
  BatchSetup setup;
  setup.model = &model;
  setup.duration = -1e-9;
  int shown = 0;
  for (const Diagnostic& fault : batch_faults(setup)) shown += is_shown(fault.problem);
  CHECK(shown == 1);
  VirtualOmniSettings settings;
  settings.delay_to_host = -1e-9;
  CHECK(is_shown(problem_of([&] { VirtualOmni(hand, settings); })));
  CHECK(is_shown(DelayedMotion(*hand, -1e-9, 1).description()));
  CHECK(is_shown(StepMotion({}, {}, -1e-9, 1).description()));
}
