// SIMD vectors of doubles by the vector extension of g++ and clang.
#pragma once

#include <cstdint>

namespace twinarm {

// The alignment of a vector type depends on the instruction set: members need alignas.
template <int N>
struct LanesOf;  // Mask: all bits of a lane set, or none
template <>
struct LanesOf<2> {
  typedef double Lanes __attribute__((vector_size(16)));
  typedef std::int64_t Mask __attribute__((vector_size(16)));
};
template <>
struct LanesOf<4> {
  typedef double Lanes __attribute__((vector_size(32)));
  typedef std::int64_t Mask __attribute__((vector_size(32)));
};
template <>
struct LanesOf<8> {
  typedef double Lanes __attribute__((vector_size(64)));
  typedef std::int64_t Mask __attribute__((vector_size(64)));
};

// Whether any bit of any lane is set. Halves are combined to avoid extracting lanes one by one.
inline bool any_lane(const LanesOf<2>::Mask& m) {
  return (m[0] | m[1]) != 0;
}
inline bool any_lane(const LanesOf<4>::Mask& m) {
  return any_lane(__builtin_shufflevector(m, m, 0, 1) | __builtin_shufflevector(m, m, 2, 3));
}
inline bool any_lane(const LanesOf<8>::Mask& m) {
#if defined(__AVX512DQ__)  // sign bits of the lanes
  using Signs = long long __attribute__((vector_size(64)));
  return __builtin_ia32_cvtq2mask512(reinterpret_cast<const Signs&>(m)) != 0;
#else
  return any_lane(__builtin_shufflevector(m, m, 0, 1, 2, 3) |
                  __builtin_shufflevector(m, m, 4, 5, 6, 7));
#endif
}

// Doubles per vector register at the instruction-set level of this translation unit.
#if defined(__AVX512F__)
inline constexpr int kNativeLanes = 8;
#elif defined(__AVX__)
inline constexpr int kNativeLanes = 4;
#else
inline constexpr int kNativeLanes = 2;
#endif

}  // namespace twinarm
