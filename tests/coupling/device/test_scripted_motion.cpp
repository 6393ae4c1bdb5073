// Scripted motions by their formulas; properties of every motion and every device.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "coupling/device/desktop_input.h"
#include "coupling/device/virtual_omni.h"
#include "coupling/target/operator_motion.h"
#include "coupling/target/recorded_trace.h"
#include "coupling/target/scripted_motion.h"
#include "coupling/target/synthetic_operator.h"

using namespace twinarm;

namespace {

constexpr DeviceAngles kFrom{-0.3, 0.5, -0.2, 0.4, 0.3, -1}, kTo{0.4, 0.9, 0.3, -0.4, 1.0, 1};

// All motions; add new ones here.
struct NamedHand {
  std::string name;
  std::function<std::shared_ptr<OperatorMotion>()> make;
  double corner = -1;  // time of a jump
};
std::vector<NamedHand> all_hands() {
  const std::string trace = std::string(TWINARM_SOURCE_DIR) + "/assets/traces/synthetic_seed1.csv";
  return {
      {"automatic", [] { return std::make_shared<AutomaticMotion>(OperatorMapping{}); }},
      {"synthetic", [] { return std::make_shared<SyntheticOperator>(3, 4.0); }},
      {"trace", [trace] { return std::make_shared<RecordedTrace>(trace); }},
      {"paced",
       [] {
         return std::make_shared<DelayedMotion>(std::make_unique<SyntheticOperator>(4, 3.0), 0.15,
                                                1.2);
       }},
      {"step", [] { return std::make_shared<StepMotion>(kFrom, kTo, 0.5, 3); }, 0.5},
      {"chirp", [] { return std::make_shared<ChirpMotion>(kFrom, DeviceAngles{0.1}, 0.5, 8, 2); }},
      {"reach", [] { return std::make_shared<ReachMotion>(kFrom, kTo, 0.2, 0.8); }},
      {"gestures", [] {
         const auto hand = std::make_shared<DesktopInput>(OmniParameters{});
         hand->axes({0.5, -0.4, 0.3, 0.2, 0.7, -1});
         return hand;
       }}};
}

// All devices, each moved by a motion.
struct NamedDevice {
  std::string name;
  std::function<std::unique_ptr<InputDevice>(std::shared_ptr<OperatorMotion>)> make;
};
std::vector<NamedDevice> all_devices() {
  const auto virtual_omni = [](const VirtualOmniSettings& settings) {
    return [settings](std::shared_ptr<OperatorMotion> hand) {
      return std::make_unique<VirtualOmni>(hand, settings);
    };
  };
  VirtualOmniSettings late, alone;
  late.delay_to_host = 0.02;
  late.delay_to_motors = 0.0135;
  alone.arm = {0, 0, 0};
  return {{"virtual Omni", virtual_omni({})},
          {"virtual Omni, late", virtual_omni(late)},
          {"virtual Omni, not held", virtual_omni(alone)}};
}

// State of a device over a second, at times that are not its ticks, bit by bit.
std::vector<double> story(InputDevice& device) {
  std::vector<double> all;
  for (int n = 0; n < 600; ++n) {
    const DeviceState seen = device.poll(100 + 0.0017 * n);
    all.push_back(seen.t);
    all.insert(all.end(), seen.theta.begin(), seen.theta.end());
    all.insert(all.end(), seen.stylus.p.data(), seen.stylus.p.data() + 3);
    all.insert(all.end(), seen.stylus.R.data(), seen.stylus.R.data() + 9);
    device.render({{0.1 * std::sin(0.1 * n), 0.05, -0.2 * std::cos(0.07 * n)}});
  }
  return all;
}

}  // namespace

