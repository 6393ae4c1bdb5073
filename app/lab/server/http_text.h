// Parsing and checking of untrusted HTTP text. No sockets.
#pragma once

#include <vector>

#include "app/lab/server/lab_server.h"

namespace twinarm {

// Well-formed UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
bool is_utf8(std::string_view text);
// "/a%20b" -> "/a b". Nothing if it does not begin with '/', has an invalid escape or "/../", or
// decodes to invalid UTF-8 or control characters.
std::optional<std::string> decoded_path(std::string_view path);
// Comparison in constant time. An empty secret never matches.
bool is_secret(std::string_view given, std::string_view secret);
// Of "a=1; b=2"; empty: not found.
std::string_view cookie_value(std::string_view cookies, std::string_view name);

// Permitted values of the header Host, against DNS rebinding. If the server listens on all
// addresses, any numeric one is permitted.
class HostNames {
 public:
  // address: numeric, of the listening socket; is_any: 0.0.0.0 or ::.
  HostNames(const std::string& address, std::uint16_t port, bool is_loopback, bool is_any);
  bool has(std::string_view host) const;

 private:
  std::vector<std::string> names_;
  std::string port_;
  bool is_any_;
};

// Header fields of a reply besides its own.
struct ResponseHead {
  std::string etag = {};    // quoted; empty: the content may change
  std::string cookie = {};  // "name=value"
  bool is_packed = false;   // gzip
  bool keeps_alive = true;
};
std::string reply_head(const HttpReply& reply, const ResponseHead& head);

// Text of 1 kB to 8 MB.
bool is_packable(const HttpReply& reply);
std::string gzipped(const std::string& bytes);

}  // namespace twinarm
