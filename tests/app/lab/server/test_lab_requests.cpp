// HTTP requests: access and replies.
#include <doctest/doctest.h>
#include <zlib.h>

#include <memory>
#include <vector>

#include "app/lab/server/http_text.h"
#include "solver/support/diagnostics.h"
#include "tests/app/lab/server/lab_host.h"

using namespace twinarm;

namespace {

std::string unzipped(const std::string& packed, std::size_t size) {
  std::string plain(size, '\0');
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(plain.data());
  stream.avail_out = static_cast<uInt>(plain.size());
  const int result = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  return result == Z_STREAM_END ? plain : "not gzip";
}

}  // namespace

TEST_CASE("lab server: a request without the token is refused with a remedy") {
  const LabHost lab;
  for (const std::string line :
       {"GET /", "GET /mesh/1", "POST /open", "GET /?token=", "GET /?token=wrong",
        "GET /?token=0123456789abcde", "GET /?token=0123456789abcdef0",
        "GET /?tokens=0123456789abcdef"}) {
    CAPTURE(line);
    const auto reply = RawClient(lab.server.port()).ask(lab.request(line, ""));
    CHECK(reply.status == 403);
    CHECK(reply.body.find("?token=") != std::string::npos);
    CHECK(reply.field("Set-Cookie").empty());
  }
  CHECK(RawClient(lab.server.port()).ask(lab.upgrade("")).status == 403);
  const std::string name = "Cookie: twinarm_" + std::to_string(lab.server.port());
  CHECK(RawClient(lab.server.port()).ask(lab.upgrade(name + "=0123\r\n")).status == 403);
  CHECK(RawClient(lab.server.port())
            .ask(lab.upgrade("Cookie: twinarm=" + std::string(LabHost::kToken) + "\r\n"))
            .status == 403);
}

TEST_CASE("lab server: the token in the first address sets a cookie that scripts cannot read") {
  const LabHost lab;
  RawClient client(lab.server.port());
  const std::string token = LabHost::kToken;
  CHECK(lab.server.url() == "http://" + lab.host() + "/?token=" + token);
  const auto first = client.ask(lab.request("GET /?a=b&token=" + token, ""));
  CHECK(first.status == 200);
  const std::string cookie = first.field("Set-Cookie");
  CHECK(cookie == "twinarm_" + std::to_string(lab.server.port()) + "=" + token +
                      "; Path=/; HttpOnly; SameSite=Strict");
  // The same connection.
  const auto second = client.ask(
      lab.request("GET /x%20y", "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n"));
  CHECK(second.status == 200);
  CHECK(second.body == "GET /x y ");
  CHECK(second.field("Set-Cookie").empty());
  for (const auto& reply : {first, second}) {
    CHECK(reply.field("X-Content-Type-Options") == "nosniff");
    CHECK(reply.field("Referrer-Policy") == "no-referrer");
    CHECK(reply.field("X-Frame-Options") == "DENY");
    CHECK(reply.field("Cache-Control") == "no-store");
  }
}

TEST_CASE("lab server: a foreign host name is refused, with or without the token") {
  const LabHost lab;
  const std::string port = std::to_string(lab.server.port());
  const auto status = [&](const std::string& hosts) {
    return RawClient(lab.server.port())
        .ask("GET / HTTP/1.1\r\n" + hosts + lab.cookie() + "\r\n")
        .status;
  };
  CHECK(status("Host: 127.0.0.1:" + port + "\r\n") == 200);
  CHECK(status("Host: localhost:" + port + "\r\n") == 200);
  for (const std::string& host :
       {"evil.example:" + port, std::string("127.0.0.1"), "127.0.0.1:1" + port,
        "localhost.evil.example:" + port, "10.0.0.1:" + port, std::string(), ":" + port})
    CHECK_MESSAGE(status("Host: " + host + "\r\n") == 403, host);
  CHECK(status("") == 403);
  CHECK(status("Host: 127.0.0.1:" + port + "\r\nHost: evil.example\r\n") == 403);
}

TEST_CASE("lab server: on all addresses any numeric host is permitted, but no foreign name") {
  const HostNames any("0.0.0.0", 8080, false, true);
  for (const char* host : {"192.168.1.7:8080", "[fe80::1]:8080", "localhost:8080"})
    CHECK(any.has(host));
  for (const char* host :
       {"evil.example:8080", "192.168.1.7:80", "192.168.1.7", "[evil]:8080", "1.2.3:8080"})
    CHECK_FALSE(any.has(host));
  CHECK(HostNames("::1", 80, true, false).has("[::1]"));
  CHECK_FALSE(HostNames("10.0.0.2", 80, false, false).has("localhost"));
}

TEST_CASE("lab server: cross-origin requests are refused, even with the cookie") {
  const LabHost lab;
  const auto status = [&](const std::string& origin, bool is_live) {
    const std::string more = lab.cookie() + (origin.empty() ? "" : "Origin: " + origin + "\r\n");
    RawClient client(lab.server.port());
    return client
        .ask(is_live ? lab.upgrade(more)
                     : lab.request("POST /open", more + "Content-Length: 0\r\n"))
        .status;
  };
  for (const bool is_live : {false, true}) {
    const int done = is_live ? 101 : 200;
    CHECK(status("", is_live) == done);  // not a browser
    CHECK(status("http://" + lab.host(), is_live) == done);
    for (const std::string& origin :
         {std::string("http://evil.example"), std::string("null"), "https://" + lab.host(),
          std::string("http://127.0.0.1:1"), "http://" + lab.host() + ".evil.example"})
      CHECK_MESSAGE(status(origin, is_live) == 403, origin);
  }
}

