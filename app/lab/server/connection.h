// One client: HTTP requests, then perhaps a WebSocket. Used by the server's thread only.
//
// Pending operations own the connection; the server's list serves wake-up and timeouts.
#pragma once

#include <array>
#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/basic_stream_socket.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <cstdio>
#include <exception>
#include <set>

#include "app/lab/server/http_text.h"
#include "app/lab/server/outgoing_queue.h"
#include "app/lab/server/rate_limiter.h"

namespace twinarm::lab_server {

namespace net = boost::asio;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::beast::error_code;
using Clock = std::chrono::steady_clock;
// One concrete executor type: halves the number of template instances.
using Executor = net::io_context::executor_type;
using Socket = net::basic_stream_socket<net::ip::tcp, Executor>;
using Acceptor = net::basic_socket_acceptor<net::ip::tcp, Executor>;
using WebSocket = websocket::stream<Socket, false>;  // without compression

class Connection;

// Shared by all connections.
struct Core : std::enable_shared_from_this<Core> {
  Core(const ServerOptions& given, ServerHandlers called)
      : options(given), handlers(std::move(called)) {}
  Clock::duration timeout(double part = 1) const {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(part * options.timeout));
  }
  // Gzipped body; the last one is cached (the page).
  Bytes packed(const Bytes& body);

  net::io_context io{1};
  const ServerOptions options;
  const ServerHandlers handlers;
  std::optional<HostNames> hosts;
  std::string cookie;  // name; contains the port, as browsers share cookies among ports
  std::set<std::shared_ptr<Connection>> connections;
  std::size_t live = 0;
  ClientId last_client = 0;

 private:
  std::weak_ptr<const std::string> plain_;
  Bytes packed_;
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Core& core, Socket socket, std::string address)
      : core_(core),
        socket_(std::move(socket)),
        address_(std::move(address)),
        opened_at_(Clock::now()) {}
  void start();  // reads the next request
  void send(OutgoingMessage message);
  void check_timeouts(Clock::time_point now);
  void drop();
  bool is_stranger() const { return is_stranger_; }
  bool is_live() const { return ws_.has_value(); }
  bool is_posting() const {
    return is_permitted_ && parser_ && parser_->get().method() == http::verb::post;
  }
  ClientId client() const { return client_; }              // 0: no WebSocket
  const std::string& address() const { return address_; }  // of the client
  Clock::time_point opened_at() const { return opened_at_; }

 private:
  using Request = http::request<http::string_body>;

  // Requests: connection_http.inl
  void read_some();
  void parse();
  struct Refusal {
    int status;
    const char* why;
  };
  std::optional<Refusal> refusal();  // of a request; none: it is permitted
  void serve();
  void answer(std::uint64_t request, HttpReply reply);
  void refuse(int status, const std::string& why);
  void write(const HttpReply& reply, const ResponseHead& head, bool has_body = true);
  void drain_and_close();
  bool has_token(std::string_view target);
  bool is_within_rate();  // counts one message or request

  // The WebSocket: connection_live.inl
  void upgrade_to_websocket();
  void read_message();
  void take_message();
  void take_control(websocket::frame_type kind, std::string_view text);
  void send_next();
  bool closes_flood();  // true: too many messages, closing
  void ping();
  void close_websocket(websocket::close_code code, const std::string& why);

  Core& core_;
  Socket socket_;  // moved into ws_ by an upgrade
  std::string address_;
  Clock::time_point opened_at_, deadline_;
  bool is_stranger_ = true;  // has not shown the token yet
  bool is_gone_ = false;

  std::array<char, 16384> chunk_;
  std::string in_;  // not parsed yet
  std::optional<http::request_parser<http::string_body>> parser_;
  bool is_permitted_ = false;  // the head of this request was accepted
  bool gives_cookie_ = false;
  std::uint64_t request_ = 0;  // number; a late answer must not go to the next request
  bool is_waiting_ = false;    // for an answer
  std::string head_;           // being written
  Bytes body_;

  std::optional<WebSocket> ws_;
  ClientId client_ = 0;
  boost::beast::flat_buffer message_;
  OutgoingQueue queue_;
  Bytes writing_;  // message being sent
  bool is_closing_ = false, is_pinging_ = false;
  std::uint64_t sent_ = 0, pinged_ = 0, answered_ = 0;  // numbers of messages
  Clock::time_point progress_, pinged_at_;
  RateLimiter messages_;
};

// False: the call has thrown; the exception is printed to stderr and the server continues.
template <class Call>
bool succeeds(const char* where, const Call& call) {
  try {
    call();
    return true;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "twinarm lab: exception in '%s': %s\n", where, fault.what());
  } catch (...) {
    std::fprintf(stderr, "twinarm lab: exception in '%s'\n", where);
  }
  return false;
}

}  // namespace twinarm::lab_server
