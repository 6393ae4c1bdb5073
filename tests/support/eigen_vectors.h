// std::vector as Eigen vector, for dense cross-checks.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace twinarm::testing {

constexpr Eigen::Index index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}
template <class T>
Eigen::VectorXd vector_of(const std::vector<T>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), index(v.size()));
}
inline double largest(const Eigen::VectorXd& v) {
  return v.size() == 0 ? 0 : v.lpNorm<Eigen::Infinity>();
}

}  // namespace twinarm::testing
