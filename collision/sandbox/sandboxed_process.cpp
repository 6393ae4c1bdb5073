#include "collision/sandbox/sandboxed_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>

#include "collision/sandbox/system_call_filter.h"

namespace twinarm {
namespace {

// Exit codes of the child.
constexpr int kDone = 0, kOutOfMemory = 3, kThrew = 4, kCannotSend = 5;

bool is_child = false;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // sanitizers reserve terabytes of address space
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void limit(int what, rlim_t max) {
  const rlimit both{max, max};
  setrlimit(static_cast<__rlimit_resource_t>(what), &both);
}

std::size_t address_space_in_use() {  // [bytes]
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

bool send(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = write(pipe, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

// Suppresses messages of libraries; the parent reports the error.
void discard_output() {
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (null < 0) return;
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
}

// Closes what the parent has open but the standard streams and the pipe; returns its new number.
int close_others(int pipe) {
  constexpr int kPipe = STDERR_FILENO + 1;
  if (pipe != kPipe) dup2(pipe, kPipe);
  close_range(kPipe + 1, ~0u, 0);
  return kPipe;
}

[[noreturn]] void run_child(const std::function<std::string()>& work, const ChildLimits& limits,
                            int pipe) {
  is_child = true;
  // Default signal handlers: the child ends at once. What the parent ignores, as under nohup, stays
  // ignored.
  for (const int each :
       {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
    if (std::signal(each, SIG_DFL) == SIG_IGN) std::signal(each, SIG_IGN);
  if (!kSanitized) discard_output();
  pipe = close_others(pipe);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpu_seconds);
  if (!kSanitized) {
    limit(RLIMIT_AS, address_space_in_use() + limits.bytes);
    forbid_side_effects();
  }
  int end = kDone;
  try {
    if (!send(pipe, work())) end = kCannotSend;
  } catch (const std::bad_alloc&) {
    end = kOutOfMemory;
  } catch (...) {
    end = kThrew;
  }
  _exit(end);  // no destructors, no flushing of the parent's buffers
}

using Clock = std::chrono::steady_clock;

// Waits until `end` for bytes or end of file; false on timeout.
bool wait_for_bytes(int pipe, Clock::time_point end) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{pipe, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(left)) > 0) return true;
  }
}

// More than the largest image and mesh. Of a child that was taken over no more is read.
constexpr std::size_t kMaxResult = std::size_t{320} << 20;

// Empty on timeout and of a child that sends too much.
std::optional<std::string> receive(int pipe, Clock::time_point end) {
  std::string bytes;
  std::array<char, 1 << 16> some;
  while (wait_for_bytes(pipe, end)) {
    const ssize_t got = read(pipe, some.data(), some.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(some.data(), static_cast<std::size_t>(got));
    if (bytes.size() > kMaxResult) return std::nullopt;
  }
  return std::nullopt;
}

std::string fault_of(int status, const ChildLimits& limits) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGKILL)
      return "needs more than " + std::to_string(limits.cpu_seconds) + " s of CPU time";
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) return "was interrupted";
    return "crashes";
  }
  switch (WEXITSTATUS(status)) {
    case kDone:
      return "";
    case kOutOfMemory:
      return "needs more than " + std::to_string(limits.bytes >> 30) + " GiB of memory";
    default:
      return "fails";
  }
}

}  // namespace

ChildResult run_limited(const std::function<std::string()>& work, const ChildLimits& limits) {
  if (is_child) return {work(), ""};
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]), close(ends[1]);
    fail("fork");
  }
  if (child == 0) {
    close(ends[0]);
    run_child(work, limits, ends[1]);
  }
  close(ends[1]);
  const auto bytes = receive(ends[0], Clock::now() + std::chrono::seconds(limits.wall_seconds));
  if (!bytes) kill(child, SIGKILL);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail("waitpid");
  if (!bytes) return {"", "does not end within " + std::to_string(limits.wall_seconds) + " s"};
  const std::string fault = fault_of(status, limits);
  return {fault.empty() ? *bytes : "", fault};
}

}  // namespace twinarm
