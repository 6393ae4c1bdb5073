// Numbers with units, symbols and sentences of the report as HTML.

#include <regex>

#include "app/study/report/report_slots.h"
#include "app/support/text.h"

namespace twinarm {
std::string typeset(const std::string& text) {
  static const std::pair<std::regex, const char*> rules[] = {
      {std::regex("\\b([kbKB])_?([12q])\\b"), "$1<sub>$2</sub>"},
      {std::regex(" deg\\b"), "°"},
      {std::regex("(>) (=) ([0-9.]+) (k<)"), "$1\u00a0$2\u00a0$3\u00a0$4"},
      {std::regex("([0-9]) (ms|k?Hz|kg|m\\b|%)"), "$1\u00a0$2"}};
  std::string html = with_powers(escaped(text));
  for (const auto& [pattern, format] : rules) html = std::regex_replace(html, pattern, format);
  return html;
}

std::string rounded(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return "none";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e5 || size < 1e-3) return typeset(fmt::format("{:.{}e}", value, digits - 1));
  const int whole = static_cast<int>(std::floor(std::log10(size))) + 1;  // digits before the point
  return fmt::format("{:.{}f}", value, std::max(0, digits - whole));
}

std::string degrees(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  return fmt::format("{:.{}f}", value,
                     std::abs(value) >= 0.1    ? 2
                     : std::abs(value) >= 0.01 ? 3
                                               : 4);
}

std::string quantity(double value, const std::string& unit, int digits) {
  if (unit.empty()) return rounded(value, digits);
  const SiPrefix prefix = si_prefix(value);
  return rounded(value / prefix.factor, digits) + "\u00a0" + prefix.name + unit;
}

std::string gains_words(double first, double second, const std::string& unit) {
  return first == second ? quantity(first, unit)
                         : quantity(first, unit) + "; " + quantity(second, unit);
}

std::string unit_of(const std::string& parameter, bool linear) {
  if (parameter[0] == 'k') return linear ? "N/m" : "N\u00a0m/rad";
  if (parameter[0] == 'b') return linear ? "N\u00a0s/m" : "N\u00a0m\u00a0s/rad";
  return parameter == "time_constant" ? "s" : "";
}

std::string symbol_of(const std::string& parameter) {
  return parameter == "arm2_mass_scale" ? "m"
         : parameter == "time_constant" ? "T"
         : parameter == "damping_ratio" ? "ζ"
                                        : typeset(parameter);
}

}  // namespace twinarm
