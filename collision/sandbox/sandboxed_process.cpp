#include "collision/sandbox/sandboxed_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <new>
#include <utility>

#include "collision/sandbox/child_socket.h"
#include "collision/sandbox/fork_server.h"
#include "collision/sandbox/system_call_filter.h"
#include "solver/support/sanitized.h"

namespace twinarm {
namespace {

// Exit codes of the child.
constexpr int kDone = 0, kOutOfMemory = 3, kThrew = 4, kCannotSend = 5;

constexpr const char* kInterrupted = "was interrupted";

bool is_child = false;
bool (*is_interrupted)() = nullptr;

void limit(int what, rlim_t max) {
  const rlimit both{max, max};
  setrlimit(static_cast<__rlimit_resource_t>(what), &both);
}

std::size_t address_space_in_use() {  // [bytes]
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

[[noreturn]] void run_child(ChildWork work, const std::string& argument, const ChildLimits& limits,
                            int socket) {
  is_child = true;
  // Default signal handlers: the child ends at once. What the parent ignores, as under nohup, stays
  // ignored.
  for (const int each :
       {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
    if (std::signal(each, SIG_DFL) == SIG_IGN) std::signal(each, SIG_IGN);
  discard_output();
  socket = close_others(socket);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpu_seconds);
  if (!kSanitized) {
    limit(RLIMIT_AS, address_space_in_use() + limits.bytes);
    forbid_side_effects();
  }
  int end = kDone;
  try {
    // write(), since the filter forbids send().
    if (!send_all(socket, work(argument), ::write)) end = kCannotSend;
  } catch (const std::bad_alloc&) {
    end = kOutOfMemory;
  } catch (...) {
    end = kThrew;
  }
  _exit(end);  // no destructors, no flushing of the parent's buffers
}

std::string fault_of(int status, const ChildLimits& limits) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGKILL)
      return "needs more than " + std::to_string(limits.cpu_seconds) + " s of CPU time";
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) return kInterrupted;
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

void end_children_when(bool (*check)()) {
  is_interrupted = check;
}

ChildResult run_in_fork(ChildWork work, const std::string& argument, const ChildLimits& limits) {
  const auto [mine, theirs] = make_sockets();
  const pid_t child = fork();
  if (child < 0) {
    close(mine), close(theirs);
    throw_errno("fork");
  }
  if (child == 0) run_child(work, argument, limits, theirs);
  close(theirs);
  auto bytes = receive_all(mine, std::chrono::seconds(limits.wall_seconds), is_interrupted);
  if (!bytes) kill(child, SIGKILL);
  close(mine);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw_errno("waitpid");
  if (!bytes && is_interrupted && is_interrupted()) return {"", kInterrupted};
  if (!bytes) return {"", "does not end within " + std::to_string(limits.wall_seconds) + " s"};
  const std::string fault = fault_of(status, limits);
  return {fault.empty() ? std::move(*bytes) : "", fault};
}

ChildResult run_limited(ChildWork work, const std::string& argument, const ChildLimits& limits) {
  if (is_child) return {work(argument), ""};
  return has_fork_server() ? run_by_server(work, argument, limits)
                           : run_in_fork(work, argument, limits);
}

}  // namespace twinarm
