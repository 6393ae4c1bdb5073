#include "collision/sandbox/fork_server.h"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <string_view>
#include <system_error>
#include <utility>

#include "collision/sandbox/child_socket.h"
#include "solver/support/state_archive.h"

namespace twinarm {
namespace {

// Of the server: -1 without one. It receives sockets, one for each order, and forks a process for
// each, which runs the order in a child with limits and answers.
std::atomic<int> server = -1;

// A message of one byte that carries a descriptor.
class DescriptorMessage {
 public:
  explicit DescriptorMessage(int sent = -1) {
    message_.msg_iov = &content_;
    message_.msg_iovlen = 1;
    message_.msg_control = control_.data();
    message_.msg_controllen = control_.size();
    if (sent < 0) return;
    cmsghdr* const header = CMSG_FIRSTHDR(&message_);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof sent);
    std::memcpy(CMSG_DATA(header), &sent, sizeof sent);
  }
  DescriptorMessage(const DescriptorMessage&) = delete;
  DescriptorMessage& operator=(const DescriptorMessage&) = delete;
  bool send(int to) { return sendmsg(to, &message_, MSG_NOSIGNAL) == 1; }
  int receive(int from) {  // -1: the other end is closed
    ssize_t got = 0;
    while ((got = recvmsg(from, &message_, MSG_CMSG_CLOEXEC)) < 0 && errno == EINTR) continue;
    const cmsghdr* const header = CMSG_FIRSTHDR(&message_);
    int descriptor = -1;
    if (got == 1 && header != nullptr)
      std::memcpy(&descriptor, CMSG_DATA(header), sizeof descriptor);
    return descriptor;
  }

 private:
  char byte_ = 0;
  iovec content_{&byte_, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control_{};
  msghdr message_{};
};

// Functions have the same addresses in a copy of the process.
struct Order {
  std::uintptr_t work = 0;
  std::string argument;
  ChildLimits limits;

  void serialize(StateArchive& archive) {
    archive.visit(work, argument, limits.cpu_seconds, limits.wall_seconds, limits.bytes);
  }
};

// First byte of an answer: what follows, bytes or the error.
constexpr std::string_view kBytes = " ", kFault = "!";

void answer(int socket) {
  StateArchive received(receive_all(socket, std::chrono::seconds(10)).value_or(""));
  Order order;
  order.serialize(received);
  const ChildResult result =
      run_in_fork(reinterpret_cast<ChildWork>(order.work), order.argument, order.limits);
  const bool is_done = result.fault.empty();
  if (send_all(socket, is_done ? kBytes : kFault))
    send_all(socket, is_done ? result.bytes : result.fault);
}

[[noreturn]] void serve(int orders) {
  std::signal(SIGCHLD, SIG_IGN);  // reaps children
  discard_output();
  orders = close_others(orders);
  while (true) {
    const int socket = DescriptorMessage().receive(orders);
    if (socket < 0) _exit(0);
    if (fork() == 0) {
      close(orders);
      std::signal(SIGCHLD, SIG_DFL);
      try {
        answer(socket);
      } catch (const std::exception&) {  // no process, no memory: no answer
      }
      _exit(0);
    }
    close(socket);
  }
}

}  // namespace

bool has_fork_server() {
  return server >= 0;
}

ChildResult run_by_server(ChildWork work, const std::string& argument, const ChildLimits& limits) {
  const auto [mine, theirs] = make_sockets();
  Order order{reinterpret_cast<std::uintptr_t>(work), argument, limits};
  StateArchive sent;
  order.serialize(sent);
  const bool is_sent = DescriptorMessage(theirs).send(server);
  close(theirs);
  std::string answer;
  if (is_sent && send_all(mine, sent.bytes()) && shutdown(mine, SHUT_WR) == 0)
    answer = receive_all(mine, std::chrono::seconds(limits.wall_seconds + 20)).value_or("");
  close(mine);
  if (answer.empty()) throw std::system_error(EAGAIN, std::generic_category(), "fork");
  const bool is_done = answer.starts_with(kBytes);
  answer.erase(0, 1);
  return is_done ? ChildResult{std::move(answer), ""} : ChildResult{"", std::move(answer)};
}

ForkServer::ForkServer() {
  const auto [mine, theirs] = make_sockets();
  process_ = fork();
  if (process_ < 0) {
    close(mine), close(theirs);
    throw_errno("fork");
  }
  if (process_ == 0) serve(theirs);
  close(theirs);
  server = mine;
}

ForkServer::~ForkServer() {
  close(server.exchange(-1));
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

}  // namespace twinarm
