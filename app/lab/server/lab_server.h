// HTTP and WebSocket server for a page and its clients, in its own thread. Independent of what it
// serves.
//
// For each client and channel only the newest unsent message is stored, so a client that does not
// read costs one message per channel. Each message is followed by a ping, which browsers answer; at
// most four are unanswered, so that no old messages queue up on a slow connection.
//
// GET, HEAD (handled as GET), POST; a WebSocket at /live.
//
// Access: the token is in the first address, then in a cookie (HttpOnly, SameSite=Strict). Host
// must name an address of the server (against DNS rebinding), and Origin, if present, this server.
// Without the token: 403.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace twinarm {

using ClientId = std::uint64_t;
using Bytes = std::shared_ptr<const std::string>;
inline Bytes shared_bytes(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

struct HttpRequest {
  std::string method, path;  // decoded, without query
  std::string query;         // not decoded, without '?'
  std::string body;          // of POST
};
struct HttpReply {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  Bytes body = {};
  bool lasts = false;          // never changes: its name is the hash of its content
  std::string file_name = {};  // not empty: offered as a download
};

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  // 0: any free one
  std::string token;
  std::size_t max_clients = 64;
  std::ptrdiff_t max_of_address = 64;  // clients
  std::ptrdiff_t max_posts = 8;        // at once
  std::size_t max_message = 64 << 10;  // of a client [bytes]
  std::size_t max_body = 32 << 20;     // of a POST [bytes]
  double messages_per_second = 500;    // of a client; beyond: disconnected
  double timeout = 60;                 // of a client that reads nothing; of a request a quarter [s]
};

// 128 random bits in hexadecimal.
std::string random_token();
// Of "a=1&b=x%20y", decoded. Nothing if missing or not UTF-8 text.
std::optional<std::string> query_value(std::string_view query, std::string_view name);

// Called by the server's thread; must not block. `answer` is to be called once, from any thread, at
// once or later, even after the server's end. Exceptions are printed to stderr and answered with
// 500.
struct ServerHandlers {
  std::function<void(const HttpRequest&, std::function<void(HttpReply)> answer)> http;
  std::function<bool(const std::string& query)> may_post;  // asked before the body is read
  std::function<void(ClientId, const std::string& address)> opened;
  std::function<void(ClientId)> closed;
  std::function<void(ClientId, const std::string& text)> message;
};

class LabServer {
 public:
  // Throws InputError: cannot listen on the address.
  LabServer(const ServerOptions& options, ServerHandlers handlers);
  ~LabServer();  // closes all connections without calling `closed`, joins the thread
  std::uint16_t port() const;
  // "http://127.0.0.1:PORT/?token=.."
  std::string url() const;
  // From any thread; returns at once. `channel`: small number, see outgoing_queue.h.
  void send(ClientId client, int channel, Bytes message, bool is_binary);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
