// Test server: echoes, and counts clients.
#pragma once

#include <atomic>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "app/lab/server/lab_server.h"
#include "solver/support/sanitized.h"
#include "tests/app/lab/server/raw_client.h"
#include "tests/support/waiting.h"

inline twinarm::Bytes bytes_of(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

// Resident memory of this program [MB].
inline double resident_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6)) / 1024;
  return 0;
}
#ifdef TWINARM_SANITIZED
constexpr bool kMemoryTells = false;  // sanitizers keep what is freed
#else
constexpr bool kMemoryTells = true;
#endif

class LabHost {
 public:
  static constexpr const char* kToken = "0123456789abcdef";
  explicit LabHost(twinarm::ServerOptions options = {}) : server(with_token(options), handlers()) {}

  std::string host() const { return "127.0.0.1:" + std::to_string(server.port()); }
  std::string cookie() const {
    return "Cookie: a=b; twinarm_" + std::to_string(server.port()) + "=" + kToken + "\r\n";
  }
  // "GET /path HTTP/1.1" with this server's host name; `more`: further complete lines.
  std::string request(const std::string& line, const std::string& more) const {
    return line + " HTTP/1.1\r\nHost: " + host() + "\r\n" + more + "\r\n";
  }
  // The key of the example in RFC 6455 1.3.
  std::string upgrade(const std::string& more) const {
    return request("GET /live",
                   "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                   "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                       more);
  }
  // Opens a WebSocket; returns the client's number.
  twinarm::ClientId open(RawClient& client) {
    const RawClient::Reply reply = client.ask(upgrade(cookie()));
    if (reply.status != 101) throw std::runtime_error("refused: " + reply.body);
    const twinarm::ClientId number = ++opened_by_test_;
    if (!comes_true([&] { return opened >= number; })) throw std::runtime_error("not opened");
    return number;
  }
  void send_to_all(int channel, const twinarm::Bytes& message, bool is_binary) {
    for (twinarm::ClientId client = 1; client <= opened_by_test_; ++client)
      server.send(client, channel, message, is_binary);
  }
  bool is_alive() const {
    return RawClient(server.port()).ask(request("GET /", cookie())).body == "GET / ";
  }

  std::atomic<twinarm::ClientId> opened{0}, closed{0};
  std::string last_address;  // of a client, after open()
  std::mutex mutex;
  std::function<void(const twinarm::HttpRequest&, std::function<void(twinarm::HttpReply)>)> http;
  twinarm::LabServer server;  // last: its thread ends first

 private:
  static twinarm::ServerOptions with_token(twinarm::ServerOptions options) {
    options.token = kToken;
    return options;
  }
  twinarm::ServerHandlers handlers() {
    twinarm::ServerHandlers called;
    called.http = [this](const twinarm::HttpRequest& asked, auto answer) {
      const std::lock_guard lock(mutex);
      if (http) return http(asked, answer);
      twinarm::HttpReply reply;
      reply.body = bytes_of(asked.method + " " + asked.path + " " + asked.body);
      answer(std::move(reply));
    };
    called.opened = [this](twinarm::ClientId, const std::string& address) {
      last_address = address;
      ++opened;
    };
    called.may_post = [](const std::string& query) { return query != "refused"; };
    called.closed = [this](twinarm::ClientId) { ++closed; };
    called.message = [this](twinarm::ClientId client, const std::string& text) {
      server.send(client, 1, bytes_of("you said " + text), false);
    };
    return called;
  }
  twinarm::ClientId opened_by_test_ = 0;
};
