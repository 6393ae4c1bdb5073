// Whole files, written by several threads.
#include "solver/support/atomic_file.h"

#include <doctest/doctest.h>

#include <atomic>
#include <iterator>
#include <thread>
#include <vector>

#include "solver/support/diagnostics.h"
#include "tests/support/temporary_folder.h"

using namespace twinarm;

TEST_CASE("atomic file: threads that write one file all succeed, and the file is one of theirs") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "shared.txt";
  constexpr int kThreads = 4, kTimes = 25;
  std::atomic<int> failed = 0;
  std::vector<std::thread> writers;
  for (int w = 0; w < kThreads; ++w)
    writers.emplace_back([&, text = std::string(20'000, static_cast<char>('a' + w))] {
      for (int n = 0; n < kTimes; ++n) {
        try {
          write_whole_file(file, text);
        } catch (const InputError&) {
          ++failed;
        }
      }
    });
  for (std::thread& writer : writers) writer.join();
  CHECK(failed == 0);
  const std::string text = text_of(file);
  CHECK(text.size() == 20'000);
  CHECK(text.find_first_not_of(text.front()) == std::string::npos);
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}
