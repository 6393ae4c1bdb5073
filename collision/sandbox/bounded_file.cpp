#include "collision/sandbox/bounded_file.h"

#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {

std::string read_bounded_file(const std::filesystem::path& file, std::size_t max_mib,
                              const std::string& fix) {
  const auto refuse = [&](const std::string& problem, const std::string& remedy,
                          std::string_view code) {
    throw InputError({{file.string(), 0, "", problem, remedy, code}});
  };
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    refuse("the file does not exist", "check the path", "file.missing");
  if (std::filesystem::file_size(file, ignored) > max_mib << 20)
    refuse("the file is larger than " + std::to_string(max_mib) + " MiB", fix, "file.too-large");
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    refuse("the file cannot be read", "check its permissions (ls -l)", "file.unreadable");
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return std::move(bytes).str();
}

}  // namespace twinarm
