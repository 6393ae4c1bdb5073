#include "coupling/target/csv_lines.h"

#include <algorithm>
#include <array>

#include "solver/support/diagnostics.h"

namespace twinarm {

bool next_line(std::istream& stream, std::string& line, const std::string& file, int number) {
  std::array<char, 1 << 16> buffer;
  stream.getline(buffer.data(), buffer.size());
  const auto count = static_cast<std::size_t>(stream.gcount());
  if (stream.fail() && count + 1 == buffer.size())
    throw InputError({{file, number, "", "the line has more than 64 KiB",
                       "name a file of lines of numbers, separated by commas", "file.long-line"}});
  const bool has_end = !stream.eof();
  line.assign(buffer.data(), count - (has_end && count > 0 ? 1 : 0));
  return !stream.fail();
}

std::vector<std::string_view> csv_cells(std::string_view line) {
  std::vector<std::string_view> cells;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(','), line.size());
    const std::string_view cell = line.substr(0, end);
    const auto first = cell.find_first_not_of(" \t\r"), last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == cell.npos ? cell.substr(0, 0) : cell.substr(first, last - first + 1));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return cells;
}

}  // namespace twinarm
