// The bytes of VRPN, the Virtual Reality Peripheral Network (version 7), over TCP alone.
//
// Both sides first send a cookie of 24 bytes: "vrpn: ver. 07.38", two spaces, the digit of a log
// mode, zeros; sides whose major version (07) is the same understand each other. Then messages:
//   int32 length (24 + payload, padding not counted), seconds, microseconds, sender, type, sequence
//   payload, padded with zeros to a multiple of 8
// all big-endian. Types from 0 on are numbered by each side as it likes, and so are senders:
//   type -1: "sender" now stands for the name in the payload (int32 length with its final 0, text)
//   type -2: the same for a type;  -3: a UDP port;  -4: log files;  -5: goodbye
// Without a UDP description from us the server sends everything by TCP. Lengths and names are
// looked at before they are believed: the buffer never holds more than one message of 64 kB.
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

// What a server has said of one device.
class VrpnStream {
 public:
  enum class Diagnostic { none, not_vrpn, other_version, bad_length, goodbye };

  explicit VrpnStream(std::string device) : device_(std::move(device)) {}
  // After a fault the connection is of no use. Malformed messages are counted and skipped.
  Diagnostic feed(const std::uint8_t* bytes, std::size_t count);

  bool has_device() const { return senders_.count_of(device_) > 0; }
  bool knows_type(const char* name) const { return types_.count_of(name) > 0; }
  std::vector<std::string> devices() const;  // by name, the server's own channel left out
  const std::string& version() const { return version_; }  // of the server's cookie

  const Pose& pose() const { return pose_; }  // newest of sensor 0, the server's axes [m]
  const std::array<bool, 2>& buttons() const { return buttons_; }
  long poses() const { return poses_; }            // that have come
  long malformed() const { return malformed_; }    // messages whose payload is not of their type
  long not_finite() const { return not_finite_; }  // poses without a number or a rotation

 private:
  // Names by the numbers that the server has given them.
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
  Diagnostic read_cookie();
  Diagnostic read_messages();
  void take(const Message& message);
  void take_name(const Message& message, Names& names);
  void take_pose(const Message& message);
  void take_button(const Message& message);
  void take_states(const Message& message);

  std::string device_, version_;
  VrpnBytes pending_;
  bool greeted_ = false;
  Names senders_, types_;
  Pose pose_;
  std::array<bool, 2> buttons_{};
  long poses_ = 0, malformed_ = 0, not_finite_ = 0;
};

// What we say.
class VrpnSpeech {
 public:
  static constexpr const char* kForceName = "vrpn_ForceDevice Force_Field";
  static constexpr const char* kRateName = "vrpn_Tracker set_update_rate";
  static constexpr std::int32_t kDevice = 0;                      // our number of the device
  enum Type : std::int32_t { force_field = 0, update_rate = 1 };  // our numbers of types

  void cookie(VrpnBytes& out) const;
  // Our numbers. Only of types that the server knows: it would tell others of new ones.
  void describe(VrpnBytes& out, const std::string& device, bool forces, bool rates);
  // Reports a second that we would like.
  void ask_rate(VrpnBytes& out, double rate);
  // A force [N] that is the same everywhere within `radius` [m] of `origin`; radius 0 ends it.
  void force(VrpnBytes& out, const Vector3& origin, const Vector3& force, double radius);

 private:
  void begin(VrpnBytes& out, std::size_t payload, std::int32_t sender, std::int32_t type);
  void name(VrpnBytes& out, std::int32_t type, std::int32_t number, const std::string& text);
  std::uint32_t sequence_ = 0;
};

}  // namespace twinarm
