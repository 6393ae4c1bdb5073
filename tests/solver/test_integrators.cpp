// Fixed-step integrators against golden numbers of an independent code (docs/cases.md, G1), their
// order, and the elliptic functions of a pendulum (B2).
#include <doctest/doctest.h>

#include <array>
#include <numbers>

#include "tests/solver/pendulum.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kRight = std::numbers::pi / 2;
constexpr double kExactAngle = -1.4050273115247991;  // t = 1 s, released at 90 degrees

double error_at_one_second(Integrator integrator, double h) {
  return std::abs(swing(kRight, 0, integrator, h, 1).q[0] - kExactAngle);
}

}  // namespace

TEST_CASE("a pendulum from 90 degrees, 100 steps of 10 ms, meets the golden numbers to 1e-12") {
  struct Row {
    Integrator integrator;
    double angle, rate;
  };
  const Row rows[] = {
      {Integrator::euler, -1.4542586468839336, -1.910991855901703},
      {Integrator::semi_implicit, -1.4140239721507901, -1.7993332855089053},
      {Integrator::rk4, -1.4050273031405154, -1.7993090484649084},
  };
  for (const Row& row : rows) {
    CAPTURE(static_cast<int>(row.integrator));
    const State<double> x = swing(kRight, 0, row.integrator, 0.01, 1);
    CHECK(std::abs(x.q[0] - row.angle) < 1e-12);
    CHECK(std::abs(x.qd[0] - row.rate) < 1e-12);
    CHECK(std::abs(x.t - 1) < 1e-12);
  }
}

TEST_CASE("pendulum: error falls by 2 when h halves (euler, semi-implicit), by 16 (rk4)") {
  const auto order = [](Integrator integrator, double h) {
    return std::log2(error_at_one_second(integrator, h) / error_at_one_second(integrator, h / 2));
  };
  for (double h : {0.01, 0.005}) {
    CHECK(std::abs(order(Integrator::euler, h) - 1) < 0.05);
    CHECK(std::abs(order(Integrator::semi_implicit, h) - 1) < 0.05);
    CHECK(std::abs(order(Integrator::rk4, h) - 4) < 0.1);
  }
}

TEST_CASE("a pendulum under rk4 of 1 ms stays on the elliptic functions to 1e-8 for 10 s") {
  struct Point {
    double t, angle, rate;
  };
  struct Start {
    double angle, rate;
    std::array<Point, 3> at;
  };
  const Start starts[] = {
      {kRight,
       0,
       {{{2, 0.91664758966324498, 3.4552068990593298},
         {5, 1.2294518114853856, -2.5627875681926295},
         {10, 0.27868067356998295, -4.3431606928646831}}}},
      {0,
       7,
       {{{1, 4.473047569255259, 4.97280872715857},
         {5, 24.034171071638475, 6.1890668358243134},
         {10, 48.281206715247911, 4.6364559915916713}}}},
  };
  for (const Start& start : starts)
    for (const Point& point : start.at) {
      CAPTURE(point.t);
      const State<double> x = swing(start.angle, start.rate, Integrator::rk4, 0.001, point.t);
      CHECK(std::abs(x.q[0] - point.angle) < 1e-8);
      CHECK(std::abs(x.qd[0] - point.rate) < 1e-8);
    }
}

TEST_CASE("a pendulum on the separatrix nears the top as 4 atan(exp(w t)) - pi") {
  const double w = std::sqrt(9.81);
  for (double t : {0.25, 0.5, 1.0}) {
    const double exact = 4 * std::atan(std::exp(w * t)) - std::numbers::pi;
    CHECK(std::abs(swing(0, 2 * w, Integrator::rk4, 0.001, t).q[0] - exact) < 1e-8);
  }
}

TEST_CASE("energy of a pendulum: bounded when semi-implicit, grows under explicit Euler") {
  const Model<double> model = pendulum();
  const auto drift = [&](Integrator integrator) {  // after 100 s at 10 ms, from rest at height 0
    const State<double> x = swing(kRight, 0, integrator, 0.01, 100);
    return 0.5 * x.qd[0] * x.qd[0] - 9.81 * std::cos(x.q[0]);
  };
  CHECK(drift(Integrator::euler) == doctest::Approx(48.11).epsilon(1e-3));
  CHECK(drift(Integrator::semi_implicit) == doctest::Approx(-0.03523).epsilon(1e-3));
  CHECK(drift(Integrator::rk4) == doctest::Approx(-7.125e-07).epsilon(1e-3));
}
