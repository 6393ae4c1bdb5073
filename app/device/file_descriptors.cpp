#include "app/device/file_descriptors.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace twinarm {
namespace {

// Of a pending connection; 0: connected.
int connect_error(int socket, double timeout, int stop) {
  pollfd ready[2] = {{socket, POLLOUT, 0}, {stop, POLLIN, 0}};
  ::poll(ready, 2, static_cast<int>(1000 * timeout));
  if (ready[0].revents == 0) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

// Accessible to the signal handler.
constexpr std::array<int, 4> kSignals{SIGINT, SIGTERM, SIGHUP, SIGQUIT};
volatile sig_atomic_t raw_fd = -1;
termios original;
struct sigaction handlers_before[kSignals.size()];

// Restores the terminal, then calls the previous handler.
void restore_terminal(int signal_number) {
  if (raw_fd >= 0) tcsetattr(raw_fd, TCSANOW, &original);  // async-signal-safe
  for (std::size_t n = 0; n < kSignals.size(); ++n) {
    if (kSignals[n] != signal_number) continue;
    const auto before = handlers_before[n].sa_handler;
    if (before == SIG_DFL) {
      signal(signal_number, SIG_DFL);
      raise(signal_number);
    } else if (before != SIG_IGN) {
      before(signal_number);
    }
  }
}

}  // namespace

TcpPeer::TcpPeer(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0) throw std::runtime_error(gai_strerror(error));
  for (const addrinfo* one = found; one; one = one->ai_next) {
    const char* bytes = reinterpret_cast<const char*>(one->ai_addr);
    addresses_.push_back({one->ai_family, {bytes, bytes + one->ai_addrlen}});
  }
  freeaddrinfo(found);
}

OwnedFd TcpPeer::connect(double timeout, int stop, std::string& why_not) const {
  for (const Address& address : addresses_) {
    OwnedFd fd(::socket(address.family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const auto* name = reinterpret_cast<const sockaddr*>(address.bytes.data());
    const auto size = static_cast<socklen_t>(address.bytes.size());
    int error = ::connect(fd.get(), name, size) == 0 ? 0 : errno;
    if (error == EINPROGRESS) error = connect_error(fd.get(), timeout, stop);
    if (error == 0) {
      const int on = 1;  // no delay: forces are small messages
      setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      return fd;
    }
    why_not = std::strerror(error);
  }
  return OwnedFd();
}

RawTerminal::RawTerminal(int fd) {
  if (raw_fd >= 0 || tcgetattr(fd, &original) != 0) return;
  is_terminal_ = true;
  raw_fd = fd;
  struct sigaction action {};
  action.sa_handler = restore_terminal;
  for (std::size_t n = 0; n < kSignals.size(); ++n)
    sigaction(kSignals[n], &action, &handlers_before[n]);
  termios raw = original;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // Ctrl-C stays a signal
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  tcsetattr(fd, TCSANOW, &raw);
}

RawTerminal::~RawTerminal() {
  if (!is_terminal_) return;
  tcsetattr(raw_fd, TCSANOW, &original);
  for (std::size_t n = 0; n < kSignals.size(); ++n) {
    struct sigaction now {};
    sigaction(kSignals[n], nullptr, &now);
    if (now.sa_handler == restore_terminal) sigaction(kSignals[n], &handlers_before[n], nullptr);
  }
  raw_fd = -1;
}

}  // namespace twinarm