TEST_CASE("lab server: a request reaches the handler, and its reply the client") {
  LabHost lab;
  const int port = lab.server.port();
  CHECK(RawClient(port)
            .ask(lab.request("POST /open?name=a", lab.cookie() + "Content-Length: 3\r\n") + "abc")
            .body == "POST /open abc");
  CHECK(RawClient(port)
            .ask(lab.request("POST /open", lab.cookie() + "Transfer-Encoding: chunked\r\n") +
                 "2\r\nab\r\n1\r\nc\r\n0\r\n\r\n")
            .body == "POST /open abc");
  const auto head = RawClient(port).ask(lab.request("HEAD /x", lab.cookie()));
  CHECK(head.status == 200);
  CHECK(head.field("Content-Length") == "7");
  for (const char* line : {"PUT /", "DELETE /", "OPTIONS /", "TRACE /"})
    CHECK(RawClient(port).ask(lab.request(line, lab.cookie())).status == 405);
  for (const char* line : {"GET /%ff", "GET /%e0%80%80", "GET /a%00b", "GET /%zz", "GET /a%0ab",
                           "GET a", "GET /a/../b", "GET /%2e%2e/b"})
    CHECK_MESSAGE(RawClient(port).ask(lab.request(line, lab.cookie())).status == 400, line);
  CHECK(RawClient(port).ask(lab.request("GET /%c3%a9", lab.cookie())).body == "GET /\xc3\xa9 ");
  lab.http = [](const HttpRequest&, const auto&) {
    throw std::runtime_error("of a test, on purpose");
  };
  CHECK(RawClient(port).ask(lab.request("GET /", lab.cookie())).status == 500);
}

TEST_CASE("lab server: a reply may come later, from any thread, even after the server's end") {
  std::function<void(HttpReply)> kept;
  {
    LabHost lab;
    lab.http = [&](const HttpRequest& asked, auto answer) {
      kept = answer;
      if (asked.path != "/later") return;
      std::thread([answer] {
        answer({200, "text/plain", bytes_of("later"), false, {}});
        answer({200, "text/plain", bytes_of("twice"), false, {}});
      }).detach();
    };
    RawClient client(lab.server.port());
    CHECK(client.ask(lab.request("GET /later", lab.cookie())).body == "later");
    CHECK(client.ask(lab.request("GET /later", lab.cookie())).body == "later");
    client.say(lab.request("GET /never", lab.cookie()));
    CHECK(comes_true([&] {
      const std::lock_guard lock(lab.mutex);
      return kept != nullptr;
    }));
  }
  kept({200, "text/plain", bytes_of("too late"), false, {}});
}

TEST_CASE("lab server: immutable replies are cached; text is compressed if accepted") {
  LabHost lab;
  const std::string page(100000, 'p');
  lab.http = [&](const HttpRequest& asked, const auto& answer) {
    const bool is_page = asked.path == "/";
    answer({200, is_page ? "text/html; charset=utf-8" : "application/octet-stream", bytes_of(page),
            !is_page, asked.path == "/save" ? "a\"b\n.twinrec" : ""});
  };
  RawClient client(lab.server.port());
  const auto mesh =
      client.ask(lab.request("GET /mesh/4f2a", lab.cookie() + "Accept-Encoding: gzip\r\n"));
  CHECK(mesh.body == page);
  CHECK(mesh.field("Cache-Control").find("immutable") != std::string::npos);
  const std::string tag = mesh.field("ETag");
  CHECK(tag.find("4f2a") != std::string::npos);
  const auto again =
      client.ask(lab.request("GET /mesh/4f2a", lab.cookie() + "If-None-Match: " + tag + "\r\n"));
  CHECK(again.status == 304);
  CHECK(again.field("Content-Length").empty());
  const auto packed =
      client.ask(lab.request("GET /", lab.cookie() + "Accept-Encoding: deflate, gzip, br\r\n"));
  CHECK(packed.field("Content-Encoding") == "gzip");
  CHECK(packed.body.size() < 1000);
  CHECK(unzipped(packed.body, page.size()) == page);
  CHECK(client.ask(lab.request("GET /", lab.cookie())).body == page);
  CHECK(client.ask(lab.request("GET /save", lab.cookie())).field("Content-Disposition") ==
        "attachment; filename=\"a_b_.twinrec\"");
}

TEST_CASE("lab server: an unusable address is refused with a remedy") {
  const LabHost lab;
  ServerOptions options;
  options.port = lab.server.port();
  for (const std::string address : {"127.0.0.1", "not-a-number", "203.0.113.7"}) {
    options.address = address;
    try {
      LabServer second(options, {});
      FAIL("two servers on one port, or an address that is not ours");
    } catch (const InputError& error) {
      REQUIRE(error.faults().size() == 1);
      CHECK(error.faults()[0].problem.find(address) != std::string::npos);
      CHECK_FALSE(error.faults()[0].fix.empty());
    }
  }
}

TEST_CASE("lab server: UTF-8 as in RFC 3629") {
  for (const char* good : {"", "a", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                           "\xee\x80\x80", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
    CHECK(is_utf8(good));
  for (const char* bad :
       {"\x80", "\xc0\x80", "\xc1\xbf", "\xc2", "\xc2\x41", "\xe0\x9f\xbf", "\xed\xa0\x80",
        "\xe2\x82", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff"})
    CHECK_FALSE(is_utf8(bad));
  CHECK(query_value("a=1&name=x%20y+z%26&b", "name") == "x y z&");
  CHECK(query_value("a=1&b", "b") == "");
  CHECK_FALSE(query_value("a=1", "b"));
  CHECK_FALSE(query_value("b=%f", "b"));
  CHECK(random_token().size() == 32);
  CHECK(random_token() != random_token());
}
