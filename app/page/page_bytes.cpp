#include "app/page/page_bytes.h"

#include <zlib.h>

#include <stdexcept>

namespace twinarm {
namespace {

std::string base64_of(const std::string& bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * ((bytes.size() + 2) / 3));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace

void PageBytes::write_place(JsonWriter& json, const void* data, std::size_t count, std::size_t size,
                            const char* type) {
  bytes_.resize((bytes_.size() + 7) / 8 * 8);
  json.begin_object();
  json.key("at").count(static_cast<long>(bytes_.size()));
  json.key("count").count(static_cast<long>(count));
  json.key("type").text(type);
  json.end_object();
  bytes_.append(static_cast<const char*>(data), count * size);
}

std::string PageBytes::packed() const {
  uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
  std::string deflated(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes_.data()),
                               static_cast<uLong>(bytes_.size()), 8);
  if (result != Z_OK) throw std::runtime_error("zlib: compress2 failed");
  deflated.resize(size);
  return base64_of(deflated);
}

}  // namespace twinarm
