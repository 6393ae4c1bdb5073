#include "solver/model/non_finite.h"

#include <array>
#include <bit>

namespace twinarm {
namespace {

// Sum of 0 x over the entries x: 0 if all are finite, else NaN. T consists of doubles only.
template <class T>
double zero_times(const T& a) {
  double sum = 0;
  for (const double x : std::bit_cast<std::array<double, sizeof(T) / sizeof(double)>>(a))
    sum += x * 0;
  return sum;
}

}  // namespace

NonFiniteField first_bad_quantity(const Model<double>& model, const Forces<double>& forces,
                                  const Workspace<double>& w) {
  const std::size_t n = model.parent.size();
  NonFiniteField found;
  const auto check = [&](int pass, std::size_t body, const auto& fields) {
    fields.describe([&](const Quantity& quantity, const auto& field) {
      if (found.body != 0 || quantity.pass != pass) return;
      const std::size_t nv = model.dofs(body);
      std::size_t first = body, count = 1;
      if (quantity.by == Quantity::By::velocity) first = model.iv[body], count = nv;
      if (quantity.by == Quantity::By::square) first = w.iD[body], count = nv * nv;
      double sum = 0;
      for (std::size_t k = first; k < first + count; ++k) sum += zero_times(field[k]);
      if (!(sum == 0)) found = {body, quantity.name, pass};
    });
  };
  for (std::size_t i = 1; i < n; ++i) check(0, i, forces);
  for (int pass = 1; pass <= 3; ++pass)
    for (std::size_t k = 1; k < n && found.body == 0; ++k) check(pass, pass == 2 ? n - k : k, w);
  return found;
}

}  // namespace twinarm
