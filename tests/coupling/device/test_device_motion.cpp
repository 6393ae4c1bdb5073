// DeviceMotion, and the log for its replay.
#include <doctest/doctest.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <random>

#include "coupling/device/device_motion.h"
#include "coupling/target/operator_motion.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

MappedTarget target_at(double angle, double rate) {
  return {{angle, 2 * angle, -angle}, {rate, 2 * rate, -rate}, angle > 0.5};
}

std::filesystem::path log_file(const char* name) {
  return std::filesystem::temp_directory_path() /
         (std::string("twinarm_") + std::to_string(getpid()) + "_" + name);
}

bool same_bits(const OperatorSample& a, const OperatorSample& b) {
  return std::memcmp(a.theta.data(), b.theta.data(), sizeof a.theta) == 0 &&
         std::memcmp(a.theta_dot.data(), b.theta_dot.data(), sizeof a.theta_dot) == 0 &&
         a.button == b.button;
}

}  // namespace

TEST_CASE("device motion: a step is extrapolated with the newest rate; without renewal it stops") {
  const OperatorMapping mapping;
  DeviceMotion hand(8);
  CHECK(hand.sample(3, 4).theta[0] == 0);
  hand.set(target_at(0.2, 3), 1, 0.01);
  const auto angle = [&](double t, double toward) {
    return mapping.robot_angle(hand.sample(t, toward), 0);
  };
  const auto rate = [&](double t, double toward) {
    return mapping.robot_rate(hand.sample(t, toward), 0);
  };
  CHECK(angle(1, 1.01) == 0.2);
  CHECK(angle(1.01, 1) == doctest::Approx(0.23).epsilon(1e-14));
  CHECK(rate(1, 1.01) == 3);
  CHECK(rate(1.01, 1) == 3);     // the step's end, from inside
  CHECK(rate(1.01, 1.02) == 0);  // from a step without data
  CHECK(angle(5, 6) == doctest::Approx(0.23).epsilon(1e-14));
  CHECK(angle(0.5, 0.6) == 0.2);
  CHECK(rate(0.5, 0.6) == 0);
}

TEST_CASE("device motion: at a jump each side has its own angle") {
  const OperatorMapping mapping;
  DeviceMotion hand(8);
  hand.set(target_at(0, 0), 0, 0.01);
  hand.set(target_at(1, 0), 0.01, 0.01);
  CHECK(mapping.robot_angle(hand.sample(0.01, 0), 1) == 0);
  CHECK(mapping.robot_angle(hand.sample(0.01, 0.02), 1) == 2);
  CHECK(hand.sample(0.01, 0.02).button);
  CHECK_FALSE(hand.sample(0.01, 0).button);
}

TEST_CASE("device motion: with delay it is unchanged, as far back as it is stored") {
  auto live = std::make_unique<DeviceMotion>(200);
  DeviceMotion& hand = *live;
  const DelayedMotion late(std::move(live), 0.1, 1);
  for (int n = 0; n < 500; ++n) {
    const double t = 0.001 * n;
    hand.set(target_at(std::sin(t), std::cos(t)), t, 0.001);
    if (n < 100) continue;
    const double seen = OperatorMapping{}.robot_angle(late.sample(t, t + 0.001), 0);
    CHECK(std::abs(seen - std::sin(t - 0.1)) < 1e-6);
  }
}

TEST_CASE("motion log: written and read again it is bit-identical at every instant") {
  std::mt19937 random(4);
  std::normal_distribution<double> draw;
  DeviceMotion live(1000);
  std::string text = device_log_header();
  double t = 0.1;
  for (int n = 0; n < 300; ++n) {
    const double h = 0.001 * (1 + n % 3);
    live.set(target_at(draw(random), 100 * draw(random)), t, h);
    text += device_log_line(live.newest());
    t += h;
  }
  const auto file = log_file("log.csv");
  write_whole_file(file, text);
  CHECK(is_device_log(file));
  const auto again = read_device_log(file);
  std::filesystem::remove(file);
  CHECK(again->duration() == live.duration());
  for (double at = 0; at < 1.2; at += 0.00037) {
    REQUIRE(same_bits(live.sample(at, at + 1e-3), again->sample(at, at + 1e-3)));
    REQUIRE(same_bits(live.sample(at, at - 1e-3), again->sample(at, at - 1e-3)));
  }
}

TEST_CASE("motion log: an incomplete last line is ignored, every other error has its line") {
  DeviceMotion live(10);
  live.set(target_at(1, 2), 0, 0.001);
  const std::string line = device_log_line(live.newest());
  live.set(target_at(1, 2), 0.001, 0.001);
  const std::string second = device_log_line(live.newest());
  const auto file = log_file("torn.csv");
  const auto read = [&](const std::string& text) {
    write_whole_file(file, text);
    return read_device_log(file)->duration();
  };
  const auto fails_in_line = [&](const std::string& text, int number) {
    try {
      read(text);
    } catch (const InputError& error) {
      CHECK(error.faults().front().line == number);
      return;
    }
    FAIL("accepted");
  };
  CHECK(read(device_log_header() + line + second) == 0.002);
  CHECK(read(device_log_header() + line + second.substr(0, 30)) == 0.001);
  fails_in_line(device_log_header() + line + line, 3);
  fails_in_line(device_log_header() + line + "nan" + second, 3);
  fails_in_line(device_log_header() + "0,0" + line.substr(7), 2);
  fails_in_line(device_log_header(), 0);
  fails_in_line("t[s],theta1[rad]\n0,1\n", 1);
  std::filesystem::remove(file);
}

}  // namespace twinarm
