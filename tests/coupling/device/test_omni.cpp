// The Omni's kinematics against the published formulas (implemented again on complex numbers), and
// for consistency.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>

#include "coupling/device/omni.h"
#include "tests/coupling/device/virtual_omni_tries.h"

using namespace twinarm;
using twinarm::testing::omni_torque;

namespace {

// The published forward kinematics: theta3 is absolute there.
template <class T>
std::array<T, 3> published_point(const OmniParameters& o, T t1, T t2, T t3) {
  using std::cos;
  using std::sin;
  const T R = o.L1 * cos(t2) + o.L2 * sin(t3);
  return {-sin(t1) * R, o.L1 * sin(t2) - o.L2 * cos(t3) + o.lift, cos(t1) * R - o.back};
}

class OmniDraw {
 public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  OmniAngles in_range(const OmniParameters& o) {
    OmniAngles q;
    for (std::size_t j = 0; j < 6; ++j) q[j] = (*this)(o.lower[j], o.upper[j]);
    return q;
  }
  Vector3 vector(double size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }

 private:
  std::mt19937_64 engine_{9};
};

OmniAngles with_arm(const std::array<double, 3>& arm) {
  return {arm[0], arm[1], arm[2]};
}

double waist_lever(const OmniParameters& o, const OmniAngles& q) {
  return o.L1 * std::cos(q[1]) + o.L2 * std::sin(q[1] + q[2]);
}

}  // namespace

TEST_CASE("Omni: at zero the point is at (0, -0.110, -0.035) m; the formula is the published one") {
  OmniParameters o;
  CHECK((omni_position(o, {}) - Vector3(0, -0.110, -0.035)).norm() < 1e-15);
  OmniDraw draw;
  for (int n = 0; n < 2000; ++n) {
    o.L2 = draw(0.1, 0.2);  // different lengths, to detect exchanged ones
    const OmniAngles q = draw.in_range(o);
    const auto p = published_point(o, q[0], q[1], q[1] + q[2]);
    CHECK_UNARY((omni_position(o, q) - Vector3(p[0], p[1], p[2])).norm() < 1e-15);
    // Distances elbow - point and elbow - shoulder.
    const Vector3 elbow = omni_elbow(o, q);
    CHECK_UNARY(std::abs((omni_position(o, q) - elbow).norm() - o.L2) < 1e-15);
    CHECK_UNARY(std::abs((elbow - Vector3(0, o.lift, -o.back)).norm() - o.L1) < 1e-15);
  }
}

TEST_CASE("Omni: the Jacobian is the complex-step derivative; det J = -L1 L2 R cos(theta3)") {
  OmniParameters o;
  OmniDraw draw;
  double worst = 0, worst_det = 0;
  for (int n = 0; n < 2000; ++n) {
    o.L2 = draw(0.1, 0.2);
    const OmniAngles q = draw.in_range(o);
    const Matrix3 J = omni_jacobian(o, q);
    for (int j = 0; j < 3; ++j) {
      using C = std::complex<double>;
      constexpr double e = 1e-30;
      C t[3] = {q[0], q[1], q[2]};
      t[j] += C(0, e);
      const auto p = published_point(o, t[0], t[1], t[1] + t[2]);
      for (int i = 0; i < 3; ++i)
        worst = std::max(worst, std::abs(J(i, j) - p[static_cast<std::size_t>(i)].imag() / e));
    }
    const double det = -o.L1 * o.L2 * waist_lever(o, q) * std::cos(q[2]);
    worst_det = std::max(worst_det, std::abs(J.determinant() - det));
  }
  CHECK(worst < 1e-15);
  CHECK(worst_det < 1e-17);
}

