#include "solver/impulses/impulse_law.h"

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

enum { xx, xy, xz, yx, yy, yz, zx, zy, zz };

// Without the overflow protection of std::hypot, which velocities and impulses do not need.
double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

// A symmetric 2 x 2 on rows first, first + 1 of D.
void set_pair(Mat& D, int first, double aa, double ab, double bb) {
  const int at = first * 4;
  D[at] = aa, D[at + 1] = D[at + 3] = ab, D[at + 4] = bb;
}

// Projects rows first .. first + count of p on the disc of `radius`; D, if given and zero before,
// becomes the derivative P'.
void clip_to_disc(int first, int count, double radius, Vec& p, Mat* D) {
  const double x = p[first], y = count > 1 ? p[first + 1] : 0;
  const double norm = length(x, y);
  if (norm <= radius) {
    if (D) set_pair(*D, first, 1, 0, count > 1 ? 1 : 0);
    return;
  }
  const double scale = radius / norm, dx = x / norm, dy = y / norm;
  p[first] = scale * x;
  if (count > 1) p[first + 1] = scale * y;
  if (!D) return;
  // Sliding: P' is nonzero only normal to p, and zero in one dimension.
  const double normal = count > 1 ? scale : 0;
  set_pair(*D, first, normal * dy * dy, -normal * dx * dy, normal * dx * dx);
}

// Projection on the friction cone |p_t| <= mu p_n.
void project_on_cone(double mu, Vec& p, Mat* jacobian) {
  const double t = length(p[1], p[2]);
  if (t <= mu * p[0]) {
    if (jacobian) (*jacobian)[xx] = (*jacobian)[yy] = (*jacobian)[zz] = 1;
  } else if (mu * t <= -p[0]) {
    p = {};
  } else {
    const double a = 1 / (1 + mu * mu), dx = p[1] / t, dy = p[2] / t;
    const double p_n = a * (p[0] + mu * t), normal = mu * p_n / t, along = a * mu * mu;
    p = {p_n, mu * p_n * dx, mu * p_n * dy};
    if (!jacobian) return;
    Mat& D = *jacobian;
    D[xx] = a;
    D[xy] = D[yx] = a * mu * dx;
    D[xz] = D[zx] = a * mu * dy;
    D[yy] = along * dx * dx + normal * dy * dy;
    D[yz] = D[zy] = (along - normal) * dx * dy;
    D[zz] = along * dy * dy + normal * dx * dx;
  }
}

void project(const ImpulseConstraint& c, double radius, Vec& p, Mat* D) {
  if (D) *D = {};
  switch (c.law) {
    case ConstraintType::bilateral:
      if (D) (*D)[xx] = 1, (*D)[yy] = c.rows > 1, (*D)[zz] = c.rows > 2;
      break;
    case ConstraintType::unilateral:
      if (D) (*D)[xx] = p[0] > 0;
      p[0] = std::max(0.0, p[0]);
      break;
    case ConstraintType::box:
      if (D) (*D)[xx] = p[0] > c.low && p[0] < c.high;
      p[0] = std::clamp(p[0], c.low, c.high);
      break;
    case ConstraintType::friction_disc:
      clip_to_disc(0, c.rows, radius, p, D);
      break;
    case ConstraintType::coulomb_cone:
      project_on_cone(c.mu, p, D);
      break;
    case ConstraintType::compliant:
      break;
  }
}

// Compliant contact: Hunt-Crossley normal force, bristle friction (impulse_problem.h).
void compliant_impulse(const ImpulseConstraint& c, double bound, const Vec& u, Vec& p, Mat& D) {
  D = {}, p = {};
  const double s = -u[0], depth = c.depth + c.h * s, damping = 1 + c.c * s;
  if (depth > 0 && damping > 0) {
    p[0] = c.h * c.k * depth * damping;
    D[xx] = c.h * c.k * (c.h * damping + c.c * depth);
  }
  const double stiffness = c.h * (c.k_t * c.h + c.b_t);
  p[1] = -c.h * c.k_t * c.anchor[0] - stiffness * u[1];
  p[2] = -c.h * c.k_t * c.anchor[1] - stiffness * u[2];
  clip_to_disc(1, 2, bound, p, &D);
  for (const int at : {yy, yz, zy, zz}) D[at] *= stiffness;
}

