// One client: first requests, then perhaps a WebSocket. Lives in the server's thread alone.
//
// It holds itself by the operations that it waits for; the server's list is for waking and
// sweeping.
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
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "app/lab/server/http_text.h"
#include "app/lab/server/mailboxes.h"

namespace twinarm::lab_server {

namespace net = boost::asio;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::beast::error_code;
using Clock = std::chrono::steady_clock;
// Of this one kind of executor: half of the templates are gone.
using Executor = net::io_context::executor_type;
using Socket = net::basic_stream_socket<net::ip::tcp, Executor>;
using Acceptor = net::basic_socket_acceptor<net::ip::tcp, Executor>;
using WebSocket = websocket::stream<Socket, false>;  // without compression

class Connection;

// What all connections share.
struct Core : std::enable_shared_from_this<Core> {
  Core(const ServerOptions& given, ServerHandlers called);
  Clock::duration patience(double part = 1) const {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(part * options.patience));
  }
  // The same text is often asked for again: the page.
  Bytes packed(const Bytes& body);

  net::io_context io{1};
  const ServerOptions options;
  const ServerHandlers handlers;
  std::optional<HostNames> hosts;
  std::string cookie;  // its name: with the port, for cookies are shared by all ports
  OutgoingQueues mailboxes;
  std::set<std::shared_ptr<Connection>> connections;
  std::size_t live = 0;
  ClientId last_client = 0;

 private:
  std::weak_ptr<const std::string> plain_;
  Bytes packed_;
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Core& core, Socket socket)
      : core_(core),
        socket_(std::move(socket)),
        allowance_(core.options.messages_per_second),
        allowed_at_(Clock::now()) {}
  void start();  // waits for a request
  void send_next();
  void sweep(Clock::time_point now);

 private:
  using Request = http::request<http::string_body>;

  // Requests: connection_http.inl
  void read_some();
  void parse();
  bool is_welcome();  // false: it has been answered
  void serve();
  void answer(std::uint64_t turn, HttpReply reply);
  void refuse(int status, const std::string& why);
  void write(const ResponseHead& head, Bytes body);
  void linger();
  bool has_token(std::string_view target);
  bool is_allowed();  // one message or request more, at this moment

  // The WebSocket: connection_live.inl
  void go_live();
  void read_message();
  void take_message();
  void take_control(websocket::frame_type kind, std::string_view text);
  bool is_too_fast();  // true: it is told so
  void ping();
  void say_goodbye(websocket::close_code code, const std::string& why);
  void drop();

  Core& core_;
  Socket socket_;  // moved into ws_
  Clock::time_point deadline_;
  bool is_gone_ = false;

  std::array<char, 16384> chunk_;
  std::string in_;  // not parsed yet
  std::optional<http::request_parser<http::string_body>> parser_;
  bool is_welcome_ = false;  // the head of this request has been judged
  bool gives_cookie_ = false;
  std::uint64_t turn_ = 0;   // of requests: a late answer is not for the next one
  bool is_waiting_ = false;  // for an answer
  std::string head_;         // that is being written
  Bytes body_;

  std::optional<WebSocket> ws_;
  ClientId client_ = 0;  // 0: not (yet) live
  boost::beast::flat_buffer message_;
  Bytes writing_;  // the message under way
  bool is_closing_ = false, is_pinging_ = false;
  std::uint64_t sent_ = 0, pinged_ = 0, answered_ = 0;  // messages, by their number
  Clock::time_point progress_, pinged_at_;
  double allowance_;  // of messages, now
  Clock::time_point allowed_at_;
};

// What the owner's functions throw is his fault, and not the end of the server.
void tell_fault(const char* where);

}  // namespace twinarm::lab_server
