// Lists in one text, and cells of CSV.
#pragma once

#include <string>
#include <vector>

namespace twinarm {

// "a,b" parted at each separator; of an empty text one empty field.
inline std::vector<std::string> split(const std::string& text, char separator = ',') {
  std::vector<std::string> fields(1);
  for (const char c : text)
    if (c == separator)
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

// In quotes where a comma, a quote or a line's end needs them.
std::string csv_field(const std::string& text);
std::string csv_line(const std::vector<std::string>& fields);  // without its end
std::string csv_line(const std::vector<double>& numbers);

}  // namespace twinarm
