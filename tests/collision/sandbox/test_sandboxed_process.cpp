// Work in child processes that crashes, does not terminate or is taken over.
#include "collision/sandbox/sandboxed_process.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/sanitized.h"
#include "tests/support/temporary_folder.h"

using namespace twinarm;

TEST_CASE("work in a child returns its bytes, many or none") {
  CHECK(run_limited([] { return std::string(); }).bytes.empty());
  std::string many;
  for (int i = 0; i < 1000000; ++i) many += std::to_string(i);
  const ChildResult result = run_limited([&] { return many; });
  CHECK(result.fault.empty());
  CHECK(result.bytes == many);
}

TEST_CASE("a child that crashes, throws or does not terminate gives an error message") {
  CHECK(run_limited([]() -> std::string { std::abort(); }).fault == "crashes");
  CHECK(run_limited([]() -> std::string { throw 7; }).fault == "fails");
  const ChildResult slow = run_limited(
      []() -> std::string {
        for (std::atomic<int> i = 0;;) ++i;
      },
      {.cpu_seconds = 1});
  CHECK(slow.fault.find("more than 1 s") != std::string::npos);
  CHECK(slow.bytes.empty());
}

TEST_CASE("a child cannot write files, start programs or open connections, and sees no open file") {
#ifndef TWINARM_SANITIZED
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("kept", "");
  const int open_here = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 100);
  const ChildResult result = run_limited([&] {
    const auto fails = [](long code) { return code < 0 && errno == EPERM ? '-' : '+'; };
    const char* const words[] = {"/bin/true", nullptr};
    return std::string{fails(open(file.c_str(), O_WRONLY)),
                       fails(unlink(file.c_str())),
                       fails(execv(words[0], const_cast<char* const*>(words))),
                       fails(fork()),
                       fails(socket(AF_INET, SOCK_STREAM, 0)),
                       fcntl(open_here, F_GETFD) < 0 ? '-' : '+',
                       open(file.c_str(), O_RDONLY) >= 0 ? 'r' : '?'};
  });
  CHECK(result.fault.empty());
  CHECK(result.bytes == "------r");
  close(open_here);
#endif
}

TEST_CASE("a signal that its parent ignores does not end a child") {
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does
  CHECK(run_limited([] { return std::to_string(std::raise(SIGHUP)); }).bytes == "0");
  std::signal(SIGHUP, SIG_DFL);
  CHECK(run_limited([] { return std::to_string(std::raise(SIGHUP)); }).fault == "was interrupted");
  std::signal(SIGHUP, before);
}

TEST_CASE("a child that waits forever is killed, with an error message") {
  const ChildResult waits = run_limited(
      []() -> std::string {
        while (true) pause();
      },
      {.wall_seconds = 1});
  CHECK(waits.fault == "does not end within 1 s");
  CHECK(waits.bytes.empty());
}

#ifndef TWINARM_SANITIZED
namespace {

// Takes the locks that parsers take: of the heap, of streams and locales, of exceptions.
std::string busy_work(const std::filesystem::path& file) {
  std::ostringstream text;
  for (int i = 0; i < 20; ++i) {
    const std::vector<std::string> rows(100, std::string(100, 'x'));
    try {
      text << std::ifstream(file).rdbuf() << std::stod("0.5");
      throw std::runtime_error(rows.back());
    } catch (const std::runtime_error& error) {
      text << error.what();
    }
  }
  return text.str();
}

}  // namespace

TEST_CASE("a child waits for no lock that another thread of its parent holds") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("read", "words");
  const std::string expected = busy_work(file);
  std::atomic<bool> is_over = false;
  std::vector<std::jthread> others;
  for (int i = 0; i < 4; ++i)
    others.emplace_back([&] {
      while (!is_over) busy_work(file);
    });
  for (int i = 0; i < 300; ++i) {
    const ChildResult result = run_limited([&] { return busy_work(file); });
    REQUIRE(result.fault == "");
    REQUIRE(result.bytes == expected);
  }
  is_over = true;
}
#endif
