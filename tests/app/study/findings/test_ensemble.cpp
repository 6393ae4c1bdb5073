#include <doctest/doctest.h>

#include <cmath>

#include "app/study/findings/findings.h"
#include "coupling/target/synthetic_operator.h"

using namespace twinarm;

TEST_CASE("quantiles of 1 to 11, in any order, are those of a uniform distribution") {
  const Distribution d = distribution_of({7, 1, 11, 3, 9, 5, 2, 10, 4, 8, 6}, 4.5);
  CHECK(d.median == 6);
  CHECK(d.p10 == doctest::Approx(2));
  CHECK(d.p90 == doctest::Approx(10));
  CHECK(d.percentile == doctest::Approx(100 * 4.0 / 11));
}

TEST_CASE(
    "a published number below all values is at 0 %, above all at 100 %, equal ones count half") {
  CHECK(distribution_of({1, 2, 3, 4}, 0.5).percentile == 0);
  CHECK(distribution_of({1, 2, 3, 4}, 5).percentile == 100);
  CHECK(distribution_of({1, 2, 2, 4}, 2).percentile == 50);
}

TEST_CASE("unstable runs are infinite quantiles, not numbers that look measured") {
  const Distribution d = distribution_of({1, 2, HUGE_VAL, HUGE_VAL, HUGE_VAL}, 1.5);
  CHECK(std::isinf(d.p90));
  CHECK(std::isinf(d.median));
  CHECK(d.percentile == 20);
}

TEST_CASE("operators keep to the ranges from which they are drawn") {
  const SyntheticRanges ranges{{1, 2}, {1e-5, 1e-3}};
  double fastest = 0, slowest_tremor = 1, largest_tremor = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const SyntheticOperator hand(seed, 10, ranges);
    for (double t = 0; t < 10; t += 0.001)
      for (double rate : hand.sample(t, t).theta_dot) fastest = std::max(fastest, std::abs(rate));
    double tremor = 0;  // before the first reach, at 0.2 s or later, nothing else moves
    for (double t = 0; t < 0.2; t += 0.001)
      tremor = std::max(tremor, std::abs(hand.sample(t, t).theta_dot[0]));
    slowest_tremor = std::min(slowest_tremor, tremor);
    largest_tremor = std::max(largest_tremor, tremor);
  }
  const double of_tremor = 3 * 1e-3 * 2 * 3.1416 * 12;  // three sines at 12 Hz in phase
  CHECK(fastest > 1.8);
  CHECK(fastest < 2 + of_tremor);
  CHECK(largest_tremor > 20 * slowest_tremor);
  CHECK(largest_tremor < of_tremor);
}
