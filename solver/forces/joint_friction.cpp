#include "solver/forces/joint_friction.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace twinarm {

double BoxLcp::result(std::size_t i, double& size) const {
  double v = rows[i].a;
  size = std::abs(v);
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const double term = B_(i, j) * rows[j].f;
    v += term;
    size += std::abs(term);
  }
  return v;
}

// Solves for f of the inside rows with v' = 0, others at a bound; false if B of these is singular.
bool BoxLcp::solve_inside() {
  inside_.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Row& row = rows[i];
    row.f = row.at == At::low ? row.low : row.at == At::high ? row.high : 0;
    if (row.at == At::inside) inside_.push_back(i);
  }
  double size = 0;
  for (std::size_t n = 0; n < inside_.size(); ++n) {
    rhs_[n] = -result(inside_[n], size);
    for (std::size_t m = 0; m <= n; ++m) factors_(n, m) = B_(inside_[n], inside_[m]);
  }
  if (!factors_.factorise(inside_.size())) return false;
  factors_.solve(rhs_.data());
  for (std::size_t n = 0; n < inside_.size(); ++n) rows[inside_[n]].f = rhs_[n];
  return true;
}

bool BoxLcp::contradicts(std::size_t i, At& better) const {
  const Row& row = rows[i];
  better = row.at;
  if (row.at == At::inside) {
    const double slack = kRounding * (row.high - row.low);
    if (row.f < row.low - slack) better = At::low;
    if (row.f > row.high + slack) better = At::high;
  } else {
    double size = 0;
    const double v = result(i, size);
    if (row.at == At::low ? v < -kRounding * size : v > kRounding * size) better = At::inside;
  }
  return better != row.at;
}

bool BoxLcp::solve() noexcept {
  for (Row& row : rows) row.at = At::inside;
  std::size_t fewest = rows.size() + 1;
  int block_pivots_left = 3;
  const std::size_t max_pivots = 20 + 10 * rows.size();
  for (std::size_t pivot = 0; pivot < max_pivots; ++pivot) {
    if (!solve_inside()) break;
    std::size_t count = 0, last = 0;
    At better;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (contradicts(i, better)) ++count, last = i;
    if (count == 0) {
      for (Row& row : rows) row.f = std::clamp(row.f, row.low, row.high);
      return true;
    }
    block_pivots_left = count < fewest ? 3 : block_pivots_left - 1;
    fewest = std::min(fewest, count);
    const bool block = block_pivots_left > 0;
    // contradicts() depends on f, which an exchange of `at` does not change.
    for (std::size_t i = block ? 0 : last; i <= last; ++i)
      if (contradicts(i, better)) rows[i].at = better;
  }
  solve_by_gauss_seidel();
  return false;
}

bool BoxLcp::solve_by_gauss_seidel() noexcept {
  constexpr int kMaxSweeps = 10000;
  for (Row& row : rows) row.f = std::clamp(row.f, row.low, row.high);
  bool done = false;
  for (int sweep = 0; sweep < kMaxSweeps && !done; ++sweep) {
    done = true;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double size = 0;
      const double v = result(i, size), before = rows[i].f;
      rows[i].f = std::clamp(before - v / B_(i, i), rows[i].low, rows[i].high);
      if (std::abs(rows[i].f - before) * B_(i, i) > 0.01 * kRounding * size) done = false;
    }
  }
  for (Row& row : rows)
    row.at = row.f <= row.low ? At::low : row.f >= row.high ? At::high : At::inside;
  return done;
}

CoulombFriction::CoulombFriction(const Model<double>& model) {
  std::vector<std::size_t> leader(model.nv);
  std::vector<double> ratio(model.nv, 1);
  std::iota(leader.begin(), leader.end(), 0);
  for (const Mimic& m : model.mimics) {
    leader[m.follower] = m.leader;
    ratio[m.follower] = m.ratio;
  }
  std::vector<std::vector<std::size_t>> members(model.nv);  // by leader
  for (std::size_t d = 0; d < model.nv; ++d)
    if (ratio[d] != 0) members[leader[d]].push_back(d);
  for (std::size_t l = 0; l < model.nv; ++l) {
    MimicGroup group{l, 0, 0, members_.size(), 0};
    for (const std::size_t d : members[l]) {
      const double r = ratio[d];
      const double against_plus = r > 0 ? -model.coulomb_plus[d] : model.coulomb_minus[d];
      const double against_minus = r > 0 ? model.coulomb_minus[d] : -model.coulomb_plus[d];
      members_.push_back({d, against_plus, against_minus});
      group.plus -= r * against_plus;
      group.minus += r * against_minus;
    }
    group.count = members_.size() - group.first;
    if (group.plus > 0 || group.minus > 0)
      groups_.push_back(group);
    else
      members_.resize(group.first);
  }
}

void CoulombFriction::distribute(std::size_t group, double f, std::vector<double>& tau) const {
  const MimicGroup& of = groups_[group];
  const double limit = f < 0 ? of.plus : of.minus;
  if (f == 0 || limit == 0) return;
  const double part = std::abs(f) / limit;
  for (std::size_t k = of.first; k < of.first + of.count; ++k)
    tau[members_[k].dof] += part * (f < 0 ? members_[k].plus : members_[k].minus);
}

}  // namespace twinarm
