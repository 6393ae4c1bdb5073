// Lines of CSV.
#pragma once

#include <string>
#include <vector>

namespace twinarm {

// In quotes where a comma, a quote or a line's end needs them.
std::string csv_field(const std::string& text);
std::string csv_line(const std::vector<std::string>& fields);  // without its end
std::string csv_line(const std::vector<double>& numbers);

}  // namespace twinarm
