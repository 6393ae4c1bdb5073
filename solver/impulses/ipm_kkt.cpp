// Linear algebra of interior_point.cpp and central_path.cpp: residuals of the equations of
// ipm_equations.h, and the KKT system reduced to the velocities,
//   (M + J^T D J) dv = J^T q - (M (v - v0) - J^T p),
// with D and q of a contact and its discs from dp_n and dx_t of ipm_equations.h:
//   D = e (1, l + a h)^T / C + diag(0, S),    e = (1, a h)   (not symmetric).
// Constraints without a cone (locks, springs) use impulse_law.h with a multiplier update per
// iteration.
#include <cmath>

#include "solver/impulses/interior_phase.h"
#include "solver/impulses/ipm_equations.h"

namespace twinarm {
namespace {

constexpr double kNoConeRho = 1e4;  // rho / rho0 of constraints without a cone
constexpr double kStartScales[] = {1, 0.1, 10, 0.01, 100, 0.3, 3, 0.03};  // of x_0 z_0

double dot2(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return a[0] * b[0] + a[1] * b[1];
}
std::array<double, 2> tangential_part(const ImpulseConstraint& c, const Vec& u) {
  const int first = first_tangential(c), count = tangential_rows(c);
  return {count > 0 ? u[first] : 0, count > 1 ? u[first + 1] : 0};
}

// D: S in the tangential rows, else 0.
void set_tangential(const ImpulseConstraint& c, const std::array<double, 3>& S, Mat& D) {
  D = {};
  const int at = 4 * first_tangential(c);
  if (tangential_rows(c) > 0) D[at] = S[0];
  if (tangential_rows(c) > 1) D[at + 1] = D[at + 3] = S[1], D[at + 4] = S[2];
}

// (normal, t) of a contact, t of a disc.
Vec in_rows(const ImpulseConstraint& c, double normal, const std::array<double, 2>& t) {
  return is_contact(c) ? Vec{normal, t[0], t[1]} : Vec{t[0], t[1], 0};
}

}  // namespace

bool InteriorPhase::has_cone(const ImpulseConstraint& c) const {
  if (c.law == ConstraintType::friction_disc)
    return c.radius > 0 && is_contact(island_.constraint(c.of));
  if (c.law == ConstraintType::box) return c.low < c.high && c.high - c.low < 1e100;
  return is_contact(c);
}

// x and z on the axes of their cones, scaled by impulses and velocities of the problem; later
// starts use other scales. Returns x_0 z_0; 0 without cones.
double InteriorPhase::initialize(int start) {
  const std::size_t count = island_.problem->constraints().size();
  x_.resize(count), z_.resize(count), dx_.resize(count), dz_.resize(count), d_.resize(count);
  r_z_.resize(count), right_.resize(count), terms_.resize(count), scaling_.resize(count);
  kept_.resize(count);
  for (const int t : island_.trees())
    std::copy_n(island_.problem->v0(t), island_.problem->size(t), island_.problem->v(t));
  double speed = 1e-6, impulse = 1e-9;
  cones_.clear();
  for (const int i : island_.constraints()) {
    ImpulseConstraint& c = island_.constraint(i);
    island_.multipliers[i].rho = kNoConeRho * island_.rho0[i];
    island_.multipliers[i].l = kept_[i] = c.p;
    x_[i] = z_[i] = dx_[i] = dz_[i] = {};
    if (!has_cone(c)) continue;
    cones_.push_back(i);
    if (c.law == ConstraintType::friction_disc) continue;  // scaled with its contact
    island_.problem->velocity(c, island_.problem->v(0), c.u);
    for (int r = 0; r < c.rows; ++r) {
      speed = std::max(speed, std::abs(c.u[r] + c.b[r]));
      impulse = std::max(impulse, island_.rho0[i] * std::abs(c.u[r] + c.b[r]));
    }
  }
  const double s0 = impulse * speed * kStartScales[start];
  for (const int i : cones_) {
    const ImpulseConstraint& c = island_.constraint(i);
    terms_[i].arm = arm_of(c);
    if (c.law == ConstraintType::friction_disc)
      x_[i][0] = terms_[i].arm * x_[c.of][0] / terms_[c.of].arm;
    else
      x_[i][0] = c.law == ConstraintType::box ? 0.5 * (c.high - c.low) : impulse;
    z_[i][0] = s0 / x_[i][0];
    terms_[i].kink = z_[i][0];
  }
  return cones_.empty() ? 0 : s0;
}

// p, u, residuals and D. Returns the mean of x . z.
double InteriorPhase::evaluate(double& residual) {
  double sum = 0;
  residual = 0;
  island_.coupling.clear();
  island_.zero_forces();
  for (const int i : island_.constraints()) {
    ImpulseConstraint& c = island_.constraint(i);
    island_.problem->velocity(c, island_.problem->v(0), c.u);
    for (int r = 0; r < c.rows; ++r) c.u[r] += c.b[r];
    if (c.law == ConstraintType::friction_disc)
      island_.multipliers[i].radius = c.radius * island_.constraint(c.of).p[0];
    if (c.law == ConstraintType::compliant) island_.multipliers[i].radius = c.mu * c.p[0];
    if (has_cone(c)) {
      sum += cone_dot(x_[i], z_[i]);
      evaluate_cone(c, i);
    } else {
      project_impulse(c, island_.multipliers[i], DeSaxceShift::frozen, c.u, c.p, island_.D[i]);
      island_.multipliers[i].l = c.p;
    }
    island_.p[i] = c.p, island_.u[i] = c.u;
    island_.problem->add_transpose(c, c.p, island_.forces.data());
    residual =
        nan_max(residual, law_residual(c, island_.multipliers[i], island_.rho0[i], c.u, c.p));
  }
  for (const int i : cones_)
    if (is_contact(island_.constraint(i))) couple_discs(i);
  residual = nan_max(residual, island_.momentum_balance().largest);
  return sum / std::max<double>(1, static_cast<double>(cones_.size()));
}

// p from x, and the terms of one cone.
void InteriorPhase::evaluate_cone(ImpulseConstraint& c, int i) {
  ConeTerms& terms = terms_[i];
  const ConeVec &x = x_[i], &z = z_[i];
  const int first = first_tangential(c), count = tangential_rows(c);
  if (is_contact(c)) c.p[0] = x[0] / terms.arm;
  for (int k = 0; k < count; ++k) c.p[first + k] = x[1 + k];
  if (c.law == ConstraintType::box) c.p[0] += 0.5 * (c.low + c.high);

  const auto w = tangential_part(c, c.u);
  const double kink = smoothing_ * terms.kink;
  terms.slip = count > 0 ? std::sqrt(w[0] * w[0] + w[1] * w[1] + kink * kink) : 0;
  terms.l = {0, 0};
  const double part = shift_factor_ * terms.arm;
  if (terms.slip > 0) terms.l = {part * w[0] / terms.slip, part * w[1] / terms.slip};
  r_z_[i] = {0, w[0] - z[1], w[1] - z[2]};

  scaling_[i] = nesterov_todd(x, z);
  const ConeScaling& scaling = scaling_[i];
  const double eta2 = scaling.eta2, A = scaling.W2[0];
  terms.A = A;
  terms.h = {scaling.W2[3] / A, scaling.W2[6] / A};
  // S without cancellation: eta^2 normal to w_t, eta^4 / A along w_t.
  const double t2 = scaling.w[1] * scaling.w[1] + scaling.w[2] * scaling.w[2];
  const double along = eta2 * eta2 / A, more = t2 > 0 ? (eta2 - along) / t2 : 0;
  const double a = scaling.w[1], b = scaling.w[2];
  terms.S = t2 > 0 ? std::array{along + more * b * b, -more * a * b, along + more * a * a}
                   : std::array{eta2, 0.0, eta2};
  set_tangential(c, terms.S, island_.D[i]);
}

// Contact and its discs: C, r_n, and the blocks of D.
void InteriorPhase::couple_discs(int contact) {
  double C = 0, r_n = island_.constraint(contact).u[0];
  for (int k = contact; k >= 0; k = island_.next_disc[k]) {
    const ConeTerms& terms = terms_[k];
    C += terms.arm * terms.arm / terms.A;
    r_n += terms.arm * (shift_factor_ * terms.slip - z_[k][0]);
  }
  terms_[contact].C = C;
  r_z_[contact][0] = r_n;
  for (int i = contact; i >= 0; i = island_.next_disc[i])
    for (int j = contact; j >= 0; j = island_.next_disc[j]) {
      const ConeTerms &a = terms_[i], &b = terms_[j];
      const Vec e = in_rows(island_.constraint(i), 1, {a.arm * a.h[0], a.arm * a.h[1]});
      const Vec f =
          in_rows(island_.constraint(j), 1, {b.l[0] + b.arm * b.h[0], b.l[1] + b.arm * b.h[1]});
      if (i != j) island_.coupling.push_back({i, j, {}});
      Mat& D = i == j ? island_.D[i] : island_.coupling.back().D;
      for (int r = 0; r < island_.constraint(i).rows; ++r)
        for (int k = 0; k < island_.constraint(j).rows; ++k) D[3 * r + k] += e[r] * f[k] / C;
    }
}

// Solves the linearised equations for dv_, dx_, dz_:  t o (W dz + W^-1 dx) = right_,
// M dv = J^T dp - factor rhs_, with residuals r = (r_n, w - z_t). matrix_ must be factorised.
void InteriorPhase::solve_kkt(const std::vector<ConeVec>& r, double factor) {
  island_.zero_forces();
  for (const int i : cones_) {
    d_[i] = times(scaling_[i].W, jordan_solve(scaling_[i].t, right_[i]));
    terms_[i].n = 0;
  }
  for (const int i : cones_) {
    if (!is_contact(island_.constraint(i))) continue;
    double sum = -r[i][0];
    for (int k = i; k >= 0; k = island_.next_disc[k])
      sum += terms_[k].arm * (d_[k][0] / terms_[k].A - dot2(terms_[k].h, {r[k][1], r[k][2]}));
    for (int k = i; k >= 0; k = island_.next_disc[k]) terms_[k].n = sum / terms_[i].C;
  }
  for (const int i : cones_) {
    const auto q = tangential_dx(i, terms_[i].n, {r[i][1], r[i][2]});
    island_.problem->add_transpose(island_.constraint(i),
                                   in_rows(island_.constraint(i), terms_[i].n, q),
                                   island_.forces.data());
  }
  island_.for_each_velocity(
      [&](std::size_t k) { island_.dv[k] = island_.forces[k] - factor * island_.balance[k]; });
  matrix_.solve(island_.dv);
  back_substitute(r);
}

// dx and dz from dv.
void InteriorPhase::back_substitute(const std::vector<ConeVec>& r) {
  for (const int i : cones_)
    island_.problem->velocity(island_.constraint(i), island_.dv.data(), island_.du[i]);
  for (const int i : cones_) {
    if (!is_contact(island_.constraint(i))) continue;
    double sum = island_.du[i][0];
    for (int k = i; k >= 0; k = island_.next_disc[k]) {
      const ConeTerms& terms = terms_[k];
      sum += dot2({terms.l[0] + terms.arm * terms.h[0], terms.l[1] + terms.arm * terms.h[1]},
                  tangential_part(island_.constraint(k), island_.du[k]));
    }
    for (int k = i; k >= 0; k = island_.next_disc[k]) terms_[k].n -= sum / terms_[i].C;
  }
  for (const int i : cones_) {
    const ConeTerms& terms = terms_[i];
    const auto dw = tangential_part(island_.constraint(i), island_.du[i]);
    const std::array<double, 2> dz{dw[0] + r[i][1], dw[1] + r[i][2]};
    const auto dx = tangential_dx(i, terms.n, dz);
    dx_[i] = {terms.arm * terms.n, dx[0], dx[1]};
    dz_[i] = {(d_[i][0] - dx_[i][0]) / terms.A - dot2(terms.h, dz), dz[0], dz[1]};
  }
}

// dx_t = d_t - h (d_0 - a dp_n) - S dz_t
std::array<double, 2> InteriorPhase::tangential_dx(int i, double dp_n,
                                                   const std::array<double, 2>& dz) const {
  const ConeTerms& terms = terms_[i];
  const ConeVec& d = d_[i];
  const double rest = d[0] - terms.arm * dp_n;
  return {d[1] - terms.h[0] * rest - terms.S[0] * dz[0] - terms.S[1] * dz[1],
          d[2] - terms.h[1] * rest - terms.S[1] * dz[0] - terms.S[2] * dz[1]};
}

}  // namespace twinarm
