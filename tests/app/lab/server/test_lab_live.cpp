// WebSocket: frames as in RFC 6455; newest-only messages that no client can block.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "app/lab/server/outgoing_queue.h"
#include "tests/app/lab/server/lab_host.h"

using namespace twinarm;

namespace {

using Frame = RawClient::Frame;

// A message that begins with its number.
Bytes numbered(int number, std::size_t size) {
  std::string text = std::to_string(number) + " ";
  text.resize(size, 'x');
  return bytes_of(std::move(text));
}

}  // namespace

TEST_CASE("WebSocket: the handshake answers the key of the example in RFC 6455") {
  LabHost lab;
  RawClient client(lab.server.port());
  const auto reply = client.ask(lab.upgrade(lab.cookie()));
  CHECK(reply.status == 101);
  CHECK(reply.field("Sec-WebSocket-Accept") == "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
  CHECK(reply.field("Sec-WebSocket-Extensions").empty());
}

TEST_CASE("WebSocket: fragments with a ping between are one message; pings are answered") {
  LabHost lab;
  RawClient client(lab.server.port());
  const ClientId number = lab.open(client);
  client.say(RawClient::frame(RawClient::kText, "h\xc3", false) +
             RawClient::frame(RawClient::kPing, "are you there") +
             RawClient::frame(0, "\xa9l", false) + RawClient::frame(0, "lo"));
  const Frame pong = client.hear_message(), echo = client.hear_message();
  CHECK(pong.opcode == RawClient::kPong);
  CHECK(pong.payload == "are you there");
  CHECK(echo.opcode == RawClient::kText);
  CHECK(echo.payload == "you said h\xc3\xa9llo");
  // Lengths at which the frame format changes.
  for (const std::size_t size : {0, 1, 125, 126, 127, 65535, 65536}) {
    const std::string text(size, 't');
    REQUIRE(client.say_frame(RawClient::kText, text));
    CHECK(client.hear_message().payload == "you said " + text);
  }
  client.say_frame(RawClient::kClose,
                   "\x03\xe8"
                   "bye");
  CHECK(client.hear_close() == 1000);
  CHECK(client.hear_end());
  CHECK(comes_true([&] { return lab.closed == number; }));
}

TEST_CASE("WebSocket: a violation of RFC 6455 closes that connection with its code, and no other") {
  LabHost lab;
  RawClient good(lab.server.port());
  lab.open(good);
  const auto code = [&](const std::string& bytes) {
    RawClient client(lab.server.port());
    lab.open(client);
    client.say(bytes);
    return client.hear_close();
  };
  using Raw = RawClient;
  CHECK(code(Raw::frame(Raw::kText, "\xff\xfe")) == 1007);            // not UTF-8
  CHECK(code(Raw::frame(Raw::kText, "\xed\xa0\x80")) == 1007);        // a surrogate
  CHECK(code(Raw::frame(Raw::kBinary, "abc")) == 1003);               // text only
  CHECK(code(Raw::frame(Raw::kText, "plain", true, false)) == 1002);  // not masked
  CHECK(code(Raw::frame(3, "reserved")) == 1002);
  CHECK(code(Raw::frame(0, "goes on from nothing")) == 1002);
  CHECK(code(Raw::frame(Raw::kPing, "in pieces", false)) == 1002);
  CHECK(code(Raw::frame(Raw::kPing, std::string(126, 'p'))) == 1002);
  CHECK(code(Raw::frame(Raw::kText, std::string((64 << 10) + 1, 'b'))) == 1009);  // too big
  // Too large in fragments: closed before the last one.
  std::string pieces = Raw::frame(Raw::kText, std::string(40000, 'b'), false);
  CHECK(code(pieces + Raw::frame(0, std::string(40000, 'b'), false)) == 1009);
  // A length of 2^62: closed at once.
  CHECK(code(std::string("\x81\xff\x40\0\0\0\0\0\0\0mask", 14)) == 1009);
  good.say_frame(Raw::kText, "still here");
  CHECK(good.hear_message().payload == "you said still here");
  CHECK(comes_true([&] { return lab.closed == 11; }));
  // The socket is closed if the client does not close it.
  RawClient stays(lab.server.port());
  lab.open(stays);
  stays.say(Raw::frame(Raw::kText, "plain", true, false));
  CHECK(comes_true([&] { return lab.closed == 12; }));
}

TEST_CASE("WebSocket: a reading client gets every message while another does not read") {
  LabHost lab;
  RawClient reads(lab.server.port()), stalled(lab.server.port());
  lab.open(reads);
  lab.open(stalled);
  constexpr int kMessages = 400;
  constexpr std::size_t kSize = 200000;
  double memory = 0;
  for (int n = 0; n < kMessages; ++n) {
    lab.send_to_all(2, numbered(n, kSize), true);
    const Frame frame = reads.hear_message();
    REQUIRE(frame.opcode == RawClient::kBinary);
    REQUIRE(std::stoi(frame.payload) == n);
    REQUIRE(frame.payload.size() == kSize);
    if (n == 40) memory = resident_memory();
  }
  // Of 72 MB one message is waiting.
  if (kMemoryTells) CHECK(resident_memory() - memory < 4);
  // When it reads again: messages in transit in order, then the newest.
  int last = -1, heard = 0;
  for (; last < kMessages - 1; ++heard) {
    const Frame frame = stalled.hear_message();
    REQUIRE(frame.opcode == RawClient::kBinary);
    REQUIRE(std::stoi(frame.payload) > last);
    last = std::stoi(frame.payload);
  }
  CHECK(heard <= 6);
}

TEST_CASE("WebSocket: faster than a client reads, messages stay in order, and the newest arrives") {
  LabHost lab;
  RawClient client(lab.server.port());
  const ClientId number = lab.open(client);
  constexpr int kMessages = 20000;
  std::thread sender([&] {
    for (int n = 0; n < kMessages; ++n) {
      lab.server.send(number, 2, numbered(n, 100), true);
      lab.server.send(number, 1, numbered(n, 100), false);
    }
  });
  int last_text = -1, last_binary = -1;
  bool in_order = true;
  for (; last_text < kMessages - 1 || last_binary < kMessages - 1;) {
    const Frame frame = client.hear_message();
    if (frame.opcode == -1) break;
    int& last = frame.opcode == RawClient::kText ? last_text : last_binary;
    const int now = std::stoi(frame.payload);
    in_order = in_order && now > last;
    last = now;
  }
  sender.join();
  CHECK(in_order);
  CHECK(last_text == kMessages - 1);
  CHECK(last_binary == kMessages - 1);
}

TEST_CASE("outgoing queue: no full channel starves, and channel 0 goes first") {
  OutgoingQueue queue;
  queue.put({3, bytes_of("c"), true});
  queue.put({1, bytes_of("a"), true});
  queue.put({2, bytes_of("b"), true});
  std::string order;
  for (int n = 0; n < 9; ++n) {
    const std::string taken = *queue.take()->bytes;
    order += taken;
    // A newer one in every channel.
    for (int channel = 1; channel <= 3; ++channel)
      queue.put({channel, bytes_of(std::string(1, static_cast<char>('a' + channel - 1))), true});
  }
  CHECK(order.substr(0, 3) == "cab");
  for (const char channel : {'a', 'b', 'c'})
    CHECK(std::count(order.begin(), order.end(), channel) == 3);
  queue.put({0, bytes_of("first"), false});
  CHECK(*queue.take()->bytes == "first");
  CHECK_FALSE(OutgoingQueue().take());
}

TEST_CASE(
    "WebSocket: a client that reads nothing is dropped after the timeout; an idle one is kept") {
  ServerOptions options;
  options.timeout = 1;
  LabHost lab(options);
  RawClient stalled(lab.server.port()), idle(lab.server.port());
  lab.open(stalled);
  const ClientId kept = lab.open(idle);
  const auto start = std::chrono::steady_clock::now();
  lab.server.send(1, 2, bytes_of("not read"), false);
  // Idle clients are pinged.
  std::atomic<bool> stop{false};
  int pings = 0;
  std::thread answers([&] {
    while (!stop) {
      const Frame frame = idle.hear_frame();
      if (frame.opcode != RawClient::kPing) return;
      ++pings;
      idle.say_frame(RawClient::kPong, frame.payload);
    }
  });
  CHECK(comes_true([&] { return lab.closed == 1; }));
  CHECK(std::chrono::steady_clock::now() - start > std::chrono::milliseconds(999));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  CHECK(lab.closed == 1);
  stop = true;
  lab.server.send(kept, 2, bytes_of("wake up"), false);
  answers.join();
  CHECK(pings >= 3);
}

TEST_CASE("WebSocket: the number of clients is limited, and a place is free when one leaves") {
  LabHost lab;
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int n = 0; n < 64; ++n) {
    clients.push_back(std::make_unique<RawClient>(lab.server.port()));
    lab.open(*clients.back());
  }
  const auto refused = RawClient(lab.server.port()).ask(lab.upgrade(lab.cookie()));
  CHECK(refused.status == 503);
  CHECK(refused.body.find("64 pages are open") != std::string::npos);
  CHECK(lab.is_alive());  // requests go on
  clients.pop_back();
  CHECK(comes_true([&] { return lab.closed == 1; }));
  RawClient next(lab.server.port());
  lab.open(next);
  lab.send_to_all(2, bytes_of("all"), false);
  CHECK(next.hear_message().payload == "all");
  for (const auto& client : clients) CHECK(client->hear_message().payload == "all");
}

