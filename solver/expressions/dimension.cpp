#include "solver/expressions/dimension.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr Dimension of(int m, int kg, int s) {
  return {{2 * m, 2 * kg, 2 * s}};
}

struct NamedUnit {
  std::string_view name;
  Unit unit;
};
constexpr NamedUnit kUnits[] = {{"1", {of(0, 0, 0), 1}},
                                {"rad", {of(0, 0, 0), 1}},
                                {"deg", {of(0, 0, 0), std::numbers::pi / 180}},
                                {"m", {of(1, 0, 0), 1}},
                                {"cm", {of(1, 0, 0), 0.01}},
                                {"mm", {of(1, 0, 0), 1e-3}},
                                {"kg", {of(0, 1, 0), 1}},
                                {"g", {of(0, 1, 0), 1e-3}},
                                {"s", {of(0, 0, 1), 1}},
                                {"ms", {of(0, 0, 1), 1e-3}},
                                {"min", {of(0, 0, 1), 60}},
                                {"Hz", {of(0, 0, -1), 1}},
                                {"N", {of(1, 1, -2), 1}},
                                {"kN", {of(1, 1, -2), 1e3}},
                                {"Pa", {of(-1, 1, -2), 1}},
                                {"J", {of(2, 1, -2), 1}},
                                {"W", {of(2, 1, -3), 1}}};
constexpr double kMaxPower = 9;

}  // namespace

Dimension Dimension::operator*(const Dimension& other) const {
  Dimension product = *this;
  for (std::size_t k = 0; k < halves.size(); ++k) product.halves[k] += other.halves[k];
  return product;
}

Dimension Dimension::operator/(const Dimension& other) const {
  Dimension quotient = *this;
  for (std::size_t k = 0; k < halves.size(); ++k) quotient.halves[k] -= other.halves[k];
  return quotient;
}

std::optional<Dimension> Dimension::to_the(double exponent) const {
  Dimension power;
  for (std::size_t k = 0; k < halves.size(); ++k) {
    const double exact = exponent * halves[k];
    if (exact != std::round(exact) || std::abs(exact) > 1000) return std::nullopt;
    power.halves[k] = static_cast<int>(exact);
  }
  return power;
}

std::string Dimension::text() const {
  static constexpr std::pair<const char*, std::size_t> order[] = {{"kg", 1}, {"m", 0}, {"s", 2}};
  std::string above, below;
  for (const auto& [name, k] : order) {
    const int power = std::abs(halves[k]);
    if (power == 0) continue;
    std::string& side = halves[k] > 0 ? above : below;
    side += std::string(side.empty() ? "" : " ") + name;
    if (power != 2)
      side += "^" + (power % 2 == 0 ? std::to_string(power / 2) : short_number_text(0.5 * power));
  }
  if (above.empty()) above = "1";
  return below.empty()
             ? above
             : above + "/" + (below.find(' ') != std::string::npos ? "(" + below + ")" : below);
}

std::optional<Unit> parse_unit(std::string_view text) {
  Unit unit;
  bool divides = false, expects_name = true;
  const auto skip_blanks = [&] {
    while (!text.empty() && std::string_view(" *()").find(text[0]) != std::string_view::npos)
      text.remove_prefix(1);
  };
  for (skip_blanks(); !text.empty(); skip_blanks()) {
    if (text[0] == '/') {
      if (expects_name) return std::nullopt;
      divides = true, expects_name = true;
      text.remove_prefix(1);
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" */^()"), text.size());
    const auto named = std::ranges::find(kUnits, text.substr(0, end), &NamedUnit::name);
    if (named == std::end(kUnits)) return std::nullopt;
    text.remove_prefix(end);
    double power = divides ? -1 : 1;
    if (!text.empty() && text[0] == '^') {
      const std::size_t last = std::min(text.find_first_of(" */()", 1), text.size());
      const auto exponent = parse_number(text.substr(1, last - 1));
      if (!exponent || !(std::abs(*exponent) <= kMaxPower)) return std::nullopt;
      power *= *exponent;
      text.remove_prefix(last);
    }
    const auto raised = named->unit.dimension.to_the(power);
    if (!raised) return std::nullopt;
    unit.dimension = unit.dimension * *raised;
    unit.size *= std::pow(named->unit.size, power);
    expects_name = false;
  }
  if (expects_name) return std::nullopt;
  return unit;
}

}  // namespace twinarm
