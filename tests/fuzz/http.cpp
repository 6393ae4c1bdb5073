// What comes in at the lab's socket: requests, and the frames of a WebSocket. @HOST@ and @COOKIE@
// stand for the server's name and the line with its token. The server lives on through all of it.
#include "tests/app/lab/server/lab_host.h"

#include "app/lab/server/http_text.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

void put(std::string& text, const std::string& name, const std::string& what) {
  for (std::size_t at = 0; (at = text.find(name, at)) != text.npos; at += what.size())
    text.replace(at, name.size(), what);
}

}  // namespace

void http(Bytes bytes) {
  decoded_path(bytes);
  query_value(bytes, "name");
  cookie_value(bytes, "twinarm_1");
  static LabHost lab;
  std::string said(bytes);
  put(said, "@HOST@", lab.host());
  put(said, "@COOKIE@", lab.cookie());
  RawClient client(lab.server.port());
  client.say(said);
  client.say_no_more();
  require(client.hear_end(), "the server keeps a client that has hung up");
  static int tried = 0;
  if (++tried % 64 == 1) require(lab.is_alive(), "the server answers no more");
}

}  // namespace twinarm::fuzz
