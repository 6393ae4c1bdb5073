// A TCP service by host and port: looked up once, then connected to without long waits.
#pragma once

#include <string>
#include <vector>

#include "app/device/owned_fd.h"

namespace twinarm {

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

}  // namespace twinarm
