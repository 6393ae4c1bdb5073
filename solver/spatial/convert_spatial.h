// Conversion of spatial quantities to another scalar.
#pragma once

#include "solver/spatial/spatial.h"

namespace twinarm {

template <class T, class S>
Vec3<T> convert(const Vec3<S>& a) {
  return {T(a.x), T(a.y), T(a.z)};
}
template <class T, class S>
Mat3<T> convert(const Mat3<S>& a) {
  return {convert<T>(a.r0), convert<T>(a.r1), convert<T>(a.r2)};
}
template <class T, class S>
Sym3<T> convert(const Sym3<S>& a) {
  return {T(a.xx), T(a.yy), T(a.zz), T(a.xy), T(a.xz), T(a.yz)};
}
template <class T, class S>
Transform<T> convert(const Transform<S>& a) {
  return {convert<T>(a.E), convert<T>(a.r)};
}
template <class T, class S>
Motion<T> convert(const Motion<S>& a) {
  return {convert<T>(a.w), convert<T>(a.v)};
}
template <class T, class S>
Force<T> convert(const Force<S>& a) {
  return {convert<T>(a.n), convert<T>(a.f)};
}
template <class T, class S>
Inertia<T> convert(const Inertia<S>& a) {
  return {T(a.m), convert<T>(a.h), convert<T>(a.I)};
}

}  // namespace twinarm
