// Newton's method for f on the unit sphere and on the unit circle. With n' n = 1, p(n) the point of
// support (gradient of f in space) and f = n . p:
//   gradient along the sphere   P p,            P = 1 - n n'
//   Hessian along the sphere    P H P - f 1,    H = (A - a a')/alpha + (B - b b')/beta
// where alpha = sqrt(n' A n), a = A n / alpha, and so for B. P.-A. Absil, R. Mahony, R. Sepulchre,
// "Optimization algorithms on matrix manifolds", 2008, section 6.
#include "collision/narrow_phase/sphere_minimization.h"

#include <Eigen/Geometry>
#include <numbers>

namespace twinarm {
namespace {

constexpr int kMaxSteps = 60;
constexpr double kMaxStep = 0.4;       // [rad]
constexpr double kConverged = 1e-15;   // [rad]
constexpr double kTrustedStep = 1e-6;  // smaller steps are below the resolution of f [rad]

struct Local {
  Vector3 gradient = Vector3::Zero();  // point of support
  Matrix3 H = Matrix3::Zero();
};

void add(const Matrix3& Q, const Vector3& n, Local& local) {
  const Vector3 Qn = Q * n;
  const double square = n.dot(Qn);
  if (!(square > 1e-300)) return;
  const double alpha = std::sqrt(square);
  const Vector3 a = Qn / alpha;
  local.gradient += a;
  local.H += (Q - a * a.transpose()) / alpha;
}

Local at(const SupportSum& f, const Vector3& n) {
  Local local;
  local.gradient = f.c;
  add(f.A, n, local);
  add(f.B, n, local);
  return local;
}

// -|H|^-1 g for a symmetric 2 x 2 Hessian: a descent direction also where f is not convex.
Eigen::Vector2d downhill(double h00, double h01, double h11, const Eigen::Vector2d& g) {
  const double mean = 0.5 * (h00 + h11), half = 0.5 * (h00 - h11);
  const double r = std::sqrt(half * half + h01 * h01);
  const double scale = 1e-12 * (std::abs(mean) + r) + 1e-300;
  const double l0 = std::max(std::abs(mean + r), scale), l1 = std::max(std::abs(mean - r), scale);
  Eigen::Vector2d e0(1, 0);
  if (r > 0) e0 = half > 0 ? Eigen::Vector2d(half + r, h01) : Eigen::Vector2d(h01, r - half);
  e0.normalize();
  const Eigen::Vector2d e1(-e0.y(), e0.x());
  return -(e0 * (e0.dot(g) / l0) + e1 * (e1.dot(g) / l1));
}

Vector3 newton_step(const SupportSum& f, const Vector3& n) {
  const Local local = at(f, n);
  const double value = n.dot(local.gradient);
  const Vector3 u = n.unitOrthogonal(), w = n.cross(u);
  const Vector3 Hu = local.H * u, Hw = local.H * w;
  const Eigen::Vector2d s = downhill(u.dot(Hu) - value, u.dot(Hw), w.dot(Hw) - value,
                                     Eigen::Vector2d(u.dot(local.gradient), w.dot(local.gradient)));
  return s.x() * u + s.y() * w;
}

// Newton step on the circle; a descent direction also where f is not convex.
double newton_angle(const SupportSum& f, const Vector3& n, const Vector3& t) {
  const Local local = at(f, n);
  const double slope = t.dot(local.gradient);
  const double curvature = t.dot(local.H * t) - n.dot(local.gradient);
  return -slope / std::max(std::abs(curvature), 1e-12 * local.gradient.norm() + 1e-300);
}

// Halves the step until f(n + step) is less than `value`, and moves n there; false if it never is.
bool descend(const SupportSum& f, Vector3 step, Vector3& n, double& value) {
  for (int halving = 0; halving < 30; ++halving, step *= 0.5) {
    const Vector3 trial = (n + step).normalized();
    const double found = f(trial);
    if (!(found < value)) continue;
    n = trial, value = found;
    return true;
  }
  return false;
}

}  // namespace

Vector3 minimise_on_sphere(const SupportSum& f, const Vector3& start) {
  Vector3 n = start;
  double value = f(n);
  for (int k = 0; k < kMaxSteps; ++k) {
    Vector3 step = newton_step(f, n);
    const double length = step.norm();
    if (!(length > kConverged)) break;
    if (length > kMaxStep) step *= kMaxStep / length;
    if (length < kTrustedStep) {  // quadratic convergence
      n = (n + step).normalized();
      const Vector3 last = newton_step(f, n);
      if (last.norm() < kTrustedStep) n = (n + last).normalized();
      break;
    }
    if (!descend(f, step, n, value)) break;
  }
  return n;
}

void minimise_on_circle(const SupportSum& f, const Vector3& axis, bool is_deep,
                        std::vector<Vector3>& out) {
  const Vector3 u = axis.unitOrthogonal(), w = axis.cross(u);
  const auto direction = [&](double angle) {
    return Vector3(std::cos(angle) * u + std::sin(angle) * w);
  };
  if (f.A.isZero(0) && f.B.isZero(0)) {  // two lines, or a vertex and a side: one minimum
    const Vector3 across = f.c - axis * axis.dot(f.c);
    if (across.norm() > 0) out.push_back(-across.normalized());
    return;
  }
  constexpr int kMaxSamples = 64;
  const int count = is_deep ? kMaxSamples : 16;
  std::array<double, kMaxSamples> fan;
  const double spacing = 2 * std::numbers::pi / count;
  for (int k = 0; k < count; ++k) fan[k] = f(direction(spacing * k));
  for (int k = 0; k < count; ++k) {
    if (fan[k] > fan[(k + 1) % count] || fan[k] > fan[(k + count - 1) % count]) continue;
    Vector3 n = direction(spacing * k);
    double value = fan[k];
    for (int i = 0; i < kMaxSteps; ++i) {
      const Vector3 t = axis.cross(n);
      const double step = std::clamp(newton_angle(f, n, t), -0.5 * spacing, 0.5 * spacing);
      if (std::abs(step) < kTrustedStep) {
        n = (n + step * t).normalized();
        const double last = newton_angle(f, n, axis.cross(n));
        if (std::abs(last) < kTrustedStep) n = (n + last * axis.cross(n)).normalized();
        break;
      }
      if (!descend(f, step * t, n, value)) break;
    }
    out.push_back(n);
  }
}

}  // namespace twinarm
