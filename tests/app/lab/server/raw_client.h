// Client on a plain socket: requests and WebSocket frames by RFC 9112 and RFC 6455, sharing no code
// with the server. No wait is longer than ten seconds.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

class RawClient {
 public:
  struct Frame {
    int opcode = -1;  // -1: the connection has ended
    bool is_last = true;
    std::string payload;
  };
  struct Reply {
    int status = 0;  // 0: the connection has ended
    std::string head, body;
    // Value of a field, case-sensitive; empty: missing.
    std::string field(const std::string& name) const {
      const std::size_t at = head.find("\r\n" + name + ": ");
      if (at == head.npos) return {};
      const std::size_t from = at + name.size() + 4;
      return head.substr(from, head.find("\r\n", from) - from);
    }
  };
  static constexpr int kText = 1, kBinary = 2, kClose = 8, kPing = 9, kPong = 10;

  // From 127.0.0.`host`.
  explicit RawClient(int port, unsigned host = 1)
      : fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK - 1 + host);
    if (bind(fd_, reinterpret_cast<sockaddr*>(&name), sizeof name) != 0)
      throw std::runtime_error("no address for the client");
    name.sin_port = htons(static_cast<std::uint16_t>(port));
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(fd_, reinterpret_cast<sockaddr*>(&name), sizeof name) != 0)
      throw std::runtime_error("the server does not take a connection");
  }
  ~RawClient() { close(fd_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  // False: closed by the server.
  bool say(const std::string& bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      pollfd ready{fd_, POLLOUT, 0};
      if (::poll(&ready, 1, 10000) != 1) return false;
      const ssize_t sent =
          send(fd_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent <= 0) return false;
      done += static_cast<std::size_t>(sent);
    }
    return true;
  }
  void say_no_more() const { shutdown(fd_, SHUT_WR); }
  // Waits until the server closes; false: timeout.
  bool hear_end() {
    while (fill()) in_.clear();
    return has_ended_;
  }

  Reply hear_reply(bool has_body = true) {
    Reply reply;
    std::size_t end = 0;
    while ((end = in_.find("\r\n\r\n")) == in_.npos)
      if (!fill()) return {};
    reply.head = in_.substr(0, end + 2);
    in_.erase(0, end + 4);
    reply.status = std::atoi(reply.head.c_str() + 9);
    const std::size_t size =
        has_body ? std::strtoul(reply.field("Content-Length").c_str(), nullptr, 10) : 0;
    if (!need(size)) return {};
    reply.body = take(size);
    return reply;
  }
  Reply ask(const std::string& request) {
    say(request);
    return hear_reply(request.rfind("HEAD", 0) != 0);
  }

  // RFC 6455 5.2; frames of a client are masked.
  static std::string frame(int opcode, const std::string& payload, bool is_last = true,
                           bool is_masked = true) {
    std::string bytes(1, static_cast<char>((is_last ? 0x80 : 0) | opcode));
    const std::size_t size = payload.size();
    const int length = size < 126 ? static_cast<int>(size) : size < 65536 ? 126 : 127;
    bytes += static_cast<char>((is_masked ? 0x80 : 0) | length);
    for (int k = length < 126 ? 0 : length == 126 ? 2 : 8; k-- > 0;)
      bytes += static_cast<char>(size >> 8 * k);
    const std::string mask = "\x12\x34\x56\x78";
    if (is_masked) bytes += mask;
    for (std::size_t i = 0; i < size; ++i)
      bytes += static_cast<char>(is_masked ? payload[i] ^ mask[i % 4] : payload[i]);
    return bytes;
  }
  bool say_frame(int opcode, const std::string& payload) const {
    return say(frame(opcode, payload));
  }

  Frame hear_frame() {
    if (!need(2)) return {};
    const std::string start = take(2);
    Frame frame;
    frame.opcode = start[0] & 15;
    frame.is_last = (start[0] & 0x80) != 0;
    if (start[1] & 0x80) throw std::runtime_error("a server's frame is masked");
    std::size_t size = start[1] & 0x7f;
    const std::size_t more = size < 126 ? 0 : size == 126 ? 2 : 8;
    if (!need(more)) return {};
    if (more > 0) size = 0;
    for (const char byte : take(more)) size = size << 8 | static_cast<unsigned char>(byte);
    if (!need(size)) return {};
    frame.payload = take(size);
    return frame;
  }
  // The next message; pings are answered.
  Frame hear_message() {
    for (;;) {
      const Frame frame = hear_frame();
      if (frame.opcode != kPing) return frame;
      say_frame(kPong, frame.payload);
    }
  }
  // Code of the close frame; 0: timeout.
  int hear_close(std::string* why = nullptr) {
    for (;;) {
      const Frame frame = hear_message();
      if (frame.opcode == -1) return 0;
      if (frame.opcode != kClose || frame.payload.size() < 2) continue;
      if (why) *why = frame.payload.substr(2);
      return static_cast<unsigned char>(frame.payload[0]) << 8 |
             static_cast<unsigned char>(frame.payload[1]);
    }
  }

 private:
  bool need(std::size_t count) {
    while (in_.size() < count)
      if (!fill()) return false;
    return true;
  }
  std::string take(std::size_t count) {
    std::string bytes = in_.substr(0, count);
    in_.erase(0, count);
    return bytes;
  }
  bool fill() {
    pollfd ready{fd_, POLLIN, 0};
    if (::poll(&ready, 1, 10000) != 1) return false;
    char bytes[65536];
    const ssize_t count = recv(fd_, bytes, sizeof bytes, 0);
    has_ended_ = count <= 0;
    if (has_ended_) return false;
    in_.append(bytes, static_cast<std::size_t>(count));
    return true;
  }

  int fd_;
  std::string in_;
  bool has_ended_ = false;
};
