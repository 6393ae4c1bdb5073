// Where the bodies are that springs of a batch pull at: read off pass 1 of aba().
//
// E turns from world to body axes, o is a body's origin in the world, a_bias its acceleration at
// qdd = 0, in body axes. In line is a hinge whose axes at home are its parent's: its Xup turns
// about z alone. Turned is a body that such hinges carry, all the way from the base: its E turns
// about z alone, is two numbers, and spares more than half of the products.
#pragma once

#include "coupling/batch/kernel/batch_state.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

// About z: the first row of its matrix is {c, s, 0}.
template <class S>
struct Turn {
  S c, s;
  explicit Turn(const Mat3<S>& E) : c(E.r0.x), s(E.r0.y) {}
  friend Vec3<S> operator*(const Turn& E, const Vec3<S>& v) {
    return {E.c * v.x + E.s * v.y, E.c * v.y - E.s * v.x, v.z};
  }
};
template <class S>
Vec3<S> transpose_times(const Turn<S>& E, const Vec3<S>& v) {
  return {E.c * v.x - E.s * v.y, E.s * v.x + E.c * v.y, v.z};
}

// E = X P, of which the rest stays as it is: zeros, and a one.
template <class S>
void place_turned(const Turn<S>& X, const Turn<S>& P, Mat3<S>& E) {
  E.r0.x = E.r1.y = X.c * P.c - X.s * P.s;
  E.r0.y = X.s * P.c + X.c * P.s;
  E.r1.x = -E.r0.y;
}
template <class S>
void place_in_line(const Turn<S>& X, const Mat3<S>& P, Mat3<S>& E) {
  E = {X.c * P.r0 + X.s * P.r1, X.c * P.r1 - X.s * P.r0, P.r2};
}
template <class S>
Motion<S> bias_in_line(const Transform<S>& X, const Motion<S>& a) {
  const Turn<S> turn(X.E);
  return {turn * a.w, turn * minus_cross(a.v, X.r, a.w)};
}
// What carries the springs' point of a body at qdd = 0; a turned body does not turn then.
template <class S>
Vec3<S> bias_at(const Vec3<S>& p, const Mat3<S>&, const Motion<S>& a) {
  return plus_cross(a.v, a.w, p);
}
template <class S>
Vec3<S> bias_at(const Vec3<S>&, const Turn<S>&, const Motion<S>& a) {
  return a.v;
}

template <class S>
TWINARM_KERNEL void place_bodies(BatchWork<S>& b) {
  for (std::size_t i = 1; i < b.E.size(); ++i) {
    const Place place = b.place[i];
    if (place == Place::none) continue;
    const auto p = static_cast<std::size_t>(b.model.parent[i]);
    const Transform<S>& X = b.w.Xup[i];
    const Mat3<S>& P = b.E[p];
    if (p == 0)
      b.E[i] = X.E;
    else if (place == Place::turned)
      place_turned(Turn<S>(X.E), Turn<S>(P), b.E[i]);
    else if (place == Place::in_line)
      place_in_line(Turn<S>(X.E), P, b.E[i]);
    else
      b.E[i] = X.E * P;
    if (!b.has_points) continue;
    b.o[i] = p == 0                   ? X.r
             : place == Place::turned ? b.o[p] + transpose_times(Turn<S>(P), X.r)
                                      : b.o[p] + transpose_times(P, X.r);
  }
}

template <class S>
TWINARM_KERNEL void find_biases(BatchWork<S>& b) {
  for (std::size_t i = 1; i < b.E.size(); ++i) {
    if (b.place[i] == Place::none) continue;
    const Motion<S>& a = b.a_bias[static_cast<std::size_t>(b.model.parent[i])];
    const Transform<S>& X = b.w.Xup[i];
    if (b.place[i] == Place::turned)
      b.a_bias[i].v = Turn<S>(X.E) * a.v + b.w.c[i].v;
    else
      b.a_bias[i] = (b.place[i] == Place::in_line ? bias_in_line(X, a) : X * a) + b.w.c[i];
  }
}

}  // namespace twinarm::TWINARM_ISA
