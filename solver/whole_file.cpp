#include "solver/whole_file.h"

#include <unistd.h>

#include <fstream>

#include "solver/fault.h"

namespace twinarm {

void write_whole_file(const std::filesystem::path& file, const std::string& bytes) {
  // The process number keeps two programs that write the same file apart.
  const std::filesystem::path temporary = file.string() + "." + std::to_string(::getpid()) + ".tmp";
  std::error_code error;
  {
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (out) std::filesystem::rename(temporary, file, error);
    if (out && !error) return;
  }
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw InputError({{file.string(), 0, "", "the file cannot be written",
                     "choose a folder that exists and can be written"}});
}

}  // namespace twinarm
