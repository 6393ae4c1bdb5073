// Tables for a terminal.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace twinarm {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> headings) : rows_{std::move(headings)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string str() const;  // first column left-aligned, others right-aligned

 private:
  std::vector<std::vector<std::string>> rows_;
};

// Six digits; "0" below 1e-14.
std::string cell(double value);

// A square matrix with these names of its rows and columns.
std::string matrix_table(const std::string& title, const std::vector<std::string>& names,
                         const Eigen::MatrixXd& matrix);

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Five digits, four with an exponent; "0" below 1e-13 * scale.
std::string short_number(double value, double scale = 1);

// Lines of at most `width` characters, broken at spaces; those after the first are indented.
inline constexpr std::size_t kTextWidth = 98;
std::string wrapped(std::string_view text, std::size_t indent = 2, std::size_t width = kTextWidth);

// Text with equations, spatial vectors as rows, matrices, and sums term by term.
class Sheet {
 public:
  void line(std::string_view text) { text_ += std::string(text) + "\n"; }
  // Between two rules; the note right-aligned.
  void title(std::string_view text, std::string_view note);
  // Equation, and right-aligned meaning and unit.
  void heading(std::string_view equation, std::string_view meaning, std::string_view unit);
  // label   a  b  c | d  e  f
  void row(std::string_view label, const Vector6& six) { row(label, six, six); }
  // Rounding errors relative to `size` are 0; angular and linear parts have separate sizes.
  void row(std::string_view label, const Vector6& six, const Vector6& size);
  // Terms and their sum; a single term is not repeated. `made_of`: sizes relative to which rounding
  // errors are 0, if the terms are differences.
  void sum(const std::vector<std::pair<std::string, Vector6>>& terms, std::string_view name,
           const Vector6& total, const Vector6& made_of = Vector6::Zero());
  void matrix(const Eigen::MatrixXd& m);
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

}  // namespace twinarm
