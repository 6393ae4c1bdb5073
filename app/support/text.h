// "Did you mean": the name that a misspelt one is closest to.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

// The name with the fewest letters to insert, delete, change or swap, case left aside; empty where
// all of them are further away than half of the letters.
std::string nearest_name(std::string_view misspelt, const std::vector<std::string>& names);

// "did you mean 'elbow'?" and, where there are few, all of the names; `kind` as in "joints".
std::string name_remedy(std::string_view misspelt, const std::vector<std::string>& names,
                        std::string_view kind);

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(item.name);
  return names;
}

// Lists in one text, and cells of CSV.

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
