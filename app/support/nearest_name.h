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

}  // namespace twinarm
