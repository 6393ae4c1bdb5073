// The WebSocket of a client. Part of lab_server.cpp.
#pragma once

#include <charconv>

#include "app/lab/server/connection_http.inl"

namespace twinarm::lab_server {

constexpr std::uint64_t kMaxUnanswered = 4;  // messages on the way to a client

void Connection::go_live() {
  if (!in_.empty()) return refuse(400, "a WebSocket begins after its answer");
  if (core_.live >= core_.options.max_clients)
    return refuse(503,
                  std::to_string(core_.live) + " pages are open, and no more can be: close one");
  ++core_.live;
  deadline_ = Clock::now() + core_.patience(0.25);
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
    self->core_.mailboxes.open(self->client_);
    try {
      if (self->core_.handlers.opened) self->core_.handlers.opened(self->client_);
    } catch (...) {
      tell_fault("opened");
    }
    self->read_message();
    self->send_next();
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
  if (is_too_fast()) return;
  if (!ws_->got_text()) return say_goodbye(websocket::close_code::unknown_data, "text only");
  const auto data = message_.data();
  const std::string text(static_cast<const char*>(data.data()), data.size());
  message_.consume(message_.size());
  core_.mailboxes.count_received(client_);
  try {
    if (core_.handlers.message) core_.handlers.message(client_, text);
  } catch (...) {
    tell_fault("message");
  }
  read_message();
}

// Pongs say how far a client has come; those that say nothing count as messages, as pings do.
void Connection::take_control(websocket::frame_type kind, std::string_view text) {
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  if (kind == websocket::frame_type::pong && number > answered_ && number <= pinged_) {
    answered_ = number;
    progress_ = Clock::now();
    net::post(core_.io, [self = shared_from_this()] { self->send_next(); });
  } else if (kind != websocket::frame_type::close) {
    is_too_fast();
  }
}

bool Connection::is_too_fast() {
  if (is_allowed()) return false;
  say_goodbye(websocket::close_code::policy_error,
              "more than " + std::to_string(std::lround(core_.options.messages_per_second)) +
                  " messages a second");
  return true;
}

void Connection::send_next() {
  if (client_ == 0 || is_closing_ || writing_ || sent_ - answered_ >= kMaxUnanswered) return;
  const std::optional<OutgoingQueues::Message> next = core_.mailboxes.take(client_);
  if (!next) return;
  if (sent_ == answered_) progress_ = Clock::now();
  writing_ = next->bytes;
  ws_->binary(next->is_binary);
  ws_->async_write(net::buffer(*writing_),
                   [self = shared_from_this()](error_code error, std::size_t) {
                     self->writing_.reset();
                     if (error) return;  // the read under way fails too, and drops it
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

void Connection::say_goodbye(websocket::close_code code, const std::string& why) {
  if (is_closing_) return;
  is_closing_ = true;
  deadline_ = Clock::now() + kFarewell;
  // Not from within the read that found it.
  net::post(core_.io, [self = shared_from_this(), code, why] {
    if (self->is_gone_) return;
    self->ws_->async_close(websocket::close_reason(code, why),
                           [self](error_code) { self->drop(); });
  });
}

void Connection::sweep(Clock::time_point now) {
  // A WebSocket that has ended, by its client's will or fault, waits for the client to hang up.
  if (client_ != 0 && !is_closing_ && !ws_->is_open()) {
    is_closing_ = true;
    deadline_ = now + kFarewell;
  }
  if (client_ == 0 || is_closing_) {
    if (now > deadline_) drop();
    return;
  }
  const bool is_owed = writing_ || sent_ != answered_;
  if (is_owed && now - progress_ > core_.patience()) return drop();
  if (!is_owed && now - pinged_at_ > core_.patience(0.25)) {
    ++sent_;  // an empty message, as it were: is anybody there?
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
  core_.mailboxes.close(client_);
  try {
    if (core_.handlers.closed) core_.handlers.closed(client_);
  } catch (...) {
    tell_fault("closed");
  }
}

}  // namespace twinarm::lab_server
