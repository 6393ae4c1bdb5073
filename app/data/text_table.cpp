#include "app/data/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

// On the screen: bytes that continue a UTF-8 character take no column.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string TextTable::str() const {
  std::vector<std::size_t> width;
  for (const auto& row : rows_) {
    if (width.size() < row.size()) width.resize(row.size());
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], width_of(row[c]));
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blank(width[c] - width_of(row[c]), ' ');
      line += c == 0 ? row[c] + blank : "  " + blank + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string cell(double value) {
  constexpr double kRounding = 1e-14;
  return std::abs(value) < kRounding ? "0" : fmt::format("{:.6g}", value);
}

}  // namespace twinarm
