// Locale-independent conversion between numbers and text; exact round trip.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

// Shortest text (at most 17 digits) that reads back as the same double.
inline std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

// Six significant digits, for messages.
inline std::string short_number_text(double value) {
  char buffer[32];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr;
  return {buffer, end};
}

// One finite number and nothing else; "nan", "inf" and "0.1m" are rejected.
inline std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

// Finite numbers separated by blanks; nullopt if one of them is not a number.
inline std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  std::vector<double> values;
  for (auto begin = text.find_first_not_of(kBlank); begin != std::string_view::npos;
       begin = text.find_first_not_of(kBlank, begin)) {
    const auto end = std::min(text.find_first_of(kBlank, begin), text.size());
    const auto value = parse_number(text.substr(begin, end - begin));
    if (!value) return std::nullopt;
    values.push_back(*value);
    begin = end;
  }
  return values;
}

}  // namespace twinarm
