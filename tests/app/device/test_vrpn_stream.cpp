// VRPN messages without a socket: decoded, skipped, ending the connection.
#include <doctest/doctest.h>

#include <limits>
#include <random>

#include "app/device/vrpn_stream.h"
#include "tests/app/device/vrpn_bytes.h"

using namespace twinarm;
using namespace vrpn_bytes;
using StreamFault = VrpnStream::Error;

namespace {

StreamFault feed(VrpnStream& stream, const Bytes& bytes) {
  return stream.feed(bytes.data(), bytes.size());
}
VrpnStream greeted() {
  VrpnStream stream("Phantom0");
  CHECK(feed(stream, greeting) == StreamFault::none);
  return stream;
}
// Our messages without the time.
Bytes timeless(Bytes bytes, std::size_t at) {
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at) + 4, 8, 0);
  return bytes;
}

}  // namespace

TEST_CASE("VRPN: a handshake gives names of devices and types; pose and buttons are decoded") {
  VrpnStream stream = greeted();
  CHECK(stream.version() == "vrpn: ver. 07.38");
  CHECK(stream.has_device());
  CHECK(stream.devices() == std::vector<std::string>{"Phantom0"});
  CHECK(stream.knows_type(VrpnWriter::kForceName));
  CHECK_FALSE(stream.knows_type(VrpnWriter::kRateName));
  CHECK(stream.poses() == 0);
  CHECK(feed(stream, all({pose, press_0})) == StreamFault::none);
  CHECK(stream.poses() == 1);
  CHECK(stream.pose().p == Vector3(0, -0.11, -0.035));
  CHECK(stream.pose().R == Matrix3::Identity());
  CHECK(stream.buttons() == std::array<bool, 2>{true, false});
  CHECK(feed(stream, all({release_0, press_1})) == StreamFault::none);
  CHECK(stream.buttons() == std::array<bool, 2>{false, true});
  CHECK(stream.malformed() + stream.not_finite() == 0);
}

TEST_CASE("VRPN: the quaternion's scalar is last: w = z = 0.7071 rotates x to y") {
  VrpnStream stream = greeted();
  const double half = std::sqrt(0.5);
  feed(stream, pose_with(6, half, pose_with(5, half)));
  CHECK((stream.pose().R * Vector3::UnitX() - Vector3::UnitY()).norm() < 1e-15);
}

TEST_CASE("VRPN: decoding byte by byte equals decoding at once") {
  VrpnStream stream("Phantom0");
  for (const std::uint8_t byte : all({greeting, press_1, pose, pose_with(0, 0.01)}))
    CHECK_UNARY(stream.feed(&byte, 1) == StreamFault::none);
  CHECK(stream.poses() == 2);
  CHECK(stream.pose().p == Vector3(0.01, -0.11, -0.035));
  CHECK(stream.buttons()[1]);
}

TEST_CASE("VRPN: other senders, sensors and types are ignored") {
  VrpnStream stream = greeted();
  Bytes other_sender = pose, other_sensor = pose, unknown_type = pose;
  other_sender[15] = 9;
  other_sensor[27] = 1;
  unknown_type[19] = 99;
  CHECK(feed(stream, all({other_sender, other_sensor, unknown_type})) == StreamFault::none);
  CHECK(stream.poses() == 0);
  CHECK(stream.malformed() == 0);
}

TEST_CASE("VRPN: a pose that is not finite or not a rotation is skipped") {
  VrpnStream stream = greeted();
  feed(stream, pose);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < 7; ++n)
    for (const double bad : {nan, inf, -inf}) feed(stream, pose_with(n, bad));
  feed(stream, pose_with(6, 0.0));
  feed(stream, pose_with(3, 5.0));
  CHECK(stream.not_finite() == 23);
  CHECK(stream.poses() == 1);
  CHECK(stream.pose().p == Vector3(0, -0.11, -0.035));
}

TEST_CASE("VRPN: a message of wrong length for its type is skipped, the next ones are read") {
  VrpnStream stream = greeted();
  Bytes short_pose = pose, nameless = phantom;
  short_pose[3] = 0x50;  // a number missing
  short_pose.resize(short_pose.size() - 8);
  nameless[27] = 0xff;  // a name longer than its message
  CHECK(feed(stream, all({short_pose, nameless, pose})) == StreamFault::none);
  CHECK(stream.malformed() == 2);
  CHECK(stream.poses() == 1);
}

