#include "solver/support/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "solver/support/diagnostics.h"

namespace twinarm {

void write_whole_file(const std::filesystem::path& file, const std::string& bytes) {
  // The process id makes the temporary name unique among programs that write the same file.
  const std::filesystem::path temporary = file.string() + "." + std::to_string(::getpid()) + ".tmp";
  std::error_code error, ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);  // opening reports a failure
  errno = 0;
  if (std::filesystem::is_other(std::filesystem::status(file, ignored))) {
    errno = ENODEV;  // a device or a pipe, which the file would replace
  } else {
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (out) std::filesystem::rename(temporary, file, error);
    if (out && !error) return;
  }
  const std::string why = error ? error.message() : errno != 0 ? std::strerror(errno) : "";
  std::filesystem::remove(temporary, ignored);
  throw InputError(
      {{file.string(), 0, "", "the file cannot be written" + (why.empty() ? "" : ": " + why),
        "choose an existing, writable folder with free space", "file.unwritable"}});
}

}  // namespace twinarm
