// A file descriptor that is closed with its owner.
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

// A TCP service by host and port: looked up once, then connected to without long waits.
class TcpPeer {
 public:
  // Waits for the name service. Throws std::runtime_error with its words.
  TcpPeer(const std::string& host, int port);
  // A socket that does not block, or none, and why. Waits at most `patience` [s] for each of the
  // host's addresses, and no longer than until `stop` can be read.
  OwnedFd connect(double patience, int stop, std::string& why_not) const;

 private:
  struct Address {
    int family;
    std::vector<char> bytes;  // a sockaddr
  };
  std::vector<Address> addresses_;
};

// A terminal that gives each key at once and shows none, for as long as this lives. It is as it was
// afterwards, and also where Ctrl-C or another signal ends the program first. One at a time.
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
