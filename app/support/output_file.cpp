#include "app/support/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace twinarm {
namespace {

InputError cannot_write(const std::filesystem::path& path, const std::string& why,
                        const char* option) {
  return InputError(
      {{path.string(), 0, "", "cannot be written" + why,
        std::string("choose a folder that can be written, with ") + option, "file.unwritable"}});
}

}  // namespace

void require_writable_folder(const std::filesystem::path& folder, const char* option) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(there, error) && there.has_relative_path())
    there = there.parent_path();
  if (!std::filesystem::is_directory(there, error))
    throw cannot_write(folder, ": " + there.string() + " is not a folder", option);
  if (access(there.c_str(), W_OK | X_OK) != 0)
    throw cannot_write(folder, ": no permission in " + there.string(), option);
}

void make_folder(const std::filesystem::path& folder, const char* option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw cannot_write(folder, ": " + error.message(), option);
}

std::filesystem::path make_temporary_folder(const std::string& name) {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error)  // it says that it is none, not which
    if (const char* given = std::getenv("TMPDIR")) folder = given;
  std::string made = (folder / (name + "-XXXXXX")).string();
  if (!error && mkdtemp(made.data())) return made;
  throw InputError(
      {{folder.string(), 0, "temporary files",
        "no folder can be made there: " +
            (error ? error.message() : std::string(std::strerror(errno))),
        "let TMPDIR name a folder that can be written and has room", "file.unwritable"}});
}

void check_place(const std::filesystem::path& file, FaultList& faults) {
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (std::filesystem::is_directory(file, error))
    faults.add({file.string(), 0, "", "is a folder", "name a file in it", "file.is-folder"});
  else if (!std::filesystem::is_directory(folder, error))
    faults.add({file.string(), 0, "", "there is no folder '" + folder.string() + "'",
                "make it: mkdir -p " + folder.string(), "file.no-folder"});
  else if (access(folder.c_str(), W_OK | X_OK) != 0)
    faults.add({file.string(), 0, "", "the file cannot be written: no permission in its folder",
                "choose a folder that can be written", "file.unwritable"});
}

std::ifstream open_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw InputError({{file.string(), 0, "", "the file does not exist",
                       "check the name, and the folder that you are in", "file.missing"}});
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(
        {{file.string(), 0, "", "is a folder", "name a file in it", "file.is-folder"}});
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError({{file.string(), 0, "", "the file cannot be read",
                       "check its permissions: ls -l shows them", "file.unreadable"}});
  return stream;
}

std::string read_whole_file(const std::filesystem::path& file) {
  std::stringstream content;
  content << open_file(file).rdbuf();
  return std::move(content).str();
}

}  // namespace twinarm