TEST_CASE("Omni: motors do the work of the force; force and torque are inverse to each other") {
  const OmniParameters o;
  OmniDraw draw;
  double work = 0, back = 0;
  for (int n = 0; n < 2000; ++n) {
    const OmniAngles q = draw.in_range(o);
    if (std::abs(waist_lever(o, q)) < 0.01) continue;
    const Vector3 F = draw.vector(3);
    const auto tau = omni_torque(o, q, F);
    // Virtual work by central differences of the position: tau . dq = F . dx. theta3 is relative:
    // the motor of theta2 has tau2 + tau3 of the published, absolute angles.
    for (std::size_t j = 0; j < 3; ++j) {
      constexpr double e = 1e-4;
      OmniAngles a = q, b = q, c = q, d = q;
      a[j] -= 2 * e, b[j] -= e, c[j] += e, d[j] += 2 * e;
      const Vector3 slope = (omni_position(o, a) - 8 * omni_position(o, b) +
                             8 * omni_position(o, c) - omni_position(o, d)) /
                            (12 * e);
      work = std::max(work, std::abs(tau[j] - F.dot(slope)));
    }
    back = std::max(back, (omni_force(o, q, tau) - F).norm());
  }
  CHECK(work < 1e-10);
  CHECK(back < 1e-12);
}