Vec shifted(const ImpulseConstraint& c, double shift, const Vec& u) {
  return c.law == ConstraintType::coulomb_cone ? Vec{u[0] + shift, u[1], u[2]} : u;
}

// l - rho (u + shift e_n)
Vec unprojected_impulse(const ImpulseConstraint& c, const MultiplierState& state, double shift,
                        const Vec& u) {
  const Vec ut = shifted(c, shift, u);
  Vec p{};
  for (int r = 0; r < c.rows; ++r) p[r] = state.l[r] - state.rho * ut[r];
  return p;
}

double slip(const Vec& u) {
  return length(u[1], u[2]);
}

}  // namespace

void project_impulse(const ImpulseConstraint& c, const MultiplierState& state, DeSaxceShift shift,
                     const Vec& u, Vec& p, Mat& D) {
  if (c.law == ConstraintType::compliant) return compliant_impulse(c, state.radius, u, p, D);
  const bool differentiated =
      shift == DeSaxceShift::differentiated && c.law == ConstraintType::coulomb_cone;
  p = unprojected_impulse(c, state, differentiated ? c.mu * slip(u) : state.shift, u);
  project(c, state.radius, p, &D);
  for (double& d : D) d *= state.rho;
  if (const double speed = slip(u); differentiated && speed > 0) {
    // d ut / du = 1 + e_n (0, mu u_t / |u_t|)
    const double x = c.mu * u[1] / speed, y = c.mu * u[2] / speed;
    for (int r = 0; r < 9; r += 3) D[r + 1] += D[r] * x, D[r + 2] += D[r] * y;
  }
}

Vec project_impulse(const ImpulseConstraint& c, const MultiplierState& state, const Vec& u) {
  Vec p;
  if (Mat D; c.law == ConstraintType::compliant) {
    compliant_impulse(c, state.radius, u, p, D);
  } else {
    p = unprojected_impulse(c, state, state.shift, u);
    project(c, state.radius, p, nullptr);
  }
  return p;
}

Vec sliding_direction(const ImpulseConstraint& c, const MultiplierState& state, const Vec& u) {
  const double x = state.l[0] - state.rho * u[0];
  const double y = c.rows > 1 ? state.l[1] - state.rho * u[1] : 0;
  const double norm = length(x, y);
  return norm > state.radius ? Vec{x / norm, y / norm, 0} : Vec{};
}

double law_residual(const ImpulseConstraint& c, const MultiplierState& state, double rho,
                    const Vec& u, const Vec& p) {
  Vec again{};
  Mat D{};
  if (c.law == ConstraintType::compliant) {
    compliant_impulse(c, c.mu * p[0], u, again, D);
  } else {
    const Vec ut = shifted(c, de_saxce_shift(c, u), u);
    for (int r = 0; r < c.rows; ++r) again[r] = p[r] - rho * ut[r];
    project(c, state.radius, again, nullptr);
  }
  // Adding the spring's stiffness to rho gives the velocity error of compliant contacts.
  double largest = 0;
  for (int r = 0; r < c.rows; ++r)
    largest = nan_max(largest, std::abs(p[r] - again[r]) / (rho + D[4 * r]));
  return largest;
}

double de_saxce_shift(const ImpulseConstraint& c, const Vec& u) {
  return c.law == ConstraintType::coulomb_cone ? c.mu * slip(u) : 0;
}

void update_multiplier(const ImpulseConstraint& c, const std::vector<ImpulseConstraint>& all,
                       const Vec& u, const Vec& p, MultiplierState& state) {
  state.l = p;
  state.shift = de_saxce_shift(c, u);
  if (c.law == ConstraintType::compliant) state.radius = c.mu * p[0];
  if (c.law == ConstraintType::friction_disc) state.radius = c.radius * all[c.of].p[0];
}

}  // namespace twinarm
