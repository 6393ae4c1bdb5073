// Solves one frictional contact problem with ImpulseSolver and measures the answer r as the FCLIB
// collection of problems does, independently of the solver: by the natural map
//   |r - P_K(r - (u + mu |u_t| n))| / |q|,    u = W r + q,
// which is zero where r obeys Coulomb's law. K: the cones |r_t| <= mu r_n; P_K: the projection.
//
// ImpulseSolver takes M and J with W = J M^-1 J^T. Here M = 1, and J is a factor of W by its
// eigenvectors, for each set of contacts that W couples. Of a W with negative eigenvalues (rounding
// in the file) the difference to J J^T is added to q, at the r of the last solution.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "solver/impulses/impulse_solver.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr const char* kUsage =
    "usage: friction_check PROBLEM [OPERATIONS]\n"
    "Solves one frictional contact problem and prints its error as JSON.\n"
    "PROBLEM is a text file of numbers: the number of contacts n; n friction coefficients; 3 n\n"
    "numbers q; then the lower triangle of the symmetric 3 n x 3 n matrix W, as ROW COLUMN VALUE\n"
    "from 0. Rows are (normal, tangent, tangent) of each contact.\n"
    "contacts: n; error: of the natural map, over |q|; law: residual in the solver's own measure\n"
    "[m/s]; converged; ms: shortest time of up to ten solutions; newton, interior, path:\n"
    "iterations of the solver's methods. OPERATIONS: budget of the solver.\n";

constexpr double kExact = 1e12;  // budget: however long it takes

struct FrictionProblem {
  VectorXd mu, q;
  MatrixXd W;
  Index contacts() const { return mu.size(); }
};

FrictionProblem read_problem(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot be read");
  const auto check = [](bool good, const std::string& what) {
    if (!good) throw std::runtime_error(what);
  };
  constexpr Index kMaxContacts = 10000;  // W is dense
  Index n = 0;
  check(in >> n && n > 0 && n <= kMaxContacts,
        "begins with no number of contacts from 1 to " + std::to_string(kMaxContacts));
  FrictionProblem problem{VectorXd(n), VectorXd(3 * n), MatrixXd::Zero(3 * n, 3 * n)};
  for (Index c = 0; c < n; ++c)
    check(in >> problem.mu[c] && problem.mu[c] >= 0,
          "friction coefficient " + std::to_string(c) + " is missing, negative or no number");
  for (Index row = 0; row < 3 * n; ++row)
    check(bool(in >> problem.q[row]), "q[" + std::to_string(row) + "] is missing or no number");
  check(problem.q.squaredNorm() > 0, "q is zero: no error relative to |q| exists");
  for (Index entry = 0; !(in >> std::ws).eof(); ++entry) {
    Index row = 0, column = 0;
    double value = 0;
    check(in >> row >> column >> value && column >= 0 && row >= column && row < 3 * n,
          "entry " + std::to_string(entry) +
              " of W is not ROW COLUMN VALUE with 0 <= COLUMN <= ROW" + " < " +
              std::to_string(3 * n));
    problem.W(row, column) = problem.W(column, row) = value;
  }
  return problem;
}

// For each contact the first of the set that W couples it to.
Eigen::VectorX<Index> coupled_sets(const FrictionProblem& problem) {
  const Index n = problem.contacts();
  Eigen::VectorX<Index> next = Eigen::VectorX<Index>::LinSpaced(n, 0, n - 1);
  const auto first = [&](Index c) {
    while (next[c] != c) c = next[c];
    return c;
  };
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < a; ++b)
      if (!problem.W.block<3, 3>(3 * a, 3 * b).isZero(0)) next[first(a)] = first(b);
  for (Index& c : next) c = first(c);
  return next;
}

// L with L L^T = A, without directions whose eigenvalues are rounding.
MatrixXd factor_of(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  const VectorXd& values = eigen.eigenvalues();  // ascending
  const double rounding = 1e-14 * values.maxCoeff();
  Index dropped = 0;
  while (dropped < A.rows() - 1 && values[dropped] < rounding) ++dropped;
  const Index rank = A.rows() - dropped;
  return eigen.eigenvectors().rightCols(rank) *
         values.tail(rank).cwiseSqrt().asDiagonal().toDenseMatrix();
}

ImpulseProblem impulse_problem_of(const FrictionProblem& problem) {
  const Index n = problem.contacts();
  const Eigen::VectorX<Index> sets = coupled_sets(problem);
  ImpulseProblem made;
  std::vector<int> tree(static_cast<std::size_t>(n));
  std::vector<MatrixXd> J(static_cast<std::size_t>(n));  // by contact, 3 x rank of its set
  for (Index set = 0; set < n; ++set) {
    std::vector<Index> rows;
    for (Index c = 0; c < n; ++c)
      if (sets[c] == set) rows.insert(rows.end(), {3 * c, 3 * c + 1, 3 * c + 2});
    if (rows.empty()) continue;
    const MatrixXd L = factor_of(problem.W(rows, rows));
    const int t = made.add_tree(static_cast<int>(L.cols()));
    for (Index d = 0; d < L.cols(); ++d) made.M(t)[d * L.cols() + d] = 1;
    for (std::size_t k = 0; k < rows.size(); k += 3) {
      const auto c = static_cast<std::size_t>(rows[k] / 3);
      tree[c] = t;
      J[c] = L.middleRows<3>(static_cast<Index>(k));
    }
  }
  for (std::size_t c = 0; c < J.size(); ++c) {
    const auto at = static_cast<Index>(c);
    ImpulseConstraint& law =
        made.add(ConstraintType::coulomb_cone, 3, tree[c], ImpulseConstraint::no_tree);
    law.mu = problem.mu[at];
    for (Index row = 0; row < 3; ++row)
      for (Index k = 0; k < J[c].cols(); ++k) made.J(law, 0)[row * J[c].cols() + k] = J[c](row, k);
  }
  return made;
}

