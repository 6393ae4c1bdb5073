// Tables for a terminal: columns as wide as they need, numbers to the right.
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
  std::string str() const;  // the first column to the left; ends with a newline

 private:
  std::vector<std::vector<std::string>> rows_;
};

// Six digits; "0" for what is zero but for rounding (1e-14).
std::string cell(double value);

// Lines of numbers for people: spatial vectors as rows, inertias as matrices, sums term by term.
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Five digits, four where there is an exponent; what is below 1e-13 of `scale` is 0.
std::string short_number(double value, double scale = 1);

// Broken at blanks, to lines that fit; those after the first are indented.
std::string wrapped(std::string_view text, std::size_t indent = 2);

class Sheet {
 public:
  void line(std::string_view text) { text_ += std::string(text) + "\n"; }
  // Between two rules; the note to the right, where it fits in the line, else below.
  void title(std::string_view text, std::string_view note);
  // An equation to the left, what it is and its unit to the right.
  void heading(std::string_view equation, std::string_view meaning, std::string_view unit);
  // label   a  b  c | d  e  f
  void row(std::string_view label, const Vector6& six) { row(label, six, six); }
  // What is rounding beside `size` is 0; turning and shifting parts have sizes of their own.
  void row(std::string_view label, const Vector6& six, const Vector6& size);
  // Terms, a line, and what they add up to. What is one term alone, or zero, is not repeated.
  // `made_of`: sizes of what the terms are differences of, beside which rounding is 0.
  void sum(const std::vector<std::pair<std::string, Vector6>>& terms, std::string_view name,
           const Vector6& total, const Vector6& made_of = Vector6::Zero());
  void matrix(const Eigen::MatrixXd& m);
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

}  // namespace twinarm
