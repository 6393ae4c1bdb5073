#include "solver/support/input_file.h"

#include <sstream>
#include <string_view>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& problem,
                         const std::string& fix, std::string_view code) {
  throw InputError({{file.string(), 0, "", problem, fix, code}});
}

}  // namespace

std::ifstream open_file(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto type = std::filesystem::status(file, ignored).type();
  using std::filesystem::file_type;
  if (type == file_type::not_found)
    refuse(file, "the file does not exist", "check the path", "file.missing");
  if (type == file_type::directory)
    refuse(file, "is a folder", "name a file in it", "file.is-folder");
  if (type != file_type::regular &&
      type != file_type::none)  // none: of a folder without permission
    refuse(file, "is a device or a pipe", "name a file", "file.no-file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    refuse(file, "the file cannot be read", "check its permissions: ls -l shows them",
           "file.unreadable");
  return stream;
}

std::string read_whole_file(const std::filesystem::path& file) {
  std::stringstream content;
  content << open_file(file).rdbuf();
  return std::move(content).str();
}

std::string read_bounded_file(const std::filesystem::path& file, std::size_t max_mib,
                              const std::string& fix) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored) &&
      std::filesystem::file_size(file, ignored) > max_mib << 20)
    refuse(file, "the file is larger than " + std::to_string(max_mib) + " MiB", fix,
           "file.too-large");
  return read_whole_file(file);
}

}  // namespace twinarm
