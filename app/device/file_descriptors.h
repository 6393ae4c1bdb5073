// Owner of a file descriptor; TCP connections; raw terminals.
#pragma once

#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

namespace twinarm {

class OwnedFd {
 public:
  explicit OwnedFd(int fd = -1) : fd_(fd) {}
  OwnedFd(OwnedFd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  OwnedFd& operator=(OwnedFd&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~OwnedFd() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

// A TCP service by host and port, looked up once.
class TcpPeer {
 public:
  // Waits for the name service. Throws std::runtime_error with its message.
  TcpPeer(const std::string& host, int port);
  // A non-blocking socket, or none and the reason. Waits at most `timeout` [s] for each address of
  // the host, or until `stop` is readable.
  OwnedFd connect(double timeout, int stop, std::string& why_not) const;

 private:
  struct Address {
    int family;
    std::vector<char> bytes;  // a sockaddr
  };
  std::vector<Address> addresses_;
};

// Terminal without line buffering and echo. Its mode is restored by the destructor, or when a
// signal such as Ctrl-C ends the program. One at a time.
class RawTerminal {
 public:
  explicit RawTerminal(int fd);  // must outlive this
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  bool is_terminal() const { return is_terminal_; }

 private:
  bool is_terminal_ = false;
};

}  // namespace twinarm
