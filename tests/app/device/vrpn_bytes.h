// The bytes of a VRPN server, written out by hand from the text of the protocol (vrpn_Connection.C,
// vrpn_Tracker.C, vrpn_Button.C and vrpn_ForceDevice.C of VRPN 7), none of them by our own encoder.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

namespace vrpn_bytes {

using Bytes = std::vector<std::uint8_t>;

// "76 72 70" to bytes; '|' parts fields for readers.
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

// v  r  p  n  :     v  e  r  .     0  7  .  3  8        0 (no logs), zeros up to 24 bytes.
inline const Bytes cookie =
    hex("76 72 70 6e 3a 20 76 65 72 2e 20 30 37 2e 33 38 20 20 30 00 00 00 00 00");

// Header: length, seconds, microseconds, sender, type, sequence number. A description bears the
// number that it describes as its sender; type -1 describes a sender, -2 a type.
// Sender 0 is "VRPN Control" (13 with its zero): 24 + 4 + 13 = 0x29, 7 zeros up to 24.
inline const Bytes control =
    hex("00 00 00 29|5b 9b c4 00|00 00 00 01|00 00 00 00|ff ff ff ff|00 00 00 00|"
        "00 00 00 0d|56 52 50 4e 20 43 6f 6e 74 72 6f 6c 00|00 00 00 00 00 00 00");
// Sender 3 is "Phantom0": 24 + 4 + 9 = 0x25, 3 zeros up to 16.
inline const Bytes phantom =
    hex("00 00 00 25|5b 9b c4 00|00 00 00 01|00 00 00 03|ff ff ff ff|00 00 00 01|"
        "00 00 00 09|50 68 61 6e 74 6f 6d 30 00|00 00 00");
// Type 5 is "vrpn_Tracker Pos_Quat": 24 + 4 + 22 = 0x32, 6 zeros up to 32.
inline const Bytes pos_quat =
    hex("00 00 00 32|5b 9b c4 00|00 00 00 01|00 00 00 05|ff ff ff fe|00 00 00 02|"
        "00 00 00 16|76 72 70 6e 5f 54 72 61 63 6b 65 72 20 50 6f 73 5f 51 75 61 74 00|00 00 00 00 "
        "00 00");
// Type 6 is "vrpn_Button Change": 24 + 4 + 19 = 0x2f, one zero up to 24.
inline const Bytes button_change =
    hex("00 00 00 2f|5b 9b c4 00|00 00 00 01|00 00 00 06|ff ff ff fe|00 00 00 03|"
        "00 00 00 13|76 72 70 6e 5f 42 75 74 74 6f 6e 20 43 68 61 6e 67 65 00|00");
// Type 7 is "vrpn_ForceDevice Force_Field": 24 + 4 + 29 = 0x39, 7 zeros up to 40.
inline const Bytes force_field =
    hex("00 00 00 39|5b 9b c4 00|00 00 00 01|00 00 00 07|ff ff ff fe|00 00 00 04|00 00 00 1d|"
        "76 72 70 6e 5f 46 6f 72 63 65 44 65 76 69 63 65 20 46 6f 72 63 65 5f 46 69 65 6c 64 00|"
        "00 00 00 00 00 00 00");
// What a server says first. A UDP description too (type -3), with its port (0x1f41) as sender and
// the address "127.0.0.1" as payload, 24 + 10 = 0x22, which is not for us.
inline const Bytes udp =
    hex("00 00 00 22|5b 9b c4 00|00 00 00 01|00 00 1f 41|ff ff ff fd|00 00 00 05|"
        "31 32 37 2e 30 2e 30 2e 31 00|00 00 00 00 00 00");
inline const Bytes greeting =
    all({cookie, udp, control, phantom, pos_quat, button_change, force_field});

// Sensor 0 of sender 3, type 5: 24 + 8 + 7 * 8 = 0x58. All joints at zero: position
// (0, -0.11, -0.035), where the published kinematics has it, and no turn: quaternion x, y, z, w.
inline const Bytes pose =
    hex("00 00 00 58|5b 9b c4 00|00 00 00 02|00 00 00 03|00 00 00 05|00 00 00 06|00 00 00 00|00 00 "
        "00 00|"
        "00 00 00 00 00 00 00 00|bf bc 28 f5 c2 8f 5c 29|bf a1 eb 85 1e b8 51 ec|"
        "00 00 00 00 00 00 00 00|00 00 00 00 00 00 00 00|00 00 00 00 00 00 00 00|3f f0 00 00 00 00 "
        "00 00");
// Button 0 and button 1 pressed; 24 + 8 = 0x20.
inline const Bytes press_0 =
    hex("00 00 00 20|5b 9b c4 00|00 00 00 03|00 00 00 03|00 00 00 06|00 00 00 07|00 00 00 00|00 00 "
        "00 01");
inline const Bytes press_1 =
    hex("00 00 00 20|5b 9b c4 00|00 00 00 03|00 00 00 03|00 00 00 06|00 00 00 07|00 00 00 01|00 00 "
        "00 01");
inline const Bytes release_0 =
    hex("00 00 00 20|5b 9b c4 00|00 00 00 03|00 00 00 03|00 00 00 06|00 00 00 07|00 00 00 00|00 00 "
        "00 00");
inline const Bytes goodbye =
    hex("00 00 00 18|5b 9b c4 00|00 00 00 04|00 00 00 00|ff ff ff fb|00 00 00 08");

// The pose above with another number in place of its n-th (x, y, z, then the quaternion).
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