TEST_CASE("step, chirp and reach agree with their formulas, one-sided at jumps") {
  const StepMotion step(kFrom, kTo, 0.5, 3);
  CHECK(step.sample(0.499, 0.5).theta == kFrom);
  CHECK(step.sample(0.5, 0.499).theta == kFrom);
  CHECK(step.sample(0.5, 0.501).theta == kTo);
  CHECK(step.sample(0.5 + 1e-16, 0.499).theta == kFrom);
  CHECK(step.sample(0.5, 0.501).theta_dot == std::array<double, 6>{});

  const DeviceAngles amplitude{0.1, 0, 0, 0.2, 0, 0};
  const ChirpMotion chirp(kFrom, amplitude, 1, 5, 2);
  // Phase: integral of the frequency, 1 Hz to 5 Hz in 2 s; 6 periods in all, 1.5 + 0.5 in 1 s.
  CHECK(chirp.sample(2, 3).theta[0] == doctest::Approx(kFrom[0]));
  CHECK(chirp.sample(1, 2).theta[3] == doctest::Approx(kFrom[3]));
  const double phi = 2 * std::numbers::pi * (0.25 + 0.25 * 0.25);
  CHECK(chirp.sample(0.25, 1).theta[0] == doctest::Approx(kFrom[0] + 0.1 * std::sin(phi)));
  CHECK(chirp.sample(0, 1).theta_dot[0] == doctest::Approx(0.1 * 2 * std::numbers::pi));
  CHECK(chirp.sample(0, -1).theta_dot[0] == 0);
  CHECK(chirp.sample(2, 1).theta_dot[0] == doctest::Approx(0.1 * 10 * std::numbers::pi));
  CHECK(chirp.sample(2, 3).theta_dot[0] == 0);

  const ReachMotion reach(kFrom, kTo, 0.2, 0.8);
  CHECK(reach.sample(0.1, 1).theta == kFrom);
  CHECK(reach.sample(0.6, 1).theta[0] == doctest::Approx(0.05));
  CHECK(reach.sample(0.6, 1).theta_dot[0] ==
        doctest::Approx(1.875 * 0.7 / 0.8));  // 15/8 of the mean
  for (std::size_t j = 0; j < 6; ++j)
    CHECK(reach.sample(1.5, 2).theta[j] == doctest::Approx(kTo[j]));
}

TEST_CASE("every motion: finite, deterministic, rates equal to the slope") {
  for (const NamedHand& named : all_hands()) {
    CAPTURE(named.name);
    const auto hand = named.make(), again = named.make();
    CHECK(hand->duration() > 0);
    CHECK_FALSE(hand->description().empty());
    constexpr double e = 1e-6;
    double off = 0;
    bool same = true, finite = true;
    for (int n = 0; n < 1000; ++n) {
      const double t = 0.0029 * n + 1e-4;
      const OperatorSample x = hand->sample(t, t + 1e-3), y = again->sample(t, t + 1e-3);
      same = same && std::memcmp(x.theta.data(), y.theta.data(), sizeof x.theta) == 0 &&
             std::memcmp(x.theta_dot.data(), y.theta_dot.data(), sizeof x.theta) == 0;
      const OperatorSample next = hand->sample(t + e, t + 1e-3);
      for (std::size_t j = 0; j < 6; ++j) {
        finite = finite && std::isfinite(x.theta[j]) && std::isfinite(x.theta_dot[j]);
        if (std::abs(t - named.corner) > 1e-3)
          off = std::max(off, std::abs((next.theta[j] - x.theta[j]) / e - x.theta_dot[j]));
      }
    }
    CHECK(same);
    CHECK(finite);
    CHECK(off < 5e-3);
  }
}

TEST_CASE("every device with every motion: within its ranges, increasing time, deterministic") {
  for (const NamedDevice& device : all_devices())
    for (const NamedHand& hand : all_hands()) {
      CAPTURE(device.name);
      CAPTURE(hand.name);
      const auto one = device.make(hand.make()), other = device.make(hand.make());
      const OmniParameters& o = one->parameters();
      const std::vector<double> story_one = story(*one), story_other = story(*other);
      CHECK(std::memcmp(story_one.data(), story_other.data(), 8 * story_one.size()) == 0);
      bool good = true;
      double last = 0;
      for (std::size_t i = 0; i < story_one.size(); i += 19) {
        for (std::size_t k = i; k < i + 19; ++k) good = good && std::isfinite(story_one[k]);
        for (std::size_t j = 0; j < 6; ++j)
          good = good && story_one[i + 1 + j] >= o.lower[j] && story_one[i + 1 + j] <= o.upper[j];
        good = good && story_one[i] >= last && story_one[i] <= 100 + 0.0017 * 600;
        last = story_one[i];
      }
      CHECK(good);
      CHECK(last > 100.9);
      CHECK_FALSE(one->description().empty());
      CHECK(one->has_motors());
    }
}
