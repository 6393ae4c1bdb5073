// Test server on 127.0.0.1 and a free port: a script of bytes, called for each connection. No call
// waits longer than two seconds.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "app/device/file_descriptors.h"
#include "tests/app/device/vrpn_bytes.h"

class VrpnServer;

// Connection to a client.
class VrpnClient {
 public:
  VrpnClient(int fd, const std::atomic<bool>& stop) : fd_(fd), stop_(stop) {}
  void say(const vrpn_bytes::Bytes& bytes) const {
    [[maybe_unused]] const auto sent = send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  // The next `count` bytes, fewer after the timeout.
  vrpn_bytes::Bytes hear(std::size_t count) const {
    vrpn_bytes::Bytes bytes;
    while (bytes.size() < count) {
      pollfd ready{fd_, POLLIN, 0};
      if (::poll(&ready, 1, 2000) != 1) break;
      std::uint8_t byte = 0;
      if (recv(fd_, &byte, 1, 0) != 1) break;
      bytes.push_back(byte);
    }
    return bytes;
  }
  // One whole message.
  vrpn_bytes::Bytes hear_message() const {
    vrpn_bytes::Bytes bytes = hear(24);
    if (bytes.size() < 24) return bytes;
    const std::size_t payload = bytes[3] - 24u + 256u * bytes[2];
    const vrpn_bytes::Bytes rest = hear((payload + 7) / 8 * 8);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
  }
  // Until the client closes; unread input would make close() discard what was sent.
  void hear_end() const {
    while (!stop_ && hear(1).size() == 1) {
    }
  }
  // `count` poses, or until the end of the test.
  void go_on(const vrpn_bytes::Bytes& bytes, int count = 1 << 20) const {
    for (int n = 0; n < count && !stop_; ++n) {
      say(bytes);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  bool stopped() const { return stop_; }

 private:
  int fd_;
  const std::atomic<bool>& stop_;
};

class VrpnServer {
 public:
  using Script = std::function<void(const VrpnClient& client, int nth)>;
  explicit VrpnServer(Script script)
      : script_(std::move(script)), listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof name;
    auto* address = reinterpret_cast<sockaddr*>(&name);
    if (bind(listener_.get(), address, size) != 0 || listen(listener_.get(), 4) != 0 ||
        getsockname(listener_.get(), address, &size) != 0)
      throw std::runtime_error("no port for the test's server");
    port_ = ntohs(name.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~VrpnServer() { stop(); }
  int port() const { return port_; }
  int connections() const { return connections_; }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    listener_ = twinarm::OwnedFd();
  }

 private:
  void run() {
    for (int nth = 0; !stop_;) {
      pollfd ready{listener_.get(), POLLIN, 0};
      if (::poll(&ready, 1, 10) != 1) continue;
      const twinarm::OwnedFd fd(accept(listener_.get(), nullptr, nullptr));
      ++connections_;
      script_(VrpnClient(fd.get(), stop_), nth++);
    }
  }

  Script script_;
  twinarm::OwnedFd listener_;
  int port_ = 0;
  std::atomic<int> connections_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};
