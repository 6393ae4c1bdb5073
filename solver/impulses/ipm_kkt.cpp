// The linear algebra of interior_point.cpp and central_path.cpp: the equations of
// ipm_equations.h, what is left of them, and one system in the velocities,
//   (M + J^T D J) dv = J^T q - (M (v - v0) - J^T p),
// with D and q of a contact and its discs from what ipm_equations.h leaves for dp_n and dx_t:
//   D = e (1, l + a h)^T / C + diag(0, S),    e = (1, a h).
// It is not symmetric. What has no cone (locks, springs) follows its response (impulse_law.h), its
// multiplier renewed each time.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/impulses/impulse_solver.h"
#include "solver/impulses/ipm_equations.h"

namespace twinarm {
namespace {

constexpr double held_rho = 1e4;           // times rho0, of what has no cone
constexpr double starts[] = {1, 0.1, 10};  // times the velocities that are at stake

double dot2(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return a[0] * b[0] + a[1] * b[1];
}
std::array<double, 2> rows_across(const ImpulseConstraint& c, const Vec& u) {
  const int first = first_across(c), count = across(c);
  return {count > 0 ? u[first] : 0, count > 1 ? u[first + 1] : 0};
}

// From 1/3 to 3, spread like random numbers, and the same each time (splitmix64).
double weight_of(int which, int i) {
  std::uint64_t bits = static_cast<std::uint64_t>(which) * 0x9e3779b97f4a7c15u +
                       static_cast<std::uint64_t>(i) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  bits ^= bits >> 31;
  return std::pow(9.0, static_cast<double>(bits >> 11) * 0x1p-53 - 0.5);
}

// S into the rows across, D all else 0.
void set_across(const ImpulseConstraint& c, const std::array<double, 3>& S, Mat& D) {
  D = {};
  const int at = 4 * first_across(c);
  if (across(c) > 0) D[at] = S[0];
  if (across(c) > 1) D[at + 1] = D[at + 3] = S[1], D[at + 4] = S[2];
}

// e = (1, a h) or a h, and (1, l + a h) or l + a h, in the rows of the constraint.
Vec in_rows(const ImpulseConstraint& c, double normal, const std::array<double, 2>& t) {
  return is_contact(c) ? Vec{normal, t[0], t[1]} : Vec{t[0], t[1], 0};
}

}  // namespace

// What has a cone: discs with that of their contact.
bool ImpulseSolver::has_cone(const ImpulseProblem& problem, const ImpulseConstraint& c) const {
  if (c.law == ConstraintType::friction_disc)
    return c.radius > 0 && is_contact(problem.constraints()[c.of]);
  if (c.law == ConstraintType::box) return c.low < c.high && c.high - c.low < 1e100;
  return is_contact(c);
}

// x and z on the axes of their cones, as large as the impulses and velocities that are at stake;
// from the second start on these are larger or smaller, and x_0 z_0 has a weight of its own for
// each cone. Returns x_0 z_0 of weight 1; 0 if there is none.
double ImpulseSolver::begin_centrally(ImpulseProblem& problem, const Island& island, int which) {
  const std::size_t count = problem.constraints().size();
  x_.resize(count), z_.resize(count), dx_.resize(count), dz_.resize(count), d_.resize(count);
  r_z_.resize(count), right_.resize(count), terms_.resize(count), scaling_.resize(count);
  kept_.resize(count);
  rho_ratio_ = held_rho;
  for (const int t : island.trees) std::copy_n(problem.v0(t), problem.size(t), problem.v(t));
  double speed = 1e-6, impulse = 1e-9;
  cones_.clear();
  for (const int i : island.constraints) {
    ImpulseConstraint& c = problem.constraints()[i];
    memory_[i].rho = rho_ratio_ * rho0_[i];
    memory_[i].l = kept_[i] = c.p;
    x_[i] = z_[i] = dx_[i] = dz_[i] = {};
    if (!has_cone(problem, c)) continue;
    cones_.push_back(i);
    if (c.law == ConstraintType::friction_disc) continue;  // as its contact
    problem.velocity(c, problem.v(0), c.u);
    for (int r = 0; r < c.rows; ++r) {
      speed = std::max(speed, std::abs(c.u[r] + c.b[r]));
      impulse = std::max(impulse, rho0_[i] * std::abs(c.u[r] + c.b[r]));
    }
  }
  const double s0 = impulse * speed * starts[which % 3];
  for (const int i : cones_) {
    const ImpulseConstraint& c = problem.constraints()[i];
    terms_[i].arm = arm_of(c);
    if (c.law == ConstraintType::friction_disc)
      x_[i][0] = terms_[i].arm * x_[c.of][0] / terms_[c.of].arm;
    else
      x_[i][0] = c.law == ConstraintType::box ? 0.5 * (c.high - c.low) : impulse;
    terms_[i].weight = which == 0 ? 1 : weight_of(which, i);
    z_[i][0] = terms_[i].weight * s0 / x_[i][0];
    terms_[i].corner = z_[i][0];
  }
  return cones_.empty() ? 0 : s0;
}

// p, u, what is left of every equation, and D. Returns the mean of x z.
double ImpulseSolver::measure_centrally(ImpulseProblem& problem, const Island& island,
                                        double& residual) {
  double sum = 0;
  residual = 0;
  crosses_.clear();
  for (const int t : island.trees)
    std::fill_n(f_.begin() + static_cast<std::ptrdiff_t>(problem.first(t)), problem.size(t), 0.0);
  for (const int i : island.constraints) {
    ImpulseConstraint& c = problem.constraints()[i];
    problem.velocity(c, problem.v(0), c.u);
    for (int r = 0; r < c.rows; ++r) c.u[r] += c.b[r];
    if (c.law == ConstraintType::friction_disc)
      memory_[i].radius = c.radius * problem.constraints()[c.of].p[0];
    if (c.law == ConstraintType::compliant) memory_[i].radius = c.mu * c.p[0];
    if (has_cone(problem, c)) {
      sum += cone_dot(x_[i], z_[i]);
      measure_cone(c, i);
    } else {
      respond(c, memory_[i], DeSaxceShift::frozen, c.u, c.p, D_[i]);
      memory_[i].l = c.p;
    }
    p_[i] = c.p, u_[i] = c.u;
    problem.add_transpose(c, c.p, f_.data());
    residual = nan_max(residual, law_residual(c, memory_[i], rho0_[i], c.u, c.p));
  }
  for (const int i : cones_)
    if (is_contact(problem.constraints()[i])) join_discs(problem, i);
  residual = nan_max(residual, balance(problem, island).largest);
  return sum / std::max<double>(1, static_cast<double>(cones_.size()));
}

// p of x, and the terms of one cone.
void ImpulseSolver::measure_cone(ImpulseConstraint& c, int i) {
  ConeTerms& terms = terms_[i];
  const ConeVec &x = x_[i], &z = z_[i];
  const int first = first_across(c), count = across(c);
  if (is_contact(c)) c.p[0] = x[0] / terms.arm;
  for (int k = 0; k < count; ++k) c.p[first + k] = x[1 + k];
  if (c.law == ConstraintType::box) c.p[0] += 0.5 * (c.low + c.high);

  const auto w = rows_across(c, c.u);
  const double corner = rounded_ * terms.corner;
  terms.slip = count > 0 ? std::sqrt(w[0] * w[0] + w[1] * w[1] + corner * corner) : 0;
  terms.l = {0, 0};
  const double part = shift_part_ * terms.arm;
  if (terms.slip > 0) terms.l = {part * w[0] / terms.slip, part * w[1] / terms.slip};
  r_z_[i] = {0, w[0] - z[1], w[1] - z[2]};

  scaling_[i] = nesterov_todd(x, z);
  const ConeScaling& scaling = scaling_[i];
  const double eta2 = scaling.eta2, A = scaling.W2[0];
  terms.A = A;
  terms.h = {scaling.W2[3] / A, scaling.W2[6] / A};
  // S without the difference of large numbers: eta^2 across w_t, eta^4 / A along it.
  const double t2 = scaling.w[1] * scaling.w[1] + scaling.w[2] * scaling.w[2];
  const double along = eta2 * eta2 / A, more = t2 > 0 ? (eta2 - along) / t2 : 0;
  const double a = scaling.w[1], b = scaling.w[2];
  terms.S = t2 > 0 ? std::array{along + more * b * b, -more * a * b, along + more * a * a}
                   : std::array{eta2, 0.0, eta2};
  set_across(c, terms.S, D_[i]);
}

// A contact and its discs: C, r_n, and D between all of them.
void ImpulseSolver::join_discs(const ImpulseProblem& problem, int contact) {
  const std::vector<ImpulseConstraint>& all = problem.constraints();
  double C = 0, r_n = all[contact].u[0];
  for (int k = contact; k >= 0; k = next_disc_[k]) {
    const ConeTerms& terms = terms_[k];
    C += terms.arm * terms.arm / terms.A;
    r_n += terms.arm * (shift_part_ * terms.slip - z_[k][0]);
  }
  terms_[contact].C = C;
  r_z_[contact][0] = r_n;
  for (int i = contact; i >= 0; i = next_disc_[i])
    for (int j = contact; j >= 0; j = next_disc_[j]) {
      const ConeTerms &a = terms_[i], &b = terms_[j];
      const Vec e = in_rows(all[i], 1, {a.arm * a.h[0], a.arm * a.h[1]});
      const Vec f = in_rows(all[j], 1, {b.l[0] + b.arm * b.h[0], b.l[1] + b.arm * b.h[1]});
      if (i != j) crosses_.push_back({i, j, {}});
      Mat& D = i == j ? D_[i] : crosses_.back().D;
      for (int r = 0; r < all[i].rows; ++r)
        for (int k = 0; k < all[j].rows; ++k) D[3 * r + k] += e[r] * f[k] / C;
    }
}

// dv_, dx_ and dz_ of the linearised equations:  t o (W dz + W^-1 dx) = right_,  M dv = J^T dp -
// part rhs_, and r for what is left of z, that of w + r = z_t across and r_n. matrix_ is
// factorised.
void ImpulseSolver::solve_centrally(const ImpulseProblem& problem, const Island& island,
                                    const std::vector<ConeVec>& r, double part) {
  const std::vector<ImpulseConstraint>& all = problem.constraints();
  for (const int t : island.trees)
    std::fill_n(f_.begin() + static_cast<std::ptrdiff_t>(problem.first(t)), problem.size(t), 0.0);
  for (const int i : cones_) {
    d_[i] = times(scaling_[i].W, jordan_solve(scaling_[i].t, right_[i]));
    terms_[i].n = 0;
  }
  for (const int i : cones_) {
    if (!is_contact(all[i])) continue;
    double sum = -r[i][0];
    for (int k = i; k >= 0; k = next_disc_[k])
      sum += terms_[k].arm * (d_[k][0] / terms_[k].A - dot2(terms_[k].h, {r[k][1], r[k][2]}));
    for (int k = i; k >= 0; k = next_disc_[k]) terms_[k].n = sum / terms_[i].C;
  }
  for (const int i : cones_) {
    const auto q = change_across(i, terms_[i].n, {r[i][1], r[i][2]});
    problem.add_transpose(all[i], in_rows(all[i], terms_[i].n, q), f_.data());
  }
  step_rhs_.resize(rhs_.size());
  const auto for_each_row = [&](auto&& f) {
    for (const int t : island.trees)
      for (std::size_t k = 0; k < static_cast<std::size_t>(problem.size(t)); ++k)
        f(row_[t] + k, problem.first(t) + k);
  };
  for_each_row(
      [&](std::size_t row, std::size_t at) { step_rhs_[row] = f_[at] - part * rhs_[row]; });
  matrix_.solve(step_rhs_.data());
  for_each_row([&](std::size_t row, std::size_t at) { dv_[at] = step_rhs_[row]; });
  hand_out_centrally(problem, r);
}

// dx and dz of dv.
void ImpulseSolver::hand_out_centrally(const ImpulseProblem& problem,
                                       const std::vector<ConeVec>& r) {
  const std::vector<ImpulseConstraint>& all = problem.constraints();
  for (const int i : cones_) problem.velocity(all[i], dv_.data(), du_[i]);
  for (const int i : cones_) {
    if (!is_contact(all[i])) continue;
    double sum = du_[i][0];
    for (int k = i; k >= 0; k = next_disc_[k]) {
      const ConeTerms& terms = terms_[k];
      sum += dot2({terms.l[0] + terms.arm * terms.h[0], terms.l[1] + terms.arm * terms.h[1]},
                  rows_across(all[k], du_[k]));
    }
    for (int k = i; k >= 0; k = next_disc_[k]) terms_[k].n -= sum / terms_[i].C;
  }
  for (const int i : cones_) {
    const ConeTerms& terms = terms_[i];
    const auto dw = rows_across(all[i], du_[i]);
    const std::array<double, 2> dz{dw[0] + r[i][1], dw[1] + r[i][2]};
    const auto dx = change_across(i, terms.n, dz);
    dx_[i] = {terms.arm * terms.n, dx[0], dx[1]};
    dz_[i] = {(d_[i][0] - dx_[i][0]) / terms.A - dot2(terms.h, dz), dz[0], dz[1]};
  }
}

// dx_t = d_t - h (d_0 - a dp_n) - S dz_t
std::array<double, 2> ImpulseSolver::change_across(int i, double dp_n,
                                                   const std::array<double, 2>& dz) const {
  const ConeTerms& terms = terms_[i];
  const ConeVec& d = d_[i];
  const double left = d[0] - terms.arm * dp_n;
  return {d[1] - terms.h[0] * left - terms.S[0] * dz[0] - terms.S[1] * dz[1],
          d[2] - terms.h[1] * left - terms.S[1] * dz[0] - terms.S[2] * dz[1]};
}

}  // namespace twinarm
