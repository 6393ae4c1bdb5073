// Limits of HTTP requests: length, time, bodies at once, connections of strangers, rate.
#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "tests/app/lab/server/lab_host.h"

using namespace twinarm;

TEST_CASE("lab server: requests that are too long or too slow are cut off") {
  ServerOptions options;
  options.max_body = 1000;
  options.timeout = 2;  // half a second for a header
  const LabHost lab(options);
  const int port = lab.server.port();
  CHECK(RawClient(port).ask("GET / HTTP/1.1\r\nA: " + std::string(20000, 'a')).status == 431);
  CHECK(RawClient(port).ask("GET /" + std::string(20000, 'a')).status == 431);
  CHECK(RawClient(port)
            .ask(lab.request("POST /open", lab.cookie() + "Content-Length: 1001\r\n"))
            .status == 413);
  CHECK(RawClient(port)
            .ask(lab.request("POST /open", lab.cookie() + "Transfer-Encoding: chunked\r\n") +
                 "3e9\r\n" + std::string(1001, 'x'))
            .status == 413);
  // Without the token, a body is not even read.
  CHECK(RawClient(port).ask(lab.request("POST /open", "Content-Length: 900\r\n")).status == 403);
  CHECK(RawClient(port).ask(lab.request("GET /", lab.cookie() + "Content-Length: 5\r\n")).status ==
        400);
  RawClient slow(port), idle(port), half(port);
  slow.say("GET / HTTP/1.1\r\nHo");
  half.say(lab.request("POST /open", lab.cookie() + "Content-Length: 10\r\n") + "abc");
  CHECK(slow.hear_end());
  CHECK(idle.hear_end());
  CHECK(half.hear_end());
  CHECK(lab.is_alive());
}

TEST_CASE("lab server: the body of a POST that is not permitted is not read") {
  const LabHost lab;
  const auto reply =
      RawClient(lab.server.port())
          .ask(lab.request("POST /open?refused", lab.cookie() + "Content-Length: 30000000\r\n"));
  CHECK(reply.status == 403);
  CHECK(reply.body.find("another client has control") != std::string::npos);
}

TEST_CASE("lab server: the number of bodies at once is limited") {
  ServerOptions options;
  options.max_posts = 2;
  const LabHost lab(options);
  const int port = lab.server.port();
  const std::string post = lab.request("POST /open", lab.cookie() + "Content-Length: 3\r\n"),
                    whole = post + "abc";
  const auto is_served = [&] { return RawClient(port).ask(whole).status == 200; };
  for (int n = 0; n < 5; ++n) CHECK(is_served());  // one after the other
  auto first = std::make_unique<RawClient>(port);
  RawClient second(port);
  first->say(post);
  second.say(post);
  CHECK(comes_true([&] { return RawClient(port).ask(whole).status == 503; }));
  CHECK(lab.is_alive());
  second.say("abc");
  CHECK(second.hear_reply().status == 200);
  CHECK(is_served());
  CHECK(second.ask(whole).status == 200);  // on the same connection
  second.say(post);
  CHECK(comes_true([&] { return !is_served(); }));
  first.reset();  // leaves in the middle of its body
  CHECK(comes_true([&] { return is_served(); }));
}

TEST_CASE("lab server: clients with the token are served while strangers keep connections open") {
  ServerOptions options;
  options.max_clients = 1;
  const LabHost lab(options);
  std::vector<std::unique_ptr<RawClient>> strangers;
  for (int i = 0; i < 200; ++i) {
    strangers.push_back(std::make_unique<RawClient>(lab.server.port()));
    if (i % 2) strangers.back()->say("GET / HTTP/1.1\r\nHo");
  }
  CHECK(RawClient(lab.server.port()).ask(lab.request("GET /", lab.cookie())).status == 200);
  CHECK(strangers.front()->hear_end());
}

TEST_CASE("lab server: the rate of requests is limited") {
  ServerOptions options;
  options.messages_per_second = 50;
  const LabHost lab(options);
  RawClient client(lab.server.port());
  int done = 0, status = 200;
  for (; status == 200 && done < 5000; ++done)
    status = client.ask(lab.request("GET /", lab.cookie())).status;
  CHECK(status == 429);
  CHECK(done > 50);
  CHECK(client.hear_end());
  CHECK(lab.is_alive());
}
