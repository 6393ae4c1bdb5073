// Operator motions: the paper's automatic motion, the mapping from device to robot, the synthetic
// operator.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "coupling/target/operator_motion.h"
#include "coupling/target/synthetic_operator.h"
#include "solver/spatial/scalar.h"

using namespace twinarm;

namespace {}

TEST_CASE("the automatic motion sweeps joint 1 from 90 to -90, joint 2 from -45 to 45 degrees") {
  const OperatorMapping mapping;
  for (const double T : {1.0, 0.87}) {
    const AutomaticMotion hand(mapping, T);
    CHECK(hand.duration() == doctest::Approx(3 * T));
    struct Row {
      double s, joint1_deg, joint2_deg, direction;
    };
    const Row rows[] = {{0.25, 45, -22.5, 1}, {0.5, 0, 0, 1},        {1.25, -45, 22.5, -1},
                        {1.5, 0, 0, -1},      {1.75, 45, -22.5, -1}, {2.9, -72, 36, 1}};
    for (const Row& row : rows)
      for (const double toward : {-1e-3, 1e-3}) {
        const OperatorSample x = hand.sample(row.s * T, row.s * T + toward);
        CHECK(mapping.robot_angle(x, 0) == doctest::Approx(row.joint1_deg * kDegree));
        CHECK(mapping.robot_angle(x, 1) == doctest::Approx(row.joint2_deg * kDegree));
        CHECK(mapping.robot_angle(x, 2) == 0);
        CHECK(mapping.robot_rate(x, 0) == doctest::Approx(-row.direction * 180 * kDegree / T));
        CHECK(mapping.robot_rate(x, 1) == doctest::Approx(row.direction * 90 * kDegree / T));
        CHECK(mapping.robot_rate(x, 2) == 0);
        CHECK_FALSE(x.button);
      }
  }
}

TEST_CASE("at a velocity jump of the automatic motion the rate is one-sided") {
  const OperatorMapping mapping;
  const AutomaticMotion hand(mapping);
  const auto rate1 = [&](double t, double toward) {  // of joint 1, in sweeps of 180 deg/s
    return mapping.robot_rate(hand.sample(t, toward), 0) / (180 * kDegree);
  };
  for (const double h : {1e-3, 1.0 / 60, 0.2}) {
    CHECK(rate1(0, h) == doctest::Approx(-1));
    CHECK(rate1(1, 1 - h) == doctest::Approx(-1));
    CHECK(rate1(1, 1 + h) == doctest::Approx(1));
    CHECK(rate1(2, 2 - h) == doctest::Approx(1));
    CHECK(rate1(2, 2 + h) == doctest::Approx(-1));
    CHECK(rate1(3, 3 - h) == doctest::Approx(-1));
    CHECK(rate1(3, 3 + h) == 0);  // after the motion
  }
  // A velocity jump that is met within rounding.
  double t = 0;
  for (int n = 0; n < 1000; ++n) t += 1e-3;
  CHECK(t != 1);
  CHECK(rate1(t, t + 1e-3) == doctest::Approx(1));
  CHECK(rate1(t, t - 1e-3) == doctest::Approx(-1));
  for (const double s : {0.0, 1.0, 2.0, 3.0})  // no jump of the angle
    CHECK(mapping.robot_angle(hand.sample(s, s - 1e-3), 0) ==
          doctest::Approx(mapping.robot_angle(hand.sample(s, s + 1e-3), 0)));
}

TEST_CASE("theta1, theta4, theta6 of the device move joints 1, 2, 3, by gain and offset") {
  OperatorMapping mapping;
  mapping.gain = {2, -0.5, 3};
  mapping.offset = {0.1, 0.2, -0.3};
  OperatorSample hand;
  hand.theta = {0.5, 9, 9, -0.4, 9, 0.7};
  hand.theta_dot = {1, 9, 9, 2, 9, -3};
  CHECK(mapping.robot_angle(hand, 0) == doctest::Approx(1.1));
  CHECK(mapping.robot_angle(hand, 1) == doctest::Approx(0.4));
  CHECK(mapping.robot_angle(hand, 2) == doctest::Approx(1.8));
  CHECK(mapping.robot_rate(hand, 0) == doctest::Approx(2));
  CHECK(mapping.robot_rate(hand, 1) == doctest::Approx(-1));
  CHECK(mapping.robot_rate(hand, 2) == doctest::Approx(-9));
  for (std::size_t j = 0; j < 3; ++j) {
    mapping.set_robot_angle(hand, j, 0.77, -0.33);
    CHECK(mapping.robot_angle(hand, j) == doctest::Approx(0.77));
    CHECK(mapping.robot_rate(hand, j) == doctest::Approx(-0.33));
  }
  // Joint 1 of the robot reaches 90 degrees within the Omni's +-0.98 rad.
  CHECK(OperatorMapping{}.gain[0] * 0.98 > 90 * kDegree);
}

TEST_CASE("synthetic operator: deterministic by seed, different for other seeds") {
  const SyntheticOperator a(7), b(7), c(8);
  bool differs = false;
  for (int n = 0; n <= 4000; ++n) {
    const double t = 0.005 * n;
    const OperatorSample x = a.sample(t, t + 1), y = b.sample(t, t + 1), z = c.sample(t, t + 1);
    CHECK_UNARY(std::memcmp(x.theta.data(), y.theta.data(), sizeof x.theta) == 0);
    CHECK_UNARY(std::memcmp(x.theta_dot.data(), y.theta_dot.data(), sizeof x.theta_dot) == 0);
    CHECK_UNARY(x.button == y.button);
    for (std::size_t j = 0; j < 6; ++j)
      differs = differs || std::abs(x.theta[j] - z.theta[j]) > 0.1;
  }
  CHECK(differs);
  CHECK(a.duration() == 20);
  CHECK(a.description().find("not a person") != std::string::npos);
}

TEST_CASE("synthetic operator: theta_dot is the derivative of theta, within the Omni's ranges") {
  // docs/understand/phantom_omni.md: theta1, theta2, theta3, yaw, pitch, roll of the device [rad].
  constexpr double low[] = {-0.98, 0, -0.81, -2.45, -0.5, -2.58};
  constexpr double high[] = {0.98, 1.75, 1.25, 2.45, 1.75, 2.58};
  for (const unsigned seed : {0u, 1u, 2u, 12345u}) {
    const SyntheticOperator hand(seed);
    double worst = 0, fastest = 0, slope = 0;
    bool inside = true, pressed = false;
    for (int n = 1; n < 9999; ++n) {
      const double t = 0.002 * n, e = 1e-5;
      const OperatorSample x = hand.sample(t, t), before = hand.sample(t - e, t),
                           after = hand.sample(t + e, t);
      pressed = pressed || x.button;
      for (std::size_t j = 0; j < 6; ++j) {
        slope = (after.theta[j] - before.theta[j]) / (2 * e);
        worst = std::max(worst, std::abs(slope - x.theta_dot[j]));
        fastest = std::max(fastest, std::abs(x.theta_dot[j]));
        inside = inside && x.theta[j] > low[j] && x.theta[j] < high[j];
      }
    }
    CHECK(worst < 1e-5);
    CHECK(fastest > 1);
    CHECK(fastest < 5);
    CHECK(inside);
    CHECK(pressed);
  }
}
