// Thousands of mutated headers and frames: the server stays alive, without a memory leak.
// TWINARM_FUZZ=SECONDS sets the duration, with other seeds (scripts/test: one second).
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/app/lab/server/lab_host.h"

using namespace twinarm;

namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t count) {
  return random() % std::max<std::size_t>(count, 1);
}

// Bytes changed, removed, doubled, inserted, or cut off.
void mutate(std::string& bytes, Random& random) {
  static const std::vector<std::string> kNasty = {
      std::string(1, '\0'),
      "\r\n",
      "\n",
      "\r\n\r\n",
      "%",
      "%00",
      "/../",
      ":",
      " ",
      "\xff",
      "\xc0\x80",
      "?token=",
      "Content-Length: 99999999999999999999\r\n",
      "Content-Length: -1\r\n",
      "Transfer-Encoding: chunked\r\n",
      "Host: a\r\n",
      "Expect: 100-continue\r\n",
      std::string(300, 'A'),
      std::string("\x81\xff\xff\xff\xff\xff\xff\xff", 8),
      std::string("\x88\x80", 2),
      std::string("\x8f\x80", 2)};
  const std::size_t at = below(random, bytes.size()), size = 1 + below(random, 20);
  switch (below(random, 6)) {
    case 0:
      if (!bytes.empty()) bytes[at] = static_cast<char>(random());
      break;
    case 1:
      bytes.erase(at, size);
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, size));
      break;
    case 3:
      bytes.insert(at, kNasty[below(random, kNasty.size())]);
      break;
    case 4:
      if (below(random, 4) == 0) bytes.resize(at);
      break;
    default:
      if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(random, 8));
  }
}

struct Fuzz {
  std::vector<std::string> heads(const LabHost& lab) const {
    return {lab.request("GET /", lab.cookie()),
            lab.request("GET /mesh/12ab?x=%20", lab.cookie()),
            lab.upgrade(lab.cookie() + "Origin: http://" + lab.host() + "\r\n"),
            lab.request("POST /open?name=a.urdf", lab.cookie() + "Content-Length: 11\r\n") +
                "hello world",
            lab.request("POST /open", lab.cookie() + "Transfer-Encoding: chunked\r\n") +
                "5;x=1\r\nhello\r\n0\r\nA: b\r\n\r\n",
            lab.request("GET /?token=" + std::string(LabHost::kToken), "")};
  }
  void one_head(const LabHost& lab) {
    const auto known = heads(lab);
    std::string bytes = known[below(random, known.size())];
    for (std::size_t n = below(random, 6); n-- > 0;) mutate(bytes, random);
    RawClient client(lab.server.port());
    client.say(bytes);
    client.say_no_more();
    REQUIRE(client.hear_end());
  }
  // Twenty frames on one connection: the first invalid one ends it.
  void one_live(LabHost& lab) {
    RawClient client(lab.server.port());
    if (client.ask(lab.upgrade(lab.cookie())).status != 101)
      return;  // earlier ones are still closing
    for (int n = 0; n < 20; ++n) {
      const int opcodes[] = {0, 1, 1, 1, 2, 8, 9, 10, 3};
      std::string bytes =
          RawClient::frame(opcodes[below(random, 9)], std::string(below(random, 300), 'j'),
                           below(random, 4) != 0, below(random, 50) != 0);
      if (below(random, 2) == 0) mutate(bytes, random);
      if (!client.say(bytes)) break;
    }
    client.say_no_more();
    REQUIRE(client.hear_end());
  }
  Random random;
};

}  // namespace

TEST_CASE("lab fuzz: thousands of damaged requests and frames do no harm and leak no memory") {
  const char* asked = std::getenv("TWINARM_FUZZ");
  const double seconds = asked ? std::stod(asked) : 0;
  LabHost lab;
  RawClient observer(lab.server.port());
  lab.open(observer);
  Fuzz fuzz{Random(asked ? std::random_device()() : 20240229u)};
  const auto start = std::chrono::steady_clock::now();
  double memory = 0;
  int rounds = 0;
  for (bool goes_on = true; goes_on; ++rounds) {
    for (int n = 0; n < 100; ++n) fuzz.one_head(lab);
    for (int n = 0; n < 20; ++n) fuzz.one_live(lab);
    REQUIRE(lab.is_alive());
    observer.say_frame(RawClient::kText, "round");
    REQUIRE(observer.hear_message().payload == "you said round");
    if (rounds == 9) memory = resident_memory();
    const double gone =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    goes_on = rounds < 30 || gone < seconds;
  }
  CHECK(lab.opened - lab.closed >= 1);  // the observer
  CHECK(comes_true([&] { return lab.opened - lab.closed == 1; }));
  if (kMemoryTells) CHECK(resident_memory() - memory < 3);
  if (asked) MESSAGE(rounds << " rounds of 100 heads and 20 connections");
}
