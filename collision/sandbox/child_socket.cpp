#include "collision/sandbox/child_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "solver/support/sanitized.h"

namespace twinarm {
namespace {

using Clock = std::chrono::steady_clock;

// Waits until `end` for bytes or end of file; false on timeout and interrupt.
bool wait_for_bytes(int socket, Clock::time_point end, bool (*is_interrupted)()) {
  constexpr long kWait = 200;  // [ms]
  while (!is_interrupted || !is_interrupted()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{socket, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(std::min(left, kWait))) > 0) return true;
  }
  return false;
}

// More than the largest image and mesh. Of a child that was taken over no more is read.
constexpr std::size_t kMaxResult = std::size_t{320} << 20;

}  // namespace

SocketPair make_sockets() {
  std::array<int, 2> ends;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw_errno("socketpair");
  return {ends[0], ends[1]};
}

void throw_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

ssize_t send_without_signal(int socket, const void* bytes, std::size_t count) {
  return send(socket, bytes, count, MSG_NOSIGNAL);
}

bool send_all(int socket, std::string_view bytes, SendSome send_some) {
  while (!bytes.empty()) {
    const ssize_t sent = send_some(socket, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::optional<std::string> receive_all(int socket, std::chrono::seconds timeout,
                                       bool (*is_interrupted)()) {
  const auto end = Clock::now() + timeout;
  std::string bytes;
  std::array<char, 1 << 16> some;
  while (wait_for_bytes(socket, end, is_interrupted)) {
    const ssize_t got = read(socket, some.data(), some.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(some.data(), static_cast<std::size_t>(got));
    if (bytes.size() > kMaxResult) return std::nullopt;
  }
  return std::nullopt;
}

void discard_output() {
  if (kSanitized) return;
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (null < 0) return;
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
}

int close_others(int socket) {
  constexpr int kKept = STDERR_FILENO + 1;
  if (socket != kKept) dup2(socket, kKept);
  close_range(kKept + 1, ~0u, 0);
  return kKept;
}

}  // namespace twinarm
