// HTTP and WebSocket on one address, for a page and its clients. Knows nothing of what it serves.
//
// One thread of its own. For each client there is one place per channel of messages: a newer
// message takes the place of one that has not been sent. So a client that does not read costs one
// message a channel, whatever it does. After each message goes a ping, which a browser answers by
// itself; no more than four are unanswered, so that nothing old piles up on a slow way either.
//
// GET, HEAD (handed on as GET), POST; a WebSocket at /live.
//
// Who is let in: the token stands in the first address and then in a cookie (HttpOnly, SameSite
// strict); Host must name an address that is listened on (so that no foreign name leads here), and
// Origin, where a browser gives one, this very server. Without the token: 403, and what to do.
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
  std::string query;         // as it came, without '?'
  std::string body;          // of POST
};
struct HttpReply {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  Bytes body;
  bool lasts = false;     // it never changes (its name is its content's hash)
  std::string file_name;  // offered as a download
};

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  // 0: any that is free
  std::string token;
  std::size_t max_clients = 32;
  std::size_t max_message = 64 << 10;  // of a client [bytes]
  std::size_t max_body = 32 << 20;     // of a POST [bytes]
  double messages_per_second = 500;    // of a client; more: it is told so and dropped
  double patience =
      60;  // a client that takes nothing is kept so long, a request a quarter of it [s]
};

// 128 random bits, in hexadecimal digits.
std::string random_token();
// Of "a=1&b=x%20y", decoded. Nothing where it is not there, or is not UTF-8 text.
std::optional<std::string> query_value(std::string_view query, std::string_view name);

// Called by the server's thread; may not wait. http: `answer` is called once, at once or later,
// from any thread, also when the server is gone; what takes long is handed on. Who is not there:
// 404. What they throw is told on stderr, and answered with 500.
struct ServerHandlers {
  std::function<void(const HttpRequest&, std::function<void(HttpReply)> answer)> http;
  std::function<void(ClientId)> opened, closed;
  std::function<void(ClientId, const std::string& text)> message;
};

class LabServer {
 public:
  // Throws InputError: an address that cannot be listened on.
  LabServer(const ServerOptions& options, ServerHandlers handlers);
  ~LabServer();  // closes all connections, joins the thread; `closed` is not called any more
  std::uint16_t port() const;
  // "http://127.0.0.1:PORT/?token=.."
  std::string url() const;
  // From any thread; returns at once. `channel`: a small number; 0 goes before all others, of which
  // the one that has waited longest is next. Binary or text.
  void send(ClientId client, int channel, Bytes message, bool is_binary);
  void send_all(int channel, Bytes message, bool is_binary);
  // Of a client, for tests and the curious: messages sent, and those that a newer one replaced.
  struct Traffic {
    std::uint64_t sent = 0, replaced = 0, bytes = 0, received = 0;
  };
  Traffic traffic(ClientId client) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
