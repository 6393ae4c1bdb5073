// The words of HTTP that a server has to judge before it trusts them. No sockets here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/server/lab_server.h"

namespace twinarm {

// Well-formed UTF-8: nothing overlong, no surrogates, nothing beyond U+10FFFF.
bool is_utf8(std::string_view text);
// "/a%20b" -> "/a b". Nothing where it does not begin with '/', has a broken escape or a step
// upwards ("/../"), or is not UTF-8 or not text (control characters) once decoded.
std::optional<std::string> decoded_path(std::string_view path);
// Takes as long for a wrong secret as for the right one. An empty one is never right.
bool is_secret(std::string_view given, std::string_view secret);
// As it stands in "a=1; b=2"; empty where it is not there.
std::string_view cookie_value(std::string_view cookies, std::string_view name);

// Who this server is: what may stand in Host. A foreign name that is made to lead here is not
// among them. Where all addresses of the machine are listened on, any numeric one is right: only
// names can be made to lead elsewhere.
class HostNames {
 public:
  // address: as it is listened on, numeric; is_any: 0.0.0.0 or ::.
  HostNames(const std::string& address, std::uint16_t port, bool is_loopback, bool is_any);
  bool has(std::string_view host) const;

 private:
  std::vector<std::string> names_;
  std::string port_;
  bool is_any_;
};

struct ResponseHead {
  int status = 200;
  std::string_view type;
  std::size_t size = 0;
  std::string etag;  // where the content never changes; quoted
  std::string_view file_name;
  std::string cookie;      // "name=value"
  bool is_packed = false;  // gzip
  bool keeps_alive = true;
};
std::string to_string(const ResponseHead& head);

// Worth packing: text of some length.
bool is_packable(const HttpReply& reply);
std::string gzipped(const std::string& bytes);

}  // namespace twinarm
