// Tables for a terminal: columns as wide as they need, numbers to the right.
#pragma once

#include <string>
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

}  // namespace twinarm
