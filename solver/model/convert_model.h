// Conversion of model and state to another scalar: Dual<N>, Batch<N>.
#pragma once

#include "solver/model/model.h"
#include "solver/spatial/convert_spatial.h"

namespace twinarm {

template <class T, class S>
T convert(const S& a) {
  return T(a);
}
template <class T, class From>
auto convert_all(const std::vector<From>& all) {
  std::vector<decltype(convert<T>(std::declval<From>()))> out;
  out.reserve(all.size());
  for (const From& one : all) out.push_back(convert<T>(one));
  return out;
}

template <class T>
Model<T> convert(const Model<double>& m) {
  Model<T> out;
  static_cast<ModelTree&>(out) = m;
  out.pitch = convert_all<T>(m.pitch);
  out.Xtree = convert_all<Constant<T>>(m.Xtree);
  out.I = convert_all<Constant<T>>(m.I);
  out.R_BL = convert_all<T>(m.R_BL);
  out.gravity = convert<T>(m.gravity);
  out.armature = convert_all<T>(m.armature);
  out.damping = convert_all<T>(m.damping);
  out.coulomb_plus = convert_all<T>(m.coulomb_plus);
  out.coulomb_minus = convert_all<T>(m.coulomb_minus);
  return out;
}
template <class T>
State<T> convert(const State<double>& x) {
  State<T> out;
  out.q = convert_all<T>(x.q);
  out.qd = convert_all<T>(x.qd);
  out.prescribed = convert_all<T>(x.prescribed);
  out.t = T(x.t);
  return out;
}

}  // namespace twinarm
