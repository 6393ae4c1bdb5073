// Lines of a file that may be hostile.
#pragma once

#include <istream>
#include <string>

namespace twinarm {

// As std::getline; throws InputError, naming `file` and line `number`, where the line has more than
// 64 KiB: a file without ends of lines is not read whole.
bool next_line(std::istream& stream, std::string& line, const std::string& file, int number);

}  // namespace twinarm
