// Lines of a file that may be hostile.
#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

// As std::getline; throws InputError, naming `file` and line `number`, where the line has more than
// 64 KiB: a file without ends of lines is not read whole.
bool next_line(std::istream& stream, std::string& line, const std::string& file, int number);

// What stands between its commas, without the blanks about it.
std::vector<std::string_view> csv_cells(std::string_view line);

}  // namespace twinarm
