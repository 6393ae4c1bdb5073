#include "app/lab/server/http_text.h"

#include <arpa/inet.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <boost/beast/http/status.hpp>
#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "solver/support/text.h"

namespace twinarm {
namespace {

std::optional<std::string> unescaped(std::string_view text, bool plus_is_space) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%') {
      const std::string_view digits = text.substr(i + 1, 2);
      unsigned char byte = 0;
      const auto end = digits.data() + digits.size();
      if (digits.size() < 2 || std::from_chars(digits.data(), end, byte, 16).ptr != end) return {};
      plain += static_cast<char>(byte);
      i += 2;
    } else {
      plain += plus_is_space && text[i] == '+' ? ' ' : text[i];
    }
  }
  const bool is_text = std::ranges::none_of(
      plain, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  if (!is_text || !is_utf8(plain)) return {};
  return plain;
}

// Of "a=1; b": the text after the name and '='.
std::optional<std::string_view> value_in(std::string_view pairs, char separator,
                                         std::string_view name) {
  while (!pairs.empty()) {
    std::string_view pair = pairs.substr(0, pairs.find(separator));
    pairs.remove_prefix(std::min(pairs.size(), pair.size() + 1));
    pair.remove_prefix(std::min(pair.size(), pair.find_first_not_of(' ')));
    const std::size_t end = std::min(pair.find('='), pair.size());
    if (pair.substr(0, end) == name) return pair.substr(std::min(end + 1, pair.size()));
  }
  return {};
}

bool is_numeric(std::string_view host) {
  std::string text(host);
  std::array<unsigned char, 16> bytes{};
  if (inet_pton(AF_INET, text.c_str(), bytes.data()) == 1) return true;
  if (text.size() < 3 || text.front() != '[' || text.back() != ']') return false;
  return inet_pton(AF_INET6, text.substr(1, text.size() - 2).c_str(), bytes.data()) == 1;
}

// Without characters that would end a header line or a quoted string.
std::string header_text(std::string_view text) {
  std::string safe(text);
  for (char& c : safe)
    if (c < 0x20 || c == 0x7f || c == '"' || c == '\\') c = '_';
  return safe;
}

}  // namespace

bool is_utf8(std::string_view text) {
  try {
    (void)nlohmann::json(std::string(text)).dump();
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

std::optional<std::string> decoded_path(std::string_view path) {
  if (path.empty() || path.front() != '/') return {};
  std::optional<std::string> plain = unescaped(path, false);
  if (plain && (*plain + "/").find("/../") != std::string::npos) return {};
  return plain;
}

std::optional<std::string> query_value(std::string_view query, std::string_view name) {
  const std::optional<std::string_view> value = value_in(query, '&', name);
  return value ? unescaped(*value, true) : std::nullopt;
}

bool is_secret(std::string_view given, std::string_view secret) {
  if (secret.empty()) return false;
  unsigned different = given.size() != secret.size();
  for (std::size_t i = 0; i < secret.size(); ++i)
    different |= static_cast<unsigned>(secret[i] ^ (given.empty() ? 0 : given[i % given.size()]));
  return different == 0;
}

std::string_view cookie_value(std::string_view cookies, std::string_view name) {
  return value_in(cookies, ';', name).value_or("");
}

HostNames::HostNames(const std::string& address, std::uint16_t port, bool is_loopback, bool is_any)
    : port_(":" + std::to_string(port)), is_any_(is_any) {
  names_.push_back(address.find(':') == address.npos ? address : "[" + address + "]");
  if (is_loopback || is_any) names_.push_back("localhost");
  std::array<char, 256> own{};
  if (!is_loopback && gethostname(own.data(), own.size() - 1) == 0) names_.push_back(own.data());
}

bool HostNames::has(std::string_view host) const {
  if (host.size() > port_.size() && host.substr(host.size() - port_.size()) == port_)
    host.remove_suffix(port_.size());
  else if (port_ != ":80")
    return false;
  return std::ranges::find(names_, host) != names_.end() || (is_any_ && is_numeric(host));
}

std::string reply_head(const HttpReply& reply, const ResponseHead& head) {
  const auto reason = boost::beast::http::obsolete_reason(
      boost::beast::http::int_to_status(static_cast<unsigned>(reply.status)));
  std::string text = "HTTP/1.1 " + std::to_string(reply.status) + ' ';
  text.append(reason.data(), reason.size());
  if (reply.status != 304) {
    text += "\r\nContent-Type: " + header_text(reply.type);
    text += "\r\nContent-Length: " + std::to_string(reply.body->size());
  }
  if (head.is_packed) text += "\r\nContent-Encoding: gzip";
  if (head.etag.empty())
    text += "\r\nCache-Control: no-store";
  else
    text += "\r\nCache-Control: private, max-age=31536000, immutable\r\nETag: " + head.etag;
  if (!reply.file_name.empty())
    text += "\r\nContent-Disposition: attachment; filename=\"" + header_text(reply.file_name) + '"';
  if (!head.cookie.empty())
    text += "\r\nSet-Cookie: " + header_text(head.cookie) + "; Path=/; HttpOnly; SameSite=Strict";
  if (reply.status == 405) text += "\r\nAllow: GET, HEAD, POST";
  if (!head.keeps_alive) text += "\r\nConnection: close";
  return text +
         "\r\nVary: Accept-Encoding, Cookie\r\nX-Content-Type-Options: nosniff"
         "\r\nReferrer-Policy: no-referrer\r\nX-Frame-Options: DENY\r\n\r\n";
}

bool is_packable(const HttpReply& reply) {
  const bool is_text =
      reply.type.starts_with("text/") || reply.type.starts_with("application/json");
  return reply.status == 200 && is_text && reply.file_name.empty() && reply.body->size() > 1024 &&
         reply.body->size() < (std::size_t{8} << 20);
}

std::string gzipped(const std::string& bytes) {
  constexpr int kGzip = 15 + 16;  // largest window, gzip header
  z_stream stream{};
  if (deflateInit2(&stream, 6, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib: deflateInit2 failed");
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("zlib: deflate failed");
  return packed;
}

}  // namespace twinarm
