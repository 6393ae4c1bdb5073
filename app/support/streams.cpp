#include "app/support/streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "solver/support/diagnostics.h"

namespace twinarm {

void fill_closed_streams() {
  // What is opened gets the lowest number that is free. Not for writing on stdout: what is printed
  // there would be lost without a word.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void check_stdout() {
  const bool was_bad = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !was_bad) return;
  const std::string why = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
  throw InputError(
      {{"", 0, "stdout", "what was printed did not all get out" + why,
        "is it closed, or the disk full? Let it go to a file that has room", "file.stdout"}});
}

}  // namespace twinarm
