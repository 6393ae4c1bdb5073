// Bytes of a VRPN server, written by hand from vrpn_Connection.C, vrpn_Tracker.C, vrpn_Button.C and
// vrpn_ForceDevice.C of VRPN 7, not by our encoder.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace vrpn_bytes {

using Bytes = std::vector<std::uint8_t>;

// "76 72 70" to bytes; '|' separates fields.
inline Bytes hex(const char* text) {
  Bytes bytes;
  int digits = 0, value = 0;
  for (const char* c = text; *c; ++c) {
    if (*c == ' ' || *c == '|') continue;
    value = 16 * value + (*c <= '9' ? *c - '0' : *c - 'a' + 10);
    if (++digits % 2 == 0) {
      bytes.push_back(static_cast<std::uint8_t>(value));
      value = 0;
    }
  }
  return bytes;
}
inline Bytes all(std::initializer_list<Bytes> parts) {
  Bytes bytes;
  for (const Bytes& part : parts) bytes.insert(bytes.end(), part.begin(), part.end());
  return bytes;
}

// By its name in vrpn_bytes.txt.
inline Bytes message(const std::string& name) {
  std::istringstream file(twinarm::test_data("app/device/vrpn_bytes.txt"));
  for (std::string line; std::getline(file, line);)
    if (line.rfind(name + " ", 0) == 0) return hex(line.c_str() + name.size());
  throw std::runtime_error("there is no message " + name);
}

inline const Bytes cookie = message("cookie");
inline const Bytes control = message("control");
inline const Bytes phantom = message("phantom");
inline const Bytes pos_quat = message("pos_quat");
inline const Bytes button_change = message("button_change");
inline const Bytes force_field = message("force_field");
inline const Bytes greeting =
    all({cookie, message("udp"), control, phantom, pos_quat, button_change, force_field});
inline const Bytes pose = message("pose");
inline const Bytes press_0 = message("press_0");
inline const Bytes press_1 = message("press_1");
inline const Bytes release_0 = message("release_0");
inline const Bytes goodbye = message("goodbye");

// The pose above with another n-th number (x, y, z, quaternion).
inline Bytes pose_with(std::size_t n, double value, Bytes bytes = pose) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (std::size_t b = 0; b < 8; ++b)
    bytes[32 + 8 * n + b] = static_cast<std::uint8_t>(bits >> (56 - 8 * b));
  return bytes;
}
inline float float_at(const Bytes& bytes, std::size_t at) {
  const std::uint32_t bits = std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
                             std::uint32_t{bytes[at + 2]} << 8 | std::uint32_t{bytes[at + 3]};
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace vrpn_bytes
