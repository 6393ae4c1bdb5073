#include "app/data/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

constexpr std::size_t kWidth = kTextWidth, kColumn = 11, kLabel = 22;

double scale_of(const Eigen::MatrixXd& m) {
  return m.size() == 0 ? 1 : std::max(m.lpNorm<Eigen::Infinity>(), 1e-300);
}

// Columns on the screen: continuation bytes of UTF-8 have none.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

// The right part at the end of the line, or on its own line if it does not fit.
std::string spread(const std::string& left, std::string_view right) {
  const bool fits = left.size() + 2 + right.size() <= kWidth;
  return fmt::format("{}{:>{}}", fits ? left : left + "\n", right,
                     fits ? kWidth - left.size() : kWidth);
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

std::string matrix_table(const std::string& title, const std::vector<std::string>& names,
                         const Eigen::MatrixXd& matrix) {
  std::vector<std::string> headings{title};
  headings.insert(headings.end(), names.begin(), names.end());
  TextTable table(std::move(headings));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    std::vector<std::string> row{names[static_cast<std::size_t>(i)]};
    for (const double value : matrix.row(i)) row.push_back(cell(value));
    table.add(std::move(row));
  }
  return table.str();
}

std::string short_number(double value, double scale) {
  constexpr double kRounding = 1e-13;
  if (std::isnan(value)) return "nan";
  if (std::abs(value) <= kRounding * scale) return "0";
  std::string text = fmt::format("{:.5g}", value);
  const std::size_t length = text.size() - (value < 0 ? 1 : 0);  // without sign
  if (text.find('e') != std::string::npos || length > 9) text = fmt::format("{:.4g}", value);
  return text;
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  std::size_t begin = std::min(text.find_first_not_of(' '), text.size()), used = begin;
  std::string lines(begin, ' ');
  bool first = true;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (!first && used + 1 + end - begin > width)
      lines += "\n" + std::string(indent, ' '), used = indent;
    else if (!first)
      lines += ' ', ++used;
    first = false;
    lines += text.substr(begin, end - begin);
    used += end - begin;
    begin = end + 1;
  }
  return lines;
}

void Sheet::title(std::string_view text, std::string_view note) {
  const std::string rule(kWidth, '=');
  line("\n" + rule);
  line(spread(std::string(text), note));
  line(rule);
}

void Sheet::heading(std::string_view equation, std::string_view meaning, std::string_view unit) {
  const std::string note =
      unit.empty() ? std::string(meaning) : fmt::format("{} [{}]", meaning, unit);
  line(spread("  " + std::string(equation), note));
}

void Sheet::row(std::string_view label, const Vector6& six, const Vector6& size) {
  const double angular = scale_of(size.head<3>()), linear = scale_of(size.tail<3>());
  // A long name has its own line.
  std::string text = fmt::format("      {:<{}}", label, kLabel);
  if (label.size() > kLabel) text += "\n" + std::string(6 + kLabel, ' ');
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (k == 3) text += "  |";
    text += fmt::format("{:>{}}", short_number(six[k], k < 3 ? angular : linear), kColumn);
  }
  line(text);
}

void Sheet::sum(const std::vector<std::pair<std::string, Vector6>>& terms, std::string_view name,
                const Vector6& total, const Vector6& made_of) {
  Vector6 size = total.cwiseAbs();
  for (const auto& term : terms) size = size.cwiseMax(term.second.cwiseAbs());
  const bool has_terms = terms.size() > 1 && !size.isZero(0);
  size = size.cwiseMax(made_of);
  for (const auto& [label, value] : terms)
    if (has_terms) row(label, value, size);
  if (has_terms) line(std::string(6 + kLabel, ' ') + std::string(6 * kColumn + 3, '-'));
  row(name, total, size);
}

void Sheet::matrix(const Eigen::MatrixXd& m) {
  const double scale = scale_of(m);
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    std::string text(6 + kLabel, ' ');
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
      if (m.cols() == 6 && c == 3) text += "  |";
      text += fmt::format("{:>{}}", short_number(m(r, c), scale), kColumn);
    }
    line(text);
    if (m.rows() == 6 && m.cols() == 6 && r == 2) line("");
  }
}

}  // namespace twinarm
