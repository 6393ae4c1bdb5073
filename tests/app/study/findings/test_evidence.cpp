#include "app/study/findings/findings.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

using namespace twinarm;

namespace {

constexpr auto kOffset = PaperStatement::Share::offset_of_joint2;
constexpr auto kNear = PaperStatement::Share::near_reversals;

// Three sweeps of 1 s to and fro, both joints, with this error of the robot [rad].
TrackingSeries series(const std::function<double(double t)>& error) {
  TrackingSeries s;
  s.q_K.resize(2);
  s.q_D.resize(2);
  for (int n = 0; n < 3000; ++n) {
    const double t = 1e-3 * n, in_sweep = t - std::floor(t);
    const double q = std::fmod(std::floor(t), 2) == 0 ? in_sweep : 1 - in_sweep;
    s.t.push_back(t);
    for (std::size_t j = 0; j < 2; ++j) {
      s.q_K[j].push_back(q);
      s.q_D[j].push_back(q - error(t));
    }
  }
  return s;
}

}  // namespace

TEST_CASE("a lag that keeps its sign within each sweep is an offset, ringing about zero is not") {
  const auto sign = [](double t) { return std::fmod(std::floor(t), 2) == 0 ? 1.0 : -1.0; };
  CHECK(share_of(kOffset, series([&](double t) { return 0.1 * sign(t); })) ==
        doctest::Approx(1).epsilon(1e-3));
  CHECK(share_of(kOffset, series([](double t) { return std::sin(2 * std::numbers::pi * 5 * t); })) <
        0.01);
  // c + sin: the mean is c, that of its size (2/pi) (c asin c + sqrt(1 - c^2)).
  const double c = 0.5;
  CHECK(share_of(kOffset,
                 series([&](double t) { return c + std::sin(2 * std::numbers::pi * 5 * t); })) ==
        doctest::Approx(c / (2 / std::numbers::pi * (c * std::asin(c) + std::sqrt(1 - c * c))))
            .epsilon(1e-3));
}

TEST_CASE("an error after changes of direction only has the share 1, a constant one one half") {
  CHECK(share_of(kNear, series([](double t) { return t - std::floor(t) < 0.2 ? 0.1 : 0.0; })) == 1);
  CHECK(share_of(kNear, series([](double) { return 0.1; })) == doctest::Approx(0.5));
  // e^(-t/T) within a sweep of 1 s: mean of the first quarter over the sum of both means.
  const double T = 0.25, first = (1 - std::exp(-1)) / 0.25,
               rest = (std::exp(-1) - std::exp(-4)) / 0.75;
  CHECK(share_of(kNear, series([&](double t) { return std::exp(-(t - std::floor(t)) / T); })) ==
        doctest::Approx(first / (first + rest)).epsilon(0.01));
}

TEST_CASE("tremor of a degree is no change of direction") {
  TrackingSeries s = series([](double t) { return t - std::floor(t) < 0.2 ? 0.1 : 0.0; });
  for (std::size_t n = 0; n < s.t.size(); ++n)
    for (std::size_t j = 0; j < 2; ++j) {
      const double tremor = 0.5 * kDegree * std::sin(2 * std::numbers::pi * 10 * s.t[n]);
      s.q_K[j][n] += tremor;
      s.q_D[j][n] += tremor;
    }
  CHECK(share_of(kNear, s) > 0.98);
}

TEST_CASE("a share between the bounds of a statement leaves it open") {
  const PaperStatement& offset = statement_on("E3");
  CHECK(verdict_of(offset, 0.3) == Verdict::contradicts);
  CHECK(verdict_of(offset, 0.5) == Verdict::open);
  CHECK(verdict_of(offset, 0.7) == Verdict::agrees);
  CHECK(std::string(statement_on("E4-text").figure) == "7d");
}
