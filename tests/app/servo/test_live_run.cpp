// Live run and servo loop: tracking, no jumps, force, timing figures.
#include <atomic>
#include <cmath>
#include <functional>

#include "app/servo/haptic_loop.h"
#include "app/servo/servo_loop.h"
#include "tests/app/scene/model/helpers.h"
#include "tests/support/count_allocations.h"

namespace twinarm {
namespace {

// A device moved by a test; stores the rendered force.
class TestDevice final : public InputDevice {
 public:
  std::function<DeviceState(double)> state = [](double) { return DeviceState(); };
  DeviceForce rendered;
  DeviceState poll(double now) noexcept override {
    DeviceState at = state(now);
    at.t = now;
    at.stylus = omni_stylus(omni_, at.theta);
    return at;
  }
  void render(const DeviceForce& force) noexcept override { rendered = force; }
  const OmniParameters& parameters() const override { return omni_; }
  std::string description() const override { return "a test"; }
  bool has_motors() const override { return true; }

 private:
  OmniParameters omni_;
};

DeviceState turned(double theta1) {
  DeviceState state;
  state.theta = {theta1, 0.8, 0.2, 0, 0, 0};
  return state;
}

const std::string kScene = test_data("app/servo/two_springs.toml");

SceneModel live_scene(const std::string& more = "") {
  const TemporaryFolder folder;
  return build_scene(read_scene(folder.write("test.toml", kScene + more)));
}

}  // namespace

TEST_CASE("live run: the target robot follows the device by the gain, and pulls the robot along") {
  const SceneModel scene = live_scene();
  TestDevice device;
  device.state = [](double t) { return turned(0.2 + 0.3 * std::sin(2 * t)); };
  LiveRun run(scene, device, {});
  double farthest = 0;
  for (int n = 0; n < 2000; ++n) {
    const TickResult view = run.tick();
    CHECK(std::abs(OperatorMapping{}.robot_angle(view.motion.sample, 0) -
                   2 * 0.3 * std::sin(2 * run.time() - 0.002)) < 1e-3);
    farthest = std::max(farthest, std::abs(view.error[0]));
  }
  CHECK(farthest < 0.06);
  CHECK(farthest > 1e-4);
}

TEST_CASE(
    "live run: the motor torque is the springs' torque times the gain, against the operator") {
  // Rotated, then at rest: joint friction leaves a spring deflection.
  const SceneModel scene = live_scene(R"(
[[body]]
name = "block"
fixed = true
shape = { box = { size = [0.1, 0.1, 0.6] } }
position = [0.3, 0.16, 0.3]
)");
  TestDevice device;
  device.state = [](double t) { return turned(std::min(0.1 * t, 0.2)); };
  LiveOptions options;
  options.force.passive = false;
  LiveRun run(scene, device, options);
  TickResult view;
  for (int n = 0; n < 3000; ++n) view = run.tick();
  const double spring = 2000 * view.error[0];
  REQUIRE(run.contacts().contact_count() > 0);
  REQUIRE(spring > 1);
  CHECK(device.rendered.torque[0] < 0);  // towards the robot
  CHECK(device.rendered.torque[1] == 0);
  const Vector3 torque(device.rendered.torque[0], device.rendered.torque[1],
                       device.rendered.torque[2]);
  const double most = device.parameters().peak_force;
  const double rendered = stylus_force(device.parameters(), turned(0.2).theta, torque);
  // Twice the spring's torque, limited by the motors.
  const double wanted =
      stylus_force(device.parameters(), turned(0.2).theta, Vector3(2 * spring, 0, 0));
  CHECK(rendered == doctest::Approx(std::min(most, wanted)).epsilon(1e-6));
}

TEST_CASE("live run: after a device timeout the target holds, then is released, and never jumps") {
  const SceneModel scene = live_scene();
  TestDevice device;
  device.state = [](double t) {
    DeviceState state = turned(0.3 * std::sin(3 * t));
    const bool is_silent = t > 0.5 && t < 2.5;
    state.alive = !is_silent;
    // Invalid data while silent; another pose afterwards.
    if (is_silent) state.theta[0] = -0.9;
    if (t >= 2.5) state.theta[0] -= 0.5;
    return state;
  };
  LiveRun run(scene, device, {});
  double last = 0, slack = 1, fastest = 0;
  int held = 0, released = 0;
  for (int n = 0; n < 4000; ++n) {
    const TickResult view = run.tick();
    const double angle = OperatorMapping{}.robot_angle(view.motion.sample, 0);
    fastest = std::max(fastest, std::abs(angle - last));
    last = angle;
    held += view.mode == DeviceWatchdog::Mode::held ? 1 : 0;
    released += view.mode == DeviceWatchdog::Mode::released ? 1 : 0;
    if (n == 2400) slack = std::abs(view.error[0]);
    if (view.mode != DeviceWatchdog::Mode::live) CHECK(view.motor_torques[0] == 0);
  }
  CHECK(held > 990);
  CHECK(held < 1010);
  CHECK(released > 980);
  CHECK(run.watch().silences() == 1);
  CHECK(slack < 1e-3);
  CHECK(fastest < 0.6 * 3 * 0.001 * 1.01);  // speed of the sine, twice the device's
}

TEST_CASE("live run: a device state that is not finite leaves the target robot at rest") {
  const SceneModel scene = live_scene();
  TestDevice device;
  device.state = [](double t) { return turned(t < 0.1 ? 0.1 * t : NAN); };
  LiveRun run(scene, device, {});
  TickResult view;
  for (int n = 0; n < 300; ++n) view = run.tick();
  CHECK(view.finite);
  CHECK(std::abs(OperatorMapping{}.robot_angle(view.motion.sample, 0) - 0.02) < 1e-3);
}

TEST_CASE("live run: a diverged robot is not stepped any more, and renders no force") {
  std::string text = kScene;
  const std::string from = "damping = 100\n", to = "damping = 1e7\ndiscretization = \"explicit\"\n";
  text.replace(text.find(from), from.size(), to);
  text.replace(text.find("s103/s103.urdf"), 14, "findings_set0/findings_set0.urdf");  // no limits
  const TemporaryFolder folder;
  const SceneModel scene = build_scene(read_scene(folder.write("test.toml", text)));
  TestDevice device;
  device.state = [](double t) { return turned(0.2 * t); };
  LiveRun run(scene, device, {});
  TickResult view;
  for (int n = 0; n < 2000; ++n) view = run.tick();
  CHECK_FALSE(view.finite);
  CHECK(device.rendered.torque[0] == 0);
}

TEST_CASE("live run: a tick among obstacles allocates nothing once warm") {
  constexpr double kPeriod = 2 * M_PI;  // of the device's motion [s]
  constexpr int kTicks = 6283;          // of a period
  const SceneModel scene = build_scene(read_scene(std::filesystem::path(TWINARM_SOURCE_DIR) /
                                                  "assets/scenes/hand_and_obstacles.toml"));
  TestDevice device;
  device.state = [](double t) {
    DeviceState state = turned(1.4 * std::sin(2 * t));
    state.theta[3] = 1.5 * std::sin(3 * t);
    state.buttons[0] = std::sin(5 * t) > 0;
    state.alive = std::fmod(t, kPeriod) < kPeriod - 0.3;
    return state;
  };
  LiveRun run(scene, device, {});
  for (int n = 0; n < 2 * kTicks; ++n) run.tick();
  const long before = testing::allocations;
  int touching = 0;
  for (int n = 0; n < kTicks; ++n) {
    run.tick();
    touching += run.contacts().contact_count() > 0 ? 1 : 0;
  }
  CHECK(testing::allocations == before);
  CHECK(touching > 100);
}

TEST_CASE("live run: scenes that a device cannot drive are refused before the run") {
  TestDevice device;
  const auto codes_of = [&](const SceneModel& scene) {
    std::string all;
    for (const Diagnostic& fault : faults_of([&] { LiveRun(scene, device, {}); }))
      all += fault.code;
    return all;
  };
  const TemporaryFolder folder;
  const SceneModel still = build_scene(read_scene(folder.write("still.toml", R"(
[[robot]]
name = "arm"
model = "robots/s103/s103.urdf"
)")));
  CHECK(codes_of(still) == "hand.no-device");
  const auto with = [&](const std::string& line) {
    return build_scene(read_scene(folder.write("other.toml", line + kScene)));
  };
  CHECK(codes_of(with("integrator = \"rk4\"\n")) == "hand.integrator");
  CHECK(codes_of(with("contact = \"event\"\n")) == "hand.contact");
  CHECK(codes_of(with("integrator = \"semi-implicit\"\n")).empty());
}

TEST_CASE("servo loop: takes the requested ticks in real time") {
  const SceneModel scene = live_scene();
  TestDevice device;
  LiveRun run(scene, device, {});
  ServoPlan plan;
  plan.duration = 0.2;
  plan.empty_loop = true;
  const std::atomic<bool> stop{false};
  long drained = 0;
  const double start = monotonic_time();
  const ServoResult result = run_servo(run, plan, stop, [&](SpscRing<TickResult>& ring) {
    for (TickResult view; ring.pop(view);) {
      CHECK(view.motion.t == doctest::Approx(0.001 * static_cast<double>(drained)).epsilon(1e-9));
      ++drained;
    }
  });
  CHECK(drained + result.lost == 200);
  CHECK(result.run.cpu.count() == 200);
  CHECK(result.run.late.count() == 200);
  // Two hundred periods, less the skipped ones.
  CHECK(monotonic_time() - start >=
        0.001 * (200.0 - static_cast<double>(result.run.slipped)) - 1e-6);
}

TEST_CASE("servo loop: ends at the next tick after the stop flag") {
  const SceneModel scene = live_scene();
  TestDevice device;
  LiveRun run(scene, device, {});
  ServoPlan plan;
  plan.duration = HUGE_VAL;
  std::atomic<bool> stop{false};
  long ticks = 0;
  run_servo(run, plan, stop, [&](SpscRing<TickResult>& ring) {
    for (TickResult view; ring.pop(view);) ++ticks;
    if (ticks > 20) stop = true;
  });
  CHECK(ticks > 20);
}

TEST_CASE(
    "tick times: a quantile is never too small, and at most a sixteenth of an octave too large") {
  TickTimes times;
  std::vector<double> all;
  for (int n = 1; n <= 5000; ++n) all.push_back(2e-7 * std::exp(0.002 * n));
  for (const double time : all) times.add(time);
  for (const double p : {0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const double exact = all[static_cast<std::size_t>(std::ceil(p * 5000)) - 1];
    CHECK(times.quantile(p) >= exact * (1 - 1e-12));
    CHECK(times.quantile(p) <= exact * std::exp2(1.0 / 16) * (1 + 1e-12));
  }
  CHECK(times.max() == all.back());
  CHECK(TickTimes().quantile(0.5) == 0);
}

}  // namespace twinarm
