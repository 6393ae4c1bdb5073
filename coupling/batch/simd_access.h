// Access to one SIMD lane of scalars, vectors and inertias.
#pragma once

#include <cstddef>

#include "solver/spatial/batch.h"
#include "solver/spatial/spatial.h"

namespace twinarm {

template <class V>
void set_lane(V& all, std::size_t lane, double value) {
  all.set(static_cast<int>(lane), value);
}
template <class S>
void set_lane(Vec3<S>& all, std::size_t lane, const Vec3<double>& value) {
  set_lane(all.x, lane, value.x), set_lane(all.y, lane, value.y), set_lane(all.z, lane, value.z);
}
template <class S>
void set_lane(Inertia<S>& all, std::size_t lane, const Inertia<double>& value) {
  set_lane(all.m, lane, value.m);
  set_lane(all.h, lane, value.h);
  const auto part = [&](S Sym3<S>::*to, double Sym3<double>::*from) {
    set_lane(all.I.*to, lane, value.I.*from);
  };
  part(&Sym3<S>::xx, &Sym3<double>::xx), part(&Sym3<S>::yy, &Sym3<double>::yy);
  part(&Sym3<S>::zz, &Sym3<double>::zz), part(&Sym3<S>::xy, &Sym3<double>::xy);
  part(&Sym3<S>::xz, &Sym3<double>::xz), part(&Sym3<S>::yz, &Sym3<double>::yz);
}
template <class S>
double lane_of(const S& all, std::size_t lane) {
  return all[static_cast<int>(lane)];
}

}  // namespace twinarm