TEST_CASE("Omni: motors are limited together, to 3.3 N at the stylus") {
  const OmniParameters o;
  OmniDraw draw;
  const OmniAngles q{0.3, 0.6, 0.2, 0, 0, 0};
  for (int n = 0; n < 500; ++n) {
    const Vector3 F = draw.vector(8);
    const Vector3 limited = omni_force(o, q, omni_limit(o, q, omni_torque(o, q, F)));
    CHECK_UNARY((limited.normalized() - F.normalized()).norm() < 1e-12);
    CHECK_UNARY(std::abs(limited.norm() - std::min(F.norm(), 3.3)) < 1e-12);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(omni_limit(o, q, {0.1, nan, 0}) == std::array<double, 3>{});
  // On the waist's axis its motor exerts no force.
  OmniParameters even = o;
  const double t2 = 1.2;
  const OmniAngles on_axis{0.4, t2, t2 - std::numbers::pi / 2 - t2, 0, 0, 0};  // sin t3 = -cos t2
  CHECK(std::abs(waist_lever(even, on_axis)) < 1e-15);
  CHECK(omni_force(even, on_axis, {1, 0, 0}) == Vector3(0, 0, 0));
}

TEST_CASE("Omni: FK(IK(p)) = p to 1e-12 at every reachable point, also at the workspace boundary") {
  OmniParameters o;
  OmniDraw draw;
  double worst = 0;
  int reached = 0, refused = 0;
  for (int n = 0; n < 20000; ++n) {
    o.L2 = n % 2 == 0 ? o.L1 : draw(0.1, 0.2);
    // Within a sphere about the shoulder, some at the boundary.
    const double r = n % 7 == 0   ? o.L1 + o.L2
                     : n % 7 == 1 ? std::abs(o.L1 - o.L2)
                     : n % 7 == 2 ? (o.L1 + o.L2) * (1 - draw(0, 1e-9))
                                  : draw(0, o.L1 + o.L2 + 0.05);
    const Vector3 p = r * draw.vector(1).normalized() + Vector3(0, o.lift, -o.back);
    const auto q = omni_inverse(o, p);
    const bool edge = n % 7 < 2;
    if (!q) {
      CHECK_UNARY(edge || r > o.L1 + o.L2 || r < std::abs(o.L1 - o.L2));
      ++refused;
      continue;
    }
    CHECK_UNARY(edge || (r <= o.L1 + o.L2 + 1e-13 && r >= std::abs(o.L1 - o.L2) - 1e-13));
    worst = std::max(worst, (omni_position(o, with_arm(*q)) - p).norm());
    ++reached;
  }
  CHECK(worst < 1e-12);
  CHECK(reached > 10000);
  CHECK(refused > 1000);
  CHECK_FALSE(omni_inverse(o, Vector3(std::numeric_limits<double>::quiet_NaN(), 0, 0)).has_value());
}

TEST_CASE("Omni: IK(FK(q)) = q within the ranges if and only if R > 0") {
  const OmniParameters o;
  OmniDraw draw;
  double worst = 0;
  int beyond = 0;
  for (int n = 0; n < 20000; ++n) {
    const OmniAngles q = draw.in_range(o);
    const double R = waist_lever(o, q);
    const auto back = omni_inverse(o, omni_position(o, q));
    REQUIRE(back.has_value());
    double off = 0;
    for (std::size_t j = 0; j < 3; ++j) off = std::max(off, std::abs((*back)[j] - q[j]));
    if (R > 1e-3) worst = std::max(worst, off);
    if (R < 0) {
      CHECK_UNARY(off > 1);  // the other waist solution
      ++beyond;
    }
  }
  CHECK(worst < 1e-11);
  CHECK(beyond > 0);  // a corner of the ranges is beyond the waist's axis
}

TEST_CASE(
    "Omni: the pose of the stylus rotates with each joint about that joint's axis, and back") {
  const OmniParameters o;
  OmniDraw draw;
  double turned = 0, back = 0, angles = 0;
  for (int n = 0; n < 3000; ++n) {
    const OmniAngles q = draw.in_range(o);
    const Pose X = omni_stylus(o, q);
    CHECK_UNARY((X.R.transpose() * X.R - Matrix3::Identity()).norm() < 1e-14);
    CHECK_UNARY((X.p - omni_position(o, q)).norm() == 0);
    // Geometric axes: waist down, arm and forearm about the waist's side, yaw along the forearm,
    // roll along the stylus; each joint adds a rotation about its axis.
    const Vector3 side(std::cos(q[0]), 0, std::sin(q[0]));
    const Vector3 along = (X.p - omni_elbow(o, q)).normalized();
    const Vector3 axis[6] = {-Vector3::UnitY(), -side, -side, along, Vector3::Zero(), X.R.col(2)};
    for (std::size_t j = 0; j < 6; ++j) {
      if (j == 4) continue;
      OmniAngles more = q;
      more[j] += 0.3;
      const Matrix3 expected = Eigen::AngleAxisd(0.3, axis[j]) * X.R;
      turned = std::max(turned, (omni_stylus(o, more).R - expected).norm());
    }
    // Pitch: the angle between stylus and forearm.
    CHECK_UNARY(std::abs(X.R.col(2).dot(along) - std::sin(q[4] - o.gimbal_pitch)) < 1e-14);
    if (waist_lever(o, q) < 1e-3) continue;
    const auto found = omni_inverse(o, X);
    REQUIRE(found.has_value());
    back = std::max(back, (omni_stylus(o, *found).R - X.R).norm());
    const bool folded = q[4] < -0.49;  // yaw and roll are not unique there
    for (std::size_t j = 0; j < 6; ++j)
      if (!folded) angles = std::max(angles, std::abs((*found)[j] - q[j]));
  }
  CHECK(turned < 1e-14);
  CHECK(back < 1e-11);
  CHECK(angles < 1e-10);
  OmniParameters square = o;
  square.gimbal_pitch = 0;
  OmniAngles lock{0.1, 0.5, 0.1, 0.4, -std::numbers::pi / 2, 0.7};  // the stylus along the forearm
  const auto found = omni_inverse(square, omni_stylus(square, lock));
  REQUIRE(found.has_value());
  CHECK((omni_stylus(square, *found).R - omni_stylus(square, lock).R).norm() < 1e-12);
}

TEST_CASE("Omni: no sampled pose within the ranges is nearer than the nearest point found") {
  const OmniParameters o;
  OmniDraw draw;
  for (int n = 0; n < 60; ++n) {
    const Vector3 p = draw.vector(0.35) + Vector3(0, 0, -o.back);
    const auto q = omni_nearest(o, p);
    const OmniAngles theta = with_arm(q);
    const double distance = (omni_position(o, theta) - p).norm();
    for (std::size_t j = 0; j < 3; ++j) CHECK_UNARY(q[j] >= o.lower[j] && q[j] <= o.upper[j]);
    double best = 1e9;
    for (int k = 0; k < 4000; ++k)
      best = std::min(best, (omni_position(o, draw.in_range(o)) - p).norm());
    // Small steps about the solution, within the ranges: a minimum.
    for (int k = 0; k < 300; ++k) {
      OmniAngles near = theta;
      for (std::size_t j = 0; j < 3; ++j)
        near[j] = std::clamp(near[j] + draw(-1e-3, 1e-3), o.lower[j], o.upper[j]);
      best = std::min(best, (omni_position(o, near) - p).norm());
    }
    CHECK_UNARY(distance <= best + 1e-12);
  }
  for (int n = 0; n < 2000; ++n) {  // a reachable point is its own nearest point
    const Vector3 p = omni_position(o, draw.in_range(o));
    CHECK_UNARY((omni_position(o, with_arm(omni_nearest(o, p))) - p).norm() < 1e-12);
  }
}
