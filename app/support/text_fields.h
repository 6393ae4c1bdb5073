// Lists in one text, and cells of CSV.
#pragma once

#include <string>
#include <vector>

namespace twinarm {

// "a,b" parted at each separator; of an empty text one empty field.
std::vector<std::string> split(const std::string& text, char separator = ',');

}  // namespace twinarm
