// Limits of virtual walls by bisection of simulations, against eigenvalues of the sampled system
// and the frequency response of the wall.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "coupling/device/passivity.h"
#include "solver/linear_algebra/dense_algebra.h"

using namespace twinarm;

namespace {

// State (x, v, x a tick ago, ...); A by e^(F T) with the hold, by a separate series.
double radius_of_walled(const SampledDevice& d, double K, double B) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();  // d/dt (x, v, force)
  F(0, 1) = 1;
  F(1, 1) = -d.damping / d.mass;
  F(1, 2) = 1 / d.mass;
  Eigen::Matrix3d power = Eigen::Matrix3d::Identity(), sum = power;
  for (int k = 1; k < 30; ++k) sum += power = power * F * d.tick() / k;
  const Eigen::Index n = 3 + d.delay;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  const auto past = [&](int ago) { return ago == 0 ? 0 : 1 + ago; };  // index of delayed x
  for (Eigen::Index row = 0; row < 2; ++row) {
    A(row, 0) += sum(row, 0);
    A(row, 1) += sum(row, 1);
    A(row, past(d.delay)) -= sum(row, 2) * (K + B / d.tick());
    A(row, past(d.delay + 1)) += sum(row, 2) * B / d.tick();
  }
  A(2, 0) = 1;
  for (Eigen::Index row = 3; row < n; ++row) A(row, row - 1) = 1;
  return eigenvalues_of(A).cwiseAbs().maxCoeff();
}

double exact_stiffness(const SampledDevice& d, double B) {
  double low = 1e-3, high = 1e7;
  for (int n = 0; n < 60; ++n) {
    const double K = std::sqrt(low * high);
    (radius_of_walled(d, K, B) < 1 ? low : high) = K;
  }
  return low;
}

// Colgate and Schenkel: b > (T/2)/(1 - cos wT) Re{(1 - e^-jwT) H(e^jwT)} at all frequencies.
double needed_damping(const SampledDevice& d, double K, double B) {
  double most = 0;
  for (int n = 1; n <= 20000; ++n) {
    const double wT = std::numbers::pi * n / 20000;
    const std::complex<double> back = std::polar(1.0, -wT);
    const std::complex<double> H =
        (K + B / d.tick() * (1.0 - back)) * std::polar(1.0, -wT * d.delay);
    most = std::max(most, d.tick() / 2 / (1 - std::cos(wT)) * ((1.0 - back) * H).real());
  }
  return most;
}

SampledDevice sampled(double m, double b, double rate, int delay) {
  SampledDevice d;
  d.mass = m;
  d.damping = b;
  d.rate = rate;
  d.delay = delay;
  return d;
}

}  // namespace

TEST_CASE("uncoupled stability: the published device's limits, 2152.5 and 715.7 N/m") {
  const SampledDevice now = sampled(0.045, 0.1, 1000, 0), late = sampled(0.045, 0.1, 1000, 1);
  CHECK(exact_stiffness(now, 1) == doctest::Approx(2152.5).epsilon(1e-4));
  CHECK(exact_stiffness(late, 1) == doctest::Approx(715.7).epsilon(1e-4));
  CHECK(uncoupled_stiffness(now, 1) == doctest::Approx(2200));
  CHECK(uncoupled_stiffness(late, 1) == doctest::Approx(733.33).epsilon(1e-5));
  CHECK(max_stable_stiffness(now, 1) == doctest::Approx(2152.5).epsilon(1e-3));
  CHECK(max_stable_stiffness(late, 1) == doctest::Approx(715.7).epsilon(1e-3));
}

TEST_CASE("uncoupled stability by bisection agrees with eigenvalues, by damping, delay, rate") {
  for (const double rate : {500.0, 1000.0, 4000.0})
    for (const int delay : {0, 1, 3})
      for (const double b : {0.0, 0.1, 2.0})
        for (const double B : {0.5, 3.0}) {
          const SampledDevice d = sampled(0.045, b, rate, delay);
          CAPTURE(rate);
          CAPTURE(delay);
          CAPTURE(b);
          CAPTURE(B);
          CHECK(max_stable_stiffness(d, B) == doctest::Approx(exact_stiffness(d, B)).epsilon(2e-3));
        }
}

TEST_CASE("a wall is passive up to Colgate's limit, and not beyond it") {
  for (const double rate : {500.0, 1000.0, 4000.0})
    for (const double part : {-0.9, -0.3, 0.0, 0.2, 0.7}) {
      const SampledDevice d = sampled(0.045, 0.5, rate, 0);
      const double B = part * d.damping, law = colgate_stiffness(d, B);
      CAPTURE(rate);
      CAPTURE(part);
      CHECK(law == doctest::Approx(2 * (0.5 - std::abs(B)) * rate));
      CHECK(max_passive_stiffness(d, B) == doctest::Approx(law).epsilon(1e-3));
    }
  const SampledDevice d = sampled(0.045, 0.5, 1000, 0);
  CHECK(max_passive_damping(d, 0) == doctest::Approx(0.5).epsilon(1e-3));
}

TEST_CASE("with delay the passive limit is that of the frequency response") {
  for (const int delay : {1, 2, 5})
    for (const double B : {0.0, 0.05, 0.2}) {
      const SampledDevice d = sampled(0.045, 0.5, 1000, delay);
      CAPTURE(delay);
      CAPTURE(B);
      const double K = max_passive_stiffness(d, B);
      if (needed_damping(d, 1e-9, B) > d.damping) {
        CHECK(K == 0);
        continue;
      }
      CHECK(needed_damping(d, K, B) == doctest::Approx(d.damping).epsilon(2e-3));
      if (B == 0) CHECK(K == doctest::Approx(colgate_stiffness(d, 0)).epsilon(2e-3));
    }
}

TEST_CASE("encoder quantisation reduces the stiffness: 2 f_c/Delta for small friction") {
  SampledDevice d = sampled(0.045, 2.0, 1000, 0);
  d.resolution = 0.055e-3;
  for (const double friction : {0.02, 0.05, 0.26}) {
    d.friction = friction;
    CAPTURE(friction);
    CHECK(abbott_okamura_stiffness(d) ==
          doctest::Approx(std::min(4000.0, 2 * friction / 0.055e-3)));
    CHECK(max_passive_stiffness(d, 0) ==
          doctest::Approx(abbott_okamura_stiffness(d)).epsilon(0.02));
  }
  d.friction = 0;
  CHECK(max_passive_stiffness(d, 0) < 10);  // almost none, limited by the smallest amplitude tried
}

TEST_CASE("a passive wall is stable, but not conversely") {
  const SampledDevice d = sampled(0.045, 0.1, 1000, 0);
  for (const double B : {0.0, 0.03, 0.08}) {
    CHECK(max_passive_stiffness(d, B) < max_stable_stiffness(d, B));
    CHECK(is_stable(d, max_passive_stiffness(d, B), B));
  }
  CHECK(is_stable(d, 100, 10 * max_passive_damping(d, 100)));
}
