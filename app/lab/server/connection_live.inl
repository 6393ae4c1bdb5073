// The WebSocket of a client. Part of lab_server.cpp.
#pragma once

#include <charconv>

#include "app/lab/server/connection_http.inl"

namespace twinarm::lab_server {

constexpr std::uint64_t kMaxUnanswered = 4;  // messages whose ping was not answered

void Connection::upgrade_to_websocket() {
  if (!in_.empty()) return refuse(400, "data before the WebSocket handshake was answered");
  if (core_.live >= core_.options.max_clients)
    return refuse(503, std::to_string(core_.live) + " pages are open, the maximum: close one");
  const auto same = std::ranges::count_if(core_.connections, [this](const auto& other) {
    return other->is_live() && other->address() == address_;
  });
  if (same >= core_.options.max_of_address)
    return refuse(503, std::to_string(same) + " pages of " + address_ +
                           " are open, the maximum of one address: close one");
  ++core_.live;
  deadline_ = Clock::now() + core_.timeout(0.25);
  ws_.emplace(std::move(socket_));
  ws_->auto_fragment(false);
  ws_->read_message_max(core_.options.max_message);
  ws_->control_callback([this](websocket::frame_type kind, boost::beast::string_view text) {
    take_control(kind, view(text));
  });
  ws_->async_accept(parser_->get(), [self = shared_from_this()](error_code error) {
    if (error) return self->drop();
    self->parser_.reset();
    self->progress_ = self->pinged_at_ = Clock::now();
    self->client_ = ++self->core_.last_client;
    succeeds("opened", [&opened = self->core_.handlers.opened, &self] {
      if (opened) opened(self->client_, self->address_);
    });
    self->read_message();
  });
}

void Connection::read_message() {
  ws_->async_read(message_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->drop();
    self->take_message();
  });
}

void Connection::take_message() {
  if (is_closing_) return;
  if (closes_flood()) return;
  if (!ws_->got_text())
    return close_websocket(websocket::close_code::unknown_data, "text messages only");
  const auto data = message_.data();
  const std::string text(static_cast<const char*>(data.data()), data.size());
  message_.consume(message_.size());
  succeeds("message", [&] {
    if (core_.handlers.message) core_.handlers.message(client_, text);
  });
  read_message();
}

// A pong carries the number of the last message received. Other control frames count as messages.
void Connection::take_control(websocket::frame_type kind, std::string_view text) {
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  if (kind == websocket::frame_type::pong && number > answered_ && number <= pinged_) {
    answered_ = number;
    progress_ = Clock::now();
    net::post(core_.io, [self = shared_from_this()] { self->send_next(); });
  } else if (kind != websocket::frame_type::close) {
    closes_flood();
  }
}

bool Connection::closes_flood() {
  if (is_within_rate()) return false;
  close_websocket(websocket::close_code::policy_error,
                  "more than " + std::to_string(std::lround(core_.options.messages_per_second)) +
                      " messages per second");
  return true;
}

void Connection::send(OutgoingMessage message) {
  queue_.put(std::move(message));
  send_next();
}

void Connection::send_next() {
  if (client_ == 0 || is_closing_ || writing_ || sent_ - answered_ >= kMaxUnanswered) return;
  const std::optional<OutgoingMessage> next = queue_.take();
  if (!next) return;
  if (sent_ == answered_) progress_ = Clock::now();
  writing_ = next->bytes;
  ws_->binary(next->is_binary);
  ws_->async_write(net::buffer(*writing_),
                   [self = shared_from_this()](error_code error, std::size_t) {
                     self->writing_.reset();
                     if (error) return;  // the pending read fails too, and drops the connection
                     self->progress_ = Clock::now();
                     ++self->sent_;
                     self->ping();
                     self->send_next();
                   });
}

void Connection::ping() {
  if (is_pinging_ || is_closing_) return;
  is_pinging_ = true;
  pinged_ = sent_;
  pinged_at_ = Clock::now();
  const std::string number = std::to_string(pinged_);
  ws_->async_ping(websocket::ping_data(number.data(), number.size()),
                  [self = shared_from_this()](error_code error) {
                    self->is_pinging_ = false;
                    if (!error && self->pinged_ != self->sent_) self->ping();
                  });
}

void Connection::close_websocket(websocket::close_code code, const std::string& why) {
  if (is_closing_) return;
  is_closing_ = true;
  deadline_ = Clock::now() + kCloseTimeout;
  // Not inside the handler of a read.
  net::post(core_.io, [self = shared_from_this(), code, why] {
    if (self->is_gone_) return;
    self->ws_->async_close(websocket::close_reason(code, why),
                           [self](error_code) { self->drop(); });
  });
}

void Connection::check_timeouts(Clock::time_point now) {
  // An ended WebSocket waits for the client to close the socket.
  if (client_ != 0 && !is_closing_ && !ws_->is_open()) {
    is_closing_ = true;
    deadline_ = now + kCloseTimeout;
  }
  if (client_ == 0 || is_closing_) {
    if (now > deadline_) drop();
    return;
  }
  const bool is_unanswered = writing_ || sent_ != answered_;
  if (is_unanswered && now - progress_ > core_.timeout()) return drop();
  if (!is_unanswered && now - pinged_at_ > core_.timeout(0.25)) {
    ++sent_;  // ping as for a message, to detect a lost client
    progress_ = now;
    ping();
  }
}

void Connection::drop() {
  if (is_gone_) return;
  is_gone_ = true;
  const auto self = shared_from_this();
  error_code ignored;
  (ws_ ? ws_->next_layer() : socket_).close(ignored);
  core_.connections.erase(self);
  if (ws_) --core_.live;
  if (client_ == 0) return;
  succeeds("closed", [&] {
    if (core_.handlers.closed) core_.handlers.closed(client_);
  });
}

}  // namespace twinarm::lab_server
