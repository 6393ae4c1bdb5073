// Physical dimension of a term: powers of metre, kilogram and second. Angles have none.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace twinarm {

// Half powers occur under square roots: `halves` counts them.
struct Dimension {
  std::array<int, 3> halves{};  // m, kg, s

  bool is_none() const { return halves == std::array<int, 3>{}; }
  bool operator==(const Dimension&) const = default;
  Dimension operator*(const Dimension& other) const;
  Dimension operator/(const Dimension& other) const;
  // Nothing if the power is not a multiple of a half.
  std::optional<Dimension> to_the(double exponent) const;
  std::string text() const;  // "kg m/s^2"; "1" without dimension
};

struct Unit {
  Dimension dimension;
  double size = 1;  // in SI units
};

// "N/m", "N m s/rad", "1/s^2", "deg"; m, kg, s, rad and mm, cm, g, ms, min, deg, N, kN, J, W, Hz,
// Pa. All that follows `/` up to the next `/` divides. Nothing if it is no unit.
std::optional<Unit> parse_unit(std::string_view text);

}  // namespace twinarm