TEST_CASE("VRPN: another protocol, another version or an invalid length ends the connection") {
  const auto fault_of = [](const Bytes& bytes) {
    VrpnStream stream("Phantom0");
    return feed(stream, bytes);
  };
  CHECK(fault_of(hex("48 54 54 50 2f 31 2e 31")) == StreamFault::not_vrpn);  // HTTP/1.1
  CHECK(fault_of({0}) == StreamFault::not_vrpn);
  Bytes other = cookie;
  other[12] = '8';  // 08.38
  CHECK(fault_of(other) == StreamFault::other_version);
  other[12] = '7';
  other[14] = '0';  // 07.08: only the minor version differs
  CHECK(fault_of(other) == StreamFault::none);
  for (const char* length :
       {"00 00 00 00", "00 00 00 17", "ff ff ff ff", "7f ff ff ff", "00 01 00 00"}) {
    Bytes absurd = pose;
    const Bytes four = hex(length);
    std::copy(four.begin(), four.end(), absurd.begin());
    CHECK(fault_of(all({greeting, pose, absurd})) == StreamFault::bad_length);
  }
  CHECK(fault_of(all({greeting, goodbye, pose})) == StreamFault::goodbye);
}

TEST_CASE("VRPN: our messages equal those that a vrpn_Phantom server reads, byte for byte") {
  VrpnWriter speech;
  VrpnBytes out;
  speech.cookie(out);
  CHECK(out == cookie);
  out.clear();
  speech.describe(out, "Phantom0", true, false);
  // The device has our number 0; type 0 is "vrpn_ForceDevice Force_Field".
  Bytes expected = phantom;
  expected[15] = 0;
  expected[23] = 0;
  Bytes type = force_field;
  type[15] = 0;
  type[23] = 1;
  CHECK(timeless(timeless(out, 0), 40) == timeless(timeless(all({expected, type}), 0), 40));
  out.clear();
  speech.force(out, {0.25, 0, 0}, {1, -0.5, 0.25}, 10);
  // float32: origin, force, nine derivatives, radius; 24 + 64 = 0x58, sequence number 2.
  CHECK(timeless(out, 0) ==
        hex("00 00 00 58|00 00 00 00|00 00 00 00|00 00 00 00|00 00 00 00|00 00 00 02|"
            "3e 80 00 00|00 00 00 00|00 00 00 00|3f 80 00 00|bf 00 00 00|3e 80 00 00|"
            "00 00 00 00|00 00 00 00|00 00 00 00|00 00 00 00|00 00 00 00|00 00 00 00|"
            "00 00 00 00|00 00 00 00|00 00 00 00|41 20 00 00"));
  out.clear();
  speech.request_rate(out, 1);
  CHECK(timeless(out, 0) == hex("00 00 00 20|00 00 00 00|00 00 00 00|00 00 00 00|00 00 00 01|"
                                "00 00 00 03|3f f0 00 00 00 00 00 00"));
}

TEST_CASE("VRPN: ten thousand damaged streams give no crash and no invalid pose") {
  std::mt19937 random(7);
  const auto draw = [&](std::size_t below) { return static_cast<std::size_t>(random()) % below; };
  const Bytes whole = all({greeting, pose, press_0, pose_with(1, 0.02), goodbye});
  long poses = 0;
  for (int n = 0; n < 10000; ++n) {
    Bytes bytes = whole;
    for (std::size_t k = draw(6); k > 0; --k)
      bytes[draw(bytes.size())] = static_cast<std::uint8_t>(random());
    if (draw(3) == 0) bytes.resize(100 + draw(bytes.size() - 100));
    if (draw(3) == 0)
      bytes.erase(bytes.begin() + 30, bytes.begin() + 30 + static_cast<std::ptrdiff_t>(draw(40)));
    VrpnStream stream("Phantom0");
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t count = std::min(1 + draw(60), bytes.size() - at);
      if (stream.feed(bytes.data() + at, count) != StreamFault::none) break;
      at += count;
    }
    CHECK_UNARY(stream.pose().p.allFinite());
    CHECK_UNARY((stream.pose().R.transpose() * stream.pose().R - Matrix3::Identity()).norm() <
                1e-9);
    poses += stream.poses();
  }
  CHECK(poses > 3000);
}
