#include "solver/model/non_finite.h"

namespace twinarm {
namespace {

// Zero where all is finite, else NaN.
double rest_of(double a) {
  return a * 0;
}
double rest_of(const Vec3<double>& a) {
  return a.x * 0 + a.y * 0 + a.z * 0;
}
double rest_of(const Mat3<double>& a) {
  return rest_of(a.r0) + rest_of(a.r1) + rest_of(a.r2);
}
double rest_of(const Sym3<double>& a) {
  return rest_of(full(a));
}
double rest_of(const Motion<double>& a) {
  return rest_of(a.w) + rest_of(a.v);
}
double rest_of(const Force<double>& a) {
  return rest_of(a.n) + rest_of(a.f);
}
double rest_of(const Transform<double>& a) {
  return rest_of(a.E) + rest_of(a.r);
}
double rest_of(const ArticulatedInertia<double>& a) {
  return rest_of(a.I) + rest_of(a.H) + rest_of(a.M);
}

}  // namespace

BadQuantity first_bad_quantity(const Model<double>& model, const Forces<double>& forces,
                               const Workspace<double>& w) {
  const std::size_t n = model.parent.size();
  BadQuantity found;
  const auto look = [&](int pass, std::size_t body, const auto& fields) {
    fields.describe([&](const Quantity& quantity, const auto& field) {
      if (found.body != 0 || quantity.pass != pass) return;
      const std::size_t nv = model.dofs(body);
      std::size_t first = body, count = 1;
      if (quantity.by == Quantity::By::velocity) first = model.iv[body], count = nv;
      if (quantity.by == Quantity::By::square) first = w.iD[body], count = nv * nv;
      double sum = 0;
      for (std::size_t k = first; k < first + count; ++k) sum += rest_of(field[k]);
      if (!(sum == 0)) found = {body, quantity.name, pass};
    });
  };
  for (std::size_t i = 1; i < n; ++i) look(0, i, forces);
  for (int pass = 1; pass <= 3; ++pass)
    for (std::size_t k = 1; k < n && found.body == 0; ++k) look(pass, pass == 2 ? n - k : k, w);
  return found;
}

}  // namespace twinarm