// The nearest point of the cone |z_t| <= mu z_n.
Vector3d project_on_cone(const Vector3d& z, double mu) {
  const double slip = std::hypot(z[1], z[2]);
  if (slip <= mu * z[0]) return z;
  if (mu * slip <= -z[0]) return Vector3d::Zero();
  const double normal = (mu * slip + z[0]) / (mu * mu + 1);
  return {normal, mu * normal * z[1] / slip, mu * normal * z[2] / slip};
}

double natural_map(const FrictionProblem& problem, const VectorXd& r) {
  const VectorXd u = problem.W * r + problem.q;
  double sum = 0;
  for (Index c = 0; c < problem.contacts(); ++c) {
    const double mu = problem.mu[c];
    const Vector3d r_c = r.segment<3>(3 * c), u_c = u.segment<3>(3 * c);
    Vector3d z = r_c - u_c;
    z[0] -= mu * std::hypot(u_c[1], u_c[2]);
    sum += (r_c - project_on_cone(z, mu)).squaredNorm();
  }
  return std::sqrt(sum) / problem.q.norm();
}

VectorXd impulses_of(const ImpulseProblem& impulses) {
  VectorXd r(3 * static_cast<Index>(impulses.constraints().size()));
  for (Index c = 0; 3 * c < r.size(); ++c)
    r.segment<3>(3 * c) =
        Eigen::Map<const Vector3d>(impulses.constraints()[static_cast<std::size_t>(c)].p.data());
  return r;
}

void set_bias(ImpulseProblem& impulses, const VectorXd& q) {
  for (std::size_t c = 0; c < impulses.constraints().size(); ++c)
    Eigen::Map<Vector3d>(impulses.constraints()[c].b.data()) =
        q.segment<3>(3 * static_cast<Index>(c));
}

// Returns r.
VectorXd solve_once(const FrictionProblem& problem, ImpulseProblem& impulses, double budget,
                    ImpulseReport& report) {
  const int max_corrections = budget < kExact ? 0 : 3;
  constexpr double kGoodError = 1e-9;
  ImpulseSolver solver;  // without what an earlier solution has left
  solver.accuracy.budget = budget;
  for (ImpulseConstraint& c : impulses.constraints()) c.p = {}, c.u = {};
  set_bias(impulses, problem.q);
  report = solver.solve(impulses);
  VectorXd r = impulses_of(impulses);
  for (int k = 0; k < max_corrections && natural_map(problem, r) > kGoodError; ++k) {
    VectorXd Wr(r.size());  // by the factors
    for (std::size_t c = 0; c < impulses.constraints().size(); ++c) {
      const ImpulseConstraint& law = impulses.constraints()[c];
      Wr.segment<3>(3 * static_cast<Index>(c)) =
          Eigen::Map<const Vector3d>(law.u.data()) - Eigen::Map<const Vector3d>(law.b.data());
    }
    set_bias(impulses, problem.q + problem.W * r - Wr);
    report.add(solver.solve(impulses));
    r = impulses_of(impulses);
  }
  return r;
}

void solve(const FrictionProblem& problem, double budget) {
  constexpr int kMaxRepeats = 10;
  constexpr double kMaxSeconds = 0.5;
  ImpulseProblem impulses = impulse_problem_of(problem);
  ImpulseReport report;
  VectorXd r;
  double shortest = HUGE_VAL, spent = 0;
  for (int n = 0; n < kMaxRepeats && spent < kMaxSeconds; ++n) {
    const auto start = std::chrono::steady_clock::now();
    r = solve_once(problem, impulses, budget, report);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    spent += time.count();
    shortest = std::min(shortest, time.count());
  }
  std::printf(
      "{\"contacts\": %d, \"error\": %.3e, \"law\": %.3e, \"converged\": %s, \"ms\": %.4f, "
      "\"newton\": %d, \"interior\": %d, \"path\": %d}\n",
      static_cast<int>(problem.contacts()), natural_map(problem, r), report.residual,
      report.converged ? "true" : "false", 1e3 * shortest, report.newton, report.interior,
      report.path);
}

}  // namespace
}  // namespace twinarm

int main(int count, char** arguments) {
  const std::string file = count == 2 || count == 3 ? arguments[1] : "";
  const double budget =
      count == 3 ? twinarm::parse_number(arguments[2]).value_or(0) : twinarm::kExact;
  if (file == "--help") return std::fputs(twinarm::kUsage, stdout) < 0;
  if (file.empty() || !(budget > 0)) {
    std::fputs(twinarm::kUsage, stderr);
    return 2;
  }
  try {
    twinarm::solve(twinarm::read_problem(file), budget);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "friction_check: %s: %s\n", file.c_str(), error.what());
    return 2;
  }
}
