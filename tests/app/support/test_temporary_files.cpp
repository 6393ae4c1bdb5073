// Temporary files of a program that a signal ends.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <vector>

#include "app/support/files.h"
#include "app/support/progress.h"
#include "tests/support/temporary_folder.h"

namespace twinarm {
namespace {

// Writes files, is asked to end, and does not look at the flag.
[[noreturn]] void write_without_end(const fs::path& folder) {
  catch_interrupts();
  setenv("TMPDIR", folder.c_str(), 1);
  const TemporaryFiles several("several");
  fs::create_directories(several.folder() / "inner/folder");
  std::ofstream(several.folder() / "inner/folder/file") << "text";
  UnfinishedFile removed(folder / "removed", folder / "removed.tmp");
  UnfinishedFile kept(folder / "kept", folder / "kept.part");
  kept.keep();
  UnfinishedFile finished(folder / "finished", folder / "finished.tmp");
  finished.finish();
  removed.write("half of it");
  std::raise(SIGTERM);
  for (volatile bool goes_on = true; goes_on;)
    if (::read(-1, nullptr, 0) == 0) break;  // ThreadSanitizer delivers signals in calls alone
  _exit(0);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

TEST_CASE("temporary files: none is left by a program that a signal ends at once") {
  const TemporaryFolder folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) write_without_end(folder.path());
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WEXITSTATUS(status) == 130);
  CHECK(names_in(folder.path()) == std::vector<std::string>{"finished", "kept.part"});
}

TEST_CASE(
    "temporary files: a forked process removes none of its parent, and any number is listed") {
  const TemporaryFolder folder;
  std::vector<std::unique_ptr<TemporaryPath>> many;
  for (int n = 0; n < 100; ++n)
    many.push_back(
        std::make_unique<TemporaryPath>(folder.write("listed" + std::to_string(n), "text")));
  many.push_back(std::make_unique<TemporaryPath>(std::string(5000, 'x')));
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    remove_temporary_paths();
    _exit(0);
  }
  REQUIRE(waitpid(child, nullptr, 0) == child);
  CHECK(names_in(folder.path()).size() == 100);
  many.clear();
  const TemporaryPath next(folder.write("next", "text"));
  remove_temporary_paths();
  CHECK(names_in(folder.path()).size() == 100);
  CHECK_FALSE(fs::exists(folder.path() / "next"));
}

}  // namespace
}  // namespace twinarm
