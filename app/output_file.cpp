#include "app/output_file.h"

#include <fstream>
#include <sstream>

#include "solver/fault.h"

namespace twinarm {
namespace {

InputError cannot_write(const std::filesystem::path& path, const std::string& why) {
  return InputError({{path.string(), 0, "", "cannot be written" + why,
                      "choose a folder that can be written, with --out"}});
}

}  // namespace

void write_file(const std::filesystem::path& file, const std::string& content) {
  std::filesystem::path temporary = file;
  temporary += ".tmp";
  std::error_code error;
  {
    std::ofstream stream(temporary, std::ios::binary);
    stream << content;
    if (!stream.flush()) {
      std::filesystem::remove(temporary, error);
      throw cannot_write(file, "");
    }
  }
  std::filesystem::rename(temporary, file, error);
  if (error) {
    std::filesystem::remove(temporary);
    throw cannot_write(file, ": " + error.message());
  }
}

void require_writable_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw cannot_write(folder, ": " + error.message());
  const std::filesystem::path probe = folder / ".twinarm-probe";
  {
    std::ofstream stream(probe);
    if (!stream) throw cannot_write(folder, "");
  }
  std::filesystem::remove(probe, error);
}

std::string read_whole_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError({{file.string(), 0, "", "the file cannot be read", ""}});
  std::stringstream content;
  content << stream.rdbuf();
  return content.str();
}

}  // namespace twinarm
