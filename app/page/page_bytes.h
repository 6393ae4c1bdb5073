// The arrays of a page as one block: deflated, in base64, and told in its JSON by where they lie.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/data/json_writer.h"

namespace twinarm {

class PageBytes {
 public:
  // Writes {"at": byte, "count": n, "type": "f64"} as the value of the key.
  template <class T>
  void add(JsonWriter& json, const char* key, const std::vector<T>& values) {
    json.key(key);
    write_place(json, values.data(), values.size(), sizeof(T), type_name(T{}));
  }
  std::size_t size() const { return bytes_.size(); }
  std::string packed() const;  // zlib's format, then base64

 private:
  static const char* type_name(std::uint8_t) { return "u8"; }
  static const char* type_name(std::int8_t) { return "i8"; }
  static const char* type_name(std::uint16_t) { return "u16"; }
  static const char* type_name(std::int16_t) { return "i16"; }
  static const char* type_name(std::uint32_t) { return "u32"; }
  static const char* type_name(float) { return "f32"; }
  static const char* type_name(double) { return "f64"; }
  void write_place(JsonWriter& json, const void* data, std::size_t count, std::size_t size,
                   const char* type);

  std::string bytes_;
};

}  // namespace twinarm
