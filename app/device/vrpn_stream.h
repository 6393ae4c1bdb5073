// Protocol of VRPN, the Virtual Reality Peripheral Network (version 7), over TCP only.
//
// Both sides first send a cookie of 24 bytes: "vrpn: ver. 07.38", two spaces, the digit of a log
// mode, zeros; the major version (07) must be equal. Then messages, all numbers big-endian:
//   int32 length (24 + payload, without padding), seconds, microseconds, sender, type, sequence
//   payload, padded with zeros to a multiple of 8
// Each side numbers its types and senders from 0 on:
//   type -1: `sender` is now the number of the name in the payload (int32 length with final 0,
//   text) type -2: the same for a type;  -3: a UDP port;  -4: log files;  -5: end of the connection
// Without a UDP description from us the server sends everything by TCP. Lengths and names are
// checked: the buffer never holds more than one message of 64 kB.
// Reference: vrpn_Connection.C, vrpn_Tracker.C, vrpn_Button.C, vrpn_ForceDevice.C of VRPN 7.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

using VrpnBytes = std::vector<std::uint8_t>;

// Decodes the messages of a server about one device.
class VrpnStream {
 public:
  enum class Error { none, not_vrpn, other_version, bad_length, goodbye };

  explicit VrpnStream(std::string device) : device_(std::move(device)) {}
  // After a fault the connection is unusable. Malformed messages are counted and skipped.
  Error feed(const std::uint8_t* bytes, std::size_t count);

  bool has_device() const { return senders_.count_of(device_) > 0; }
  bool knows_type(const char* name) const { return types_.count_of(name) > 0; }
  std::vector<std::string> devices() const;                // without the server's own channel
  const std::string& version() const { return version_; }  // of the server's cookie

  const Pose& pose() const { return pose_; }  // newest of sensor 0, server axes [m]
  const std::array<bool, 2>& buttons() const { return buttons_; }
  long poses() const { return poses_; }            // received
  long malformed() const { return malformed_; }    // messages with an invalid payload
  long not_finite() const { return not_finite_; }  // poses that are not finite or not a rotation

 private:
  // Names by the server's numbers.
  struct Names {
    std::map<std::int32_t, std::string> of;
    long count_of(const std::string& name) const;
    bool is(std::int32_t number, const char* name) const;
  };
  struct Message {
    std::int32_t sender, type;
    const std::uint8_t* payload;
    std::size_t size;
  };
  Error read_cookie();
  Error read_messages();
  bool take(const Message& message);
  bool take_name(const Message& message, Names& names);
  bool take_pose(const Message& message);
  bool take_button(const Message& message);
  bool take_states(const Message& message);

  std::string device_, version_;
  VrpnBytes pending_;
  bool has_cookie_ = false;
  Names senders_, types_;
  Pose pose_;
  std::array<bool, 2> buttons_{};
  long poses_ = 0, malformed_ = 0, not_finite_ = 0;
};

// Encodes our messages.
class VrpnWriter {
 public:
  static constexpr const char* kForceName = "vrpn_ForceDevice Force_Field";
  static constexpr const char* kRateName = "vrpn_Tracker set_update_rate";
  static constexpr std::int32_t kDevice = 0;                      // our sender number
  enum Type : std::int32_t { force_field = 0, update_rate = 1 };  // our type numbers

  void cookie(VrpnBytes& out) const;
  // Announces our numbers. Only for types known to the server: it would announce new ones to
  // others.
  void describe(VrpnBytes& out, const std::string& device, bool forces, bool rates);
  // Requested reports per second.
  void request_rate(VrpnBytes& out, double rate);
  // Constant force [N] within `radius` [m] of `origin`; radius 0 ends it.
  void force(VrpnBytes& out, const Vector3& origin, const Vector3& force, double radius);

 private:
  void begin(VrpnBytes& out, std::size_t payload, std::int32_t sender, std::int32_t type);
  void name(VrpnBytes& out, std::int32_t type, std::int32_t number, const std::string& text);
  std::uint32_t sequence_ = 0;
};

}  // namespace twinarm