TEST_CASE("WebSocket: one address does not take the places of all") {
  ServerOptions options;
  options.max_clients = 3;
  options.max_of_address = 2;
  LabHost lab(options);
  const int port = lab.server.port();
  RawClient first(port), second(port), other(port, 2);
  lab.open(first);
  CHECK(lab.last_address == "127.0.0.1");
  lab.open(second);
  const auto refused = RawClient(port).ask(lab.upgrade(lab.cookie()));
  CHECK(refused.status == 503);
  CHECK(refused.body.find("2 pages of 127.0.0.1 are open") != std::string::npos);
  lab.open(other);
  CHECK(lab.last_address == "127.0.0.2");
  // Nor all connections: eight for each page.
  std::vector<std::unique_ptr<RawClient>> more;
  int served = 0;
  for (int n = 0; n < 20; ++n) {
    more.push_back(std::make_unique<RawClient>(port));
    served += more.back()->ask(lab.request("GET /", lab.cookie())).status == 200 ? 1 : 0;
  }
  CHECK(served == 14);
  CHECK(RawClient(port, 2).ask(lab.request("GET /", lab.cookie())).status == 200);
}

TEST_CASE("WebSocket: a client that floods is closed with a reason; others are not affected") {
  ServerOptions options;
  options.messages_per_second = 100;
  LabHost lab(options);
  for (const int opcode : {RawClient::kText, RawClient::kPing, RawClient::kPong}) {
    RawClient floods(lab.server.port()), other(lab.server.port());
    lab.open(floods);
    lab.open(other);
    std::string flood;
    for (int n = 0; n < 3000; ++n) flood += RawClient::frame(opcode, "flood");
    floods.say(flood);
    std::string why;
    CHECK(floods.hear_close(&why) == 1008);
    CHECK(why == "more than 100 messages per second");
    CHECK(comes_true([&] { return lab.closed > 0; }));
    other.say_frame(RawClient::kText, "x");
    CHECK(other.hear_message().payload == "you said x");
  }
}

TEST_CASE("WebSocket: the server ends with open clients of all kinds") {
  std::vector<std::unique_ptr<RawClient>> clients;
  {
    LabHost lab;
    for (int n = 0; n < 12; ++n) {
      clients.push_back(std::make_unique<RawClient>(lab.server.port()));
      if (n % 3 == 0) clients.back()->say("GET / HT");
      if (n % 3 == 1) lab.open(*clients.back());
    }
    for (int n = 0; n < 50; ++n) lab.send_to_all(2, numbered(n, 1 << 20), true);
  }
  for (const auto& client : clients) CHECK(client->hear_end());
}
