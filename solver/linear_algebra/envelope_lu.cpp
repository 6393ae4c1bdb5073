#include "solver/linear_algebra/envelope_lu.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

using Row = Eigen::Map<const Eigen::VectorXd>;
double dot(const double* a, const double* b, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  return Row(a, size).dot(Row(b, size));
}

}  // namespace

void EnvelopeLu::add_row(std::size_t first) {
  const std::size_t row = first_.size();
  first_.push_back(first);
  begin_.push_back(lower_.size());
  lower_.resize(lower_.size() + row + 1 - first, 0.0);
  upper_.resize(lower_.size(), 0.0);
}

void EnvelopeLu::set_zero() {
  lower_.assign(lower_.size(), 0.0);
  upper_.assign(upper_.size(), 0.0);
}

// l_rj = (a_rj - sum_k l_rk u_kj) / u_jj,   u_jr = a_jr - sum_k l_jk u_kr   (k < j)
bool EnvelopeLu::factorise(bool symmetric) {
  bool regular = true;
  for (std::size_t r = 0; r < rows(); ++r) {
    double *l = lower_.data() + begin_[r], *u = upper_.data() + begin_[r];
    const std::size_t first = first_[r], n = r - first;
    for (std::size_t j = first; j < r; ++j) {
      const double *l_j = lower_.data() + begin_[j], *u_j = upper_.data() + begin_[j];
      const std::size_t from = std::max(first, first_[j]), count = j - from;
      const std::size_t here = from - first, there = from - first_[j], at = j - first;
      const double inverse = l_j[j - first_[j]];
      if (symmetric) {
        u[at] = l[at] - dot(u + here, l_j + there, count);
        l[at] = u[at] * inverse;
      } else {
        l[at] = (l[at] - dot(l + here, u_j + there, count)) * inverse;
        u[at] -= dot(l_j + there, u + here, count);
      }
    }
    l[n] = 1 / (l[n] - dot(l, u, n));
    regular = regular && std::isfinite(l[n]);
  }
  return regular;
}

int EnvelopeLu::determinant_sign() const {
  int sign = 1;
  for (std::size_t r = 0; r < rows(); ++r)
    if (lower_[begin_[r] + r - first_[r]] < 0) sign = -sign;
  return sign;
}

void EnvelopeLu::solve(double* b) const {
  for (std::size_t r = 0; r < rows(); ++r)
    b[r] -= dot(lower_.data() + begin_[r], b + first_[r], r - first_[r]);
  for (std::size_t r = rows(); r-- > 0;) {
    const std::size_t n = r - first_[r];
    b[r] *= lower_[begin_[r] + n];
    for (std::size_t k = 0; k < n; ++k) b[first_[r] + k] -= upper_[begin_[r] + k] * b[r];
  }
}

}  // namespace twinarm
