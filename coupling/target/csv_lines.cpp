#include "coupling/target/csv_lines.h"

#include <array>

#include "solver/support/diagnostics.h"

namespace twinarm {

bool next_line(std::istream& stream, std::string& line, const std::string& file, int number) {
  std::array<char, 1 << 16> buffer;
  stream.getline(buffer.data(), buffer.size());
  const auto count = static_cast<std::size_t>(stream.gcount());
  if (stream.fail() && count + 1 == buffer.size())
    throw InputError({{file, number, "", "the line has more than 64 KiB",
                       "name a file of lines of numbers, separated by commas"}});
  const bool has_end = !stream.eof();
  line.assign(buffer.data(), count - (has_end && count > 0 ? 1 : 0));
  return !stream.fail();
}

}  // namespace twinarm
