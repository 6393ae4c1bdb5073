#include "app/support/files.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace twinarm {
namespace {

// Path of the Python module, or of the program itself.
std::filesystem::path library_of_this_code() {
  Dl_info found;
  const bool is_known = dladdr(reinterpret_cast<const void*>(&find_assets), &found) != 0;
  return is_known && found.dli_fname ? found.dli_fname : "";
}

InputError cannot_write(const std::filesystem::path& path, const std::string& why,
                        const char* option) {
  return InputError({{path.string(), 0, "", "cannot be written" + why,
                      std::string("choose a writable folder with ") + option, "file.unwritable"}});
}

// ": why" the folder cannot be written or made; empty if it can.
std::string folder_fault(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(there, error) && there.has_relative_path())
    there = there.parent_path();
  if (!std::filesystem::is_directory(there, error))
    return ": " + there.string() + " is not a folder";
  if (access(there.c_str(), W_OK | X_OK) == 0) return "";
  return ": no permission in " + there.lexically_normal().string();
}

std::filesystem::path make_temporary_folder(const std::string& name) {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error)  // the message does not name the folder
    if (const char* given = std::getenv("TMPDIR")) folder = given;
  std::string made = (folder / (name + "-XXXXXX")).string();
  if (!error && mkdtemp(made.data())) return made;
  throw InputError(
      {{folder.string(), 0, "temporary files",
        "cannot make a folder: " + (error ? error.message() : std::string(std::strerror(errno))),
        "set TMPDIR to a writable folder with free space", "file.unwritable"}});
}

}  // namespace

std::filesystem::path find_assets(const std::filesystem::path& given) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> places;
  if (!given.empty()) {
    places.push_back(given);
  } else {
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    places.push_back(program.parent_path() / "../../assets");      // build/PRESET/twinarm
    places.push_back(program.parent_path() / "../share/twinarm");  // bin/twinarm, installed
    if (const fs::path library = library_of_this_code(); library.extension() == ".so") {
      places.push_back(library.parent_path() /
                       "../../../../assets");  // build/PRESET/python/twinarm
      places.push_back(library.parent_path() /
                       "../../../../share/twinarm");  // lib/python3.11/dist-packages/twinarm
    }
    places.push_back(fs::current_path(error) / "assets");
  }
  for (const fs::path& place : places)
    if (fs::is_directory(place / "robots", error)) return fs::weakly_canonical(place);
  throw InputError(
      {{places.front().string(), 0, "assets", "the folder with the robots does not exist",
        "run from the project's folder, or give --assets", "file.no-assets"}});
}

std::filesystem::path find_input(const std::filesystem::path& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (name.empty() || *name.begin() != "assets" || fs::exists(name, error)) return name;
  try {
    const fs::path found = find_assets() / name.lexically_relative("assets");
    return fs::exists(found, error) ? found : name;
  } catch (const InputError&) {  // no assets
    return name;
  }
}

void require_writable_folder(const std::filesystem::path& folder, const char* option) {
  if (const std::string why = folder_fault(folder); !why.empty())
    throw cannot_write(folder, why, option);
}

void make_folder(const std::filesystem::path& folder, const char* option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw cannot_write(folder, ": " + error.message(), option);
}

TemporaryFiles::TemporaryFiles(const std::string& name)
    : folder_(make_temporary_folder(name)), listed_(folder_) {}

TemporaryFiles::~TemporaryFiles() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void TemporaryFiles::make_again() const {
  mkdir(folder_.c_str(), S_IRWXU);
}

void check_place(const std::filesystem::path& file, const char* option, DiagnosticList& faults) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status))
    faults.add({file.string(), 0, option, "is a folder", "name a file in it", "file.is-folder"});
  else if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    faults.add({file.string(), 0, option, "is a device or a pipe, which a file would replace",
                "name a file", "file.no-file"});
  else if (const std::string why = folder_fault(folder_of(file)); !why.empty())
    faults.add(cannot_write(file, why, option).faults());
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto whole = [&](const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
  };
  return !whole(a).empty() && whole(a) == whole(b);
}

void fill_closed_streams() {
  // open() returns the lowest free descriptor. stdout is opened for reading, so that printing
  // fails.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void check_stdout() {
  const bool was_bad = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !was_bad) return;
  const std::string why = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
  throw InputError("stdout", "cannot be written" + why,
                   "check whether it is closed or the disk is full", "file.stdout");
}

}  // namespace twinarm
