#include "solver/impulses/impulse_law.h"

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

enum { xx, xy, xz, yx, yy, yz, zx, zy, zz };

// Not std::hypot: these are velocities and impulses, whose squares are far from overflow, and what
// underflows is at rest.
double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

// A symmetric 2 x 2 on rows first, first + 1 of D.
void set_pair(Mat& D, int first, double aa, double ab, double bb) {
  const int at = first * 4;
  D[at] = aa, D[at + 1] = D[at + 3] = ab, D[at + 4] = bb;
}

// The vector of rows first .. first + count, made no longer than `radius`; D is P' there, if it is
// asked for, as in all that follows. It is zero before.
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
  // Slipping: only a turn of the vector changes the answer; in one dimension nothing does.
  const double turn = count > 1 ? scale : 0;
  set_pair(*D, first, turn * dy * dy, -turn * dx * dy, turn * dx * dx);
}

// Coulomb's cone |p_t| <= mu p_n, nearest point.
void project_on_cone(double mu, Vec& p, Mat* slope) {
  const double t = length(p[1], p[2]);
  if (t <= mu * p[0]) {
    if (slope) (*slope)[xx] = (*slope)[yy] = (*slope)[zz] = 1;
  } else if (mu * t <= -p[0]) {
    p = {};
  } else {
    const double a = 1 / (1 + mu * mu), dx = p[1] / t, dy = p[2] / t;
    const double p_n = a * (p[0] + mu * t), turn = mu * p_n / t, along = a * mu * mu;
    p = {p_n, mu * p_n * dx, mu * p_n * dy};
    if (!slope) return;
    Mat& D = *slope;
    D[xx] = a;
    D[xy] = D[yx] = a * mu * dx;
    D[xz] = D[zx] = a * mu * dy;
    D[yy] = along * dx * dx + turn * dy * dy;
    D[yz] = D[zy] = (along - turn) * dx * dy;
    D[zz] = along * dy * dy + turn * dx * dx;
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

void respond_softly(const ImpulseConstraint& c, double bound, const Vec& u, Vec& p, Mat& D) {
  D = {}, p = {};
  const double s = -u[0], after = c.depth + c.h * s, grip = 1 + c.c * s;
  if (after > 0 && grip > 0) {
    p[0] = c.h * c.k * after * grip;
    D[xx] = c.h * c.k * (c.h * grip + c.c * after);
  }
  const double stiff = c.h * (c.k_t * c.h + c.b_t);
  p[1] = -c.h * c.k_t * c.anchor[0] - stiff * u[1];
  p[2] = -c.h * c.k_t * c.anchor[1] - stiff * u[2];
  clip_to_disc(1, 2, bound, p, &D);
  for (const int at : {yy, yz, zy, zz}) D[at] *= stiff;
}

Vec shifted(const ImpulseConstraint& c, double shift, const Vec& u) {
  return c.law == ConstraintType::coulomb_cone ? Vec{u[0] + shift, u[1], u[2]} : u;
}

// l - rho (u + shift e_n)
Vec unprojected_impulse(const ImpulseConstraint& c, const MultiplierState& memory, double shift,
                        const Vec& u) {
  const Vec ut = shifted(c, shift, u);
  Vec p{};
  for (int r = 0; r < c.rows; ++r) p[r] = memory.l[r] - memory.rho * ut[r];
  return p;
}

double slip(const Vec& u) {
  return length(u[1], u[2]);
}

}  // namespace

void respond(const ImpulseConstraint& c, const MultiplierState& memory, DeSaxceShift shift,
             const Vec& u, Vec& p, Mat& D) {
  if (c.law == ConstraintType::compliant) return respond_softly(c, memory.radius, u, p, D);
  const bool follow =
      shift == DeSaxceShift::differentiated && c.law == ConstraintType::coulomb_cone;
  p = unprojected_impulse(c, memory, follow ? c.mu * slip(u) : memory.shift, u);
  project(c, memory.radius, p, &D);
  for (double& d : D) d *= memory.rho;
  if (const double speed = slip(u); follow && speed > 0) {
    // d ut / du = 1 + e_n (0, mu u_t / |u_t|)
    const double x = c.mu * u[1] / speed, y = c.mu * u[2] / speed;
    for (int r = 0; r < 9; r += 3) D[r + 1] += D[r] * x, D[r + 2] += D[r] * y;
  }
}

Vec answer(const ImpulseConstraint& c, const MultiplierState& memory, const Vec& u) {
  Vec p;
  if (Mat D; c.law == ConstraintType::compliant) {
    respond_softly(c, memory.radius, u, p, D);
  } else {
    p = unprojected_impulse(c, memory, memory.shift, u);
    project(c, memory.radius, p, nullptr);
  }
  return p;
}

Vec sliding_direction(const ImpulseConstraint& c, const MultiplierState& memory, const Vec& u) {
  const double x = memory.l[0] - memory.rho * u[0];
  const double y = c.rows > 1 ? memory.l[1] - memory.rho * u[1] : 0;
  const double norm = length(x, y);
  return norm > memory.radius ? Vec{x / norm, y / norm, 0} : Vec{};
}

double law_residual(const ImpulseConstraint& c, const MultiplierState& memory, double rho,
                    const Vec& u, const Vec& p) {
  Vec again{};
  Mat D{};
  if (c.law == ConstraintType::compliant) {
    respond_softly(c, c.mu * p[0], u, again, D);
  } else {
    const Vec ut = shifted(c, shift_of(c, u), u);
    for (int r = 0; r < c.rows; ++r) again[r] = p[r] - rho * ut[r];
    project(c, memory.radius, again, nullptr);
  }
  // A stiff spring makes much of a velocity that is hardly wrong: its own stiffness counts to rho.
  double largest = 0;
  for (int r = 0; r < c.rows; ++r)
    largest = nan_max(largest, std::abs(p[r] - again[r]) / (rho + D[4 * r]));
  return largest;
}

double shift_of(const ImpulseConstraint& c, const Vec& u) {
  return c.law == ConstraintType::coulomb_cone ? c.mu * slip(u) : 0;
}

void remember(const ImpulseConstraint& c, const std::vector<ImpulseConstraint>& all, const Vec& u,
              const Vec& p, MultiplierState& memory) {
  memory.l = p;
  memory.shift = shift_of(c, u);
  if (c.law == ConstraintType::compliant) memory.radius = c.mu * p[0];
  if (c.law == ConstraintType::friction_disc) memory.radius = c.radius * all[c.of].p[0];
}

}  // namespace twinarm
