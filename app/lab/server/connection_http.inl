// HTTP requests of a connection. Part of lab_server.cpp.
#pragma once

#include "app/lab/server/connection.h"

namespace twinarm::lab_server {

constexpr std::uint32_t kMaxHead = 16 << 10;  // [bytes]
constexpr double kSlowestDownload = 50e3;     // [bytes/s]
constexpr std::chrono::seconds kCloseTimeout{2}, kStrangerTimeout{2};

inline std::string_view view(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

inline std::string_view query_of(std::string_view target) {
  return target.substr(std::min(target.find('?'), target.size() - 1) + 1);
}

void Connection::start() {
  parser_.emplace();
  parser_->header_limit(kMaxHead);
  parser_->body_limit(core_.options.max_body);
  is_permitted_ = gives_cookie_ = false;
  Clock::duration wait = core_.timeout(0.25);
  if (is_stranger_) wait = std::min<Clock::duration>(wait, kStrangerTimeout);
  deadline_ = Clock::now() + wait;
  in_.empty() ? read_some() : parse();
}

void Connection::read_some() {
  socket_.async_read_some(net::buffer(chunk_),
                          [self = shared_from_this()](error_code error, std::size_t count) {
                            if (error) return self->drop();
                            self->in_.append(self->chunk_.data(), count);
                            self->parse();
                          });
}

void Connection::parse() {
  for (bool is_more = !in_.empty(); is_more && !parser_->is_done();) {
    error_code error;
    in_.erase(0, parser_->put(net::buffer(in_), error));
    if (error == http::error::header_limit) return refuse(431, "the request header is too long");
    if (error == http::error::body_limit) return refuse(413, "the request body is too large");
    if (error && error != http::error::need_more) return refuse(400, "not an HTTP request");
    // The body is read only after the header was accepted.
    if (!is_permitted_ && parser_->is_header_done()) {
      if (const auto refused = refusal()) return refuse(refused->status, refused->why);
      is_permitted_ = true;
      parser_->eager(true);
    }
    is_more = !in_.empty() && !error;
  }
  if (parser_->is_done()) return serve();
  if (is_permitted_) deadline_ = Clock::now() + core_.timeout(0.25);
  read_some();
}

bool Connection::has_token(std::string_view target) {
  const std::string& token = core_.options.token;
  const std::optional<std::string> given = query_value(query_of(target), "token");
  gives_cookie_ = given && is_secret(*given, token);
  return gives_cookie_ ||
         is_secret(cookie_value(view(parser_->get()[http::field::cookie]), core_.cookie), token);
}

bool Connection::is_within_rate() {
  const double most = core_.options.messages_per_second;
  return messages_.passes(Clock::now(), most, most);
}

std::optional<Connection::Refusal> Connection::refusal() {
  const Request& request = parser_->get();
  const std::string_view host = view(request[http::field::host]);
  const std::string_view origin = view(request[http::field::origin]);
  const bool is_post = request.method() == http::verb::post;
  const bool is_live = websocket::is_upgrade(request);
  if (request.count(http::field::host) != 1 || !core_.hosts->has(host))
    return Refusal{403, "unknown host name: open the address that `twinarm lab` printed"};
  if (!has_token(view(request.target())))
    return Refusal{403,
                   "the token is missing: open the whole address that `twinarm lab` printed, with "
                   "?token=.."};
  is_stranger_ = false;
  if ((is_post || is_live) && !origin.empty() && origin != "http://" + std::string(host))
    return Refusal{403, "cross-origin request refused"};
  if (!is_post && request.method() != http::verb::get && request.method() != http::verb::head)
    return Refusal{405, "method not allowed; use GET, HEAD or POST"};
  if (!is_within_rate()) return Refusal{429, "too many requests per second"};
  if (!is_post && !parser_->is_done()) return Refusal{400, "only POST may have a body"};
  if (is_post && core_.handlers.may_post &&
      !core_.handlers.may_post(std::string(query_of(view(request.target())))))
    return Refusal{403, "another client has control; request it"};
  if (is_post &&
      std::ranges::count_if(core_.connections, &Connection::is_posting) >= core_.options.max_posts)
    return Refusal{503, "too many uploads at once; try again"};
  return {};
}

void Connection::serve() {
  const Request& request = parser_->get();
  const std::string_view target = view(request.target());
  const std::optional<std::string> path = decoded_path(target.substr(0, target.find('?')));
  if (!path) return refuse(400, "invalid path");
  if (websocket::is_upgrade(request) && *path == "/live") return upgrade_to_websocket();
  HttpRequest parsed{request.method() == http::verb::post ? "POST" : "GET", *path,
                     std::string(query_of(target)), std::move(parser_->get().body())};
  deadline_ = Clock::now() + 2 * core_.timeout();
  is_waiting_ = true;
  auto answer = [core = core_.weak_from_this(), self = weak_from_this(),
                 number = ++request_](HttpReply reply) {
    if (const auto alive = core.lock())
      net::post(alive->io, [self, number, reply = std::move(reply)]() mutable {
        if (const auto connection = self.lock()) connection->answer(number, std::move(reply));
      });
  };
  if (!succeeds("http", [&] { core_.handlers.http(parsed, answer); }))
    answer({.status = 500, .body = shared_bytes("internal error of the lab\n")});
}

void Connection::answer(std::uint64_t request_number, HttpReply reply) {
  if (is_gone_ || !is_waiting_ || request_number != request_) return;
  is_waiting_ = false;
  const Request& request = parser_->get();
  if (!reply.body) reply.body = shared_bytes("");
  ResponseHead head{.keeps_alive = request.keep_alive()};
  if (gives_cookie_) head.cookie = core_.cookie + "=" + core_.options.token;
  if (reply.lasts && reply.status == 200) {
    // The path contains the hash of the content: it serves as the tag.
    const std::string_view target = view(request.target());
    head.etag = '"' + std::string(target.substr(0, target.find_first_of("?\"\\"))) + '"';
    if (view(request[http::field::if_none_match]) == head.etag) {
      reply.status = 304;
      reply.body = shared_bytes("");
    }
  }
  const std::string_view accepts = view(request[http::field::accept_encoding]);
  if (is_packable(reply) && accepts.find("gzip") != accepts.npos) {
    head.is_packed = true;
    reply.body = core_.packed(reply.body);
  }
  write(reply, head, request.method() != http::verb::head);
}

void Connection::refuse(int status, const std::string& why) {
  write({.status = status, .body = shared_bytes("twinarm lab: " + why + "\n")},
        {.keeps_alive = false});
}

void Connection::write(const HttpReply& reply, const ResponseHead& head, bool has_body) {
  head_ = reply_head(reply, head);
  body_ = has_body ? reply.body : shared_bytes("");
  deadline_ = Clock::now() + core_.timeout(0.25) +
              std::chrono::milliseconds(
                  static_cast<long>(1e3 * static_cast<double>(body_->size()) / kSlowestDownload));
  const std::array<net::const_buffer, 2> both{net::buffer(head_), net::buffer(*body_)};
  net::async_write(
      socket_, both,
      [self = shared_from_this(), goes_on = head.keeps_alive](error_code error, std::size_t) {
        self->body_.reset();
        if (error) return self->drop();
        goes_on ? self->start() : self->drain_and_close();
      });
}

// Reads the remaining input before close(): otherwise TCP sends RST and the client loses the reply.
void Connection::drain_and_close() {
  error_code ignored;
  if (!is_closing_) {
    is_closing_ = true;
    deadline_ = Clock::now() + kCloseTimeout;
    socket_.shutdown(Socket::shutdown_send, ignored);
  }
  socket_.async_read_some(net::buffer(chunk_),
                          [self = shared_from_this()](error_code error, std::size_t) {
                            error ? self->drop() : self->drain_and_close();
                          });
}

}  // namespace twinarm::lab_server
