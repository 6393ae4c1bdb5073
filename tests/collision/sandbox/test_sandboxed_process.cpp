// Work in child processes that crashes, does not terminate or is taken over.
#include "collision/sandbox/sandboxed_process.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "collision/sandbox/fork_server.h"
#include "solver/support/sanitized.h"
#include "tests/support/temporary_folder.h"

using namespace twinarm;

TEST_CASE("work in a child returns its bytes, many or none") {
  CHECK(run_limited([](const std::string&) { return std::string(); }, "").bytes.empty());
  std::string many;
  for (int i = 0; i < 1000000; ++i) many += std::to_string(i);
  const ChildResult result = run_limited([](const std::string& text) { return text; }, many);
  CHECK(result.fault.empty());
  CHECK(result.bytes == many);
}

TEST_CASE("a child that crashes, throws or does not terminate gives an error message") {
  CHECK(run_limited([](const std::string&) -> std::string { std::abort(); }, "").fault ==
        "crashes");
  CHECK(run_limited([](const std::string&) -> std::string { throw 7; }, "").fault == "fails");
  const ChildResult slow = run_limited(
      [](const std::string&) -> std::string {
        for (std::atomic<int> i = 0;;) ++i;
      },
      "", {.cpu_seconds = 1});
  CHECK(slow.fault.find("more than 1 s") != std::string::npos);
  CHECK(slow.bytes.empty());
}

TEST_CASE("a child that hangs ends as soon as its parent is interrupted") {
  const ChildLimits limits;
  const auto begin = std::chrono::steady_clock::now();
  end_children_when([] { return true; });
  const ChildResult hangs = run_limited(
      [](const std::string&) -> std::string {
        for (;;) pause();
      },
      "", limits);
  end_children_when(nullptr);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(limits.wall_seconds));
  CHECK(hangs.fault == "was interrupted");
  CHECK(hangs.bytes.empty());
}

#ifndef TWINARM_SANITIZED
namespace {

constexpr int kOpenInParent = 100;

// What a child may do: '+' if it succeeds.
std::string try_side_effects(const std::string& file) {
  const auto fails = [](long code) { return code < 0 && errno == EPERM ? '-' : '+'; };
  const char* const words[] = {"/bin/true", nullptr};
  return std::string{fails(open(file.c_str(), O_WRONLY)),
                     fails(unlink(file.c_str())),
                     fails(execv(words[0], const_cast<char* const*>(words))),
                     fails(fork()),
                     fails(socket(AF_INET, SOCK_STREAM, 0)),
                     fcntl(kOpenInParent, F_GETFD) < 0 ? '-' : '+',
                     open(file.c_str(), O_RDONLY) >= 0 ? 'r' : '?'};
}

}  // namespace

TEST_CASE("a child cannot write files, start programs or open connections, and sees no open file") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("kept", "");
  REQUIRE(dup3(STDIN_FILENO, kOpenInParent, O_CLOEXEC) == kOpenInParent);
  const ChildResult result = run_limited(try_side_effects, file.string());
  CHECK(result.fault.empty());
  CHECK(result.bytes == "------r");
  const ForkServer server;
  CHECK(run_limited(try_side_effects, file.string()).bytes == "------r");
  close(kOpenInParent);
}
#endif

TEST_CASE("a signal that its parent ignores does not end a child") {
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does
  const auto hang_up = [](const std::string&) { return std::to_string(std::raise(SIGHUP)); };
  CHECK(run_limited(hang_up, "").bytes == "0");
  std::signal(SIGHUP, SIG_DFL);
  CHECK(run_limited(hang_up, "").fault == "was interrupted");
  std::signal(SIGHUP, before);
}

TEST_CASE("a child that waits forever is killed, with an error message") {
  const ChildResult waits = run_limited(
      [](const std::string&) -> std::string {
        while (true) pause();
      },
      "", {.wall_seconds = 1});
  CHECK(waits.fault == "does not end within 1 s");
  CHECK(waits.bytes.empty());
}

namespace {

std::mutex held;

std::string wait_for_held(const std::string& text) {
  const std::lock_guard lock(held);
  return text;
}

}  // namespace

TEST_CASE("a child of a fork server waits for no lock that a thread of its parent holds") {
  const ForkServer server;
  const std::lock_guard lock(held);
  std::vector<std::jthread> others;
  for (int i = 0; i < 4; ++i)
    others.emplace_back([i] {
      for (int k = 0; k < 20; ++k) {
        const std::string text = std::to_string(1000 * i + k);
        const ChildResult result = run_limited(wait_for_held, text, {.wall_seconds = 10});
        CHECK(result.fault == "");
        CHECK(result.bytes == text);
      }
    });
}

TEST_CASE("a fork server reports errors of children like a direct child, and ends with its owner") {
  const auto crash = [](const std::string&) -> std::string { std::abort(); };
  const auto sleep = [](const std::string&) -> std::string {
    while (true) pause();
  };
  const auto parent = [](const std::string&) { return std::to_string(getppid()); };
  std::string supervisor;
  {
    const ForkServer server;
    CHECK(run_limited(crash, "").fault == "crashes");
    CHECK(run_limited(sleep, "", {.wall_seconds = 1}).fault == "does not end within 1 s");
    supervisor = run_limited(parent, "").bytes;
    CHECK(supervisor != std::to_string(getpid()));
  }
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
  CHECK(errno == ECHILD);
  CHECK(run_limited(parent, "").bytes == std::to_string(getpid()));
}
