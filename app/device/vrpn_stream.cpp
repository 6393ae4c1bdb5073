#include "app/device/vrpn_stream.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>

namespace twinarm {
namespace {

constexpr std::size_t kVrpnCookie = 24, kVrpnHeader = 24, kVrpnAlign = 8;
constexpr std::size_t kVrpnVersion = 16;       // of the cookie: "vrpn: ver. 07.38"
constexpr std::size_t kVrpnMajor = 14;         // of it: all but the minor version
constexpr std::size_t kVrpnMaxLength = 64000;  // buffer of VRPN connections
constexpr std::size_t kVrpnMaxName = 100;      // its cName
constexpr std::int32_t kVrpnMaxNames = 2000;   // its translation tables
constexpr const char* kVrpnCookieText = "vrpn: ver. 07.38  0";

std::size_t padded(std::size_t size) {
  return (size + kVrpnAlign - 1) / kVrpnAlign * kVrpnAlign;
}

std::uint32_t read_u32(const std::uint8_t* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 |
         std::uint32_t{at[3]};
}
std::int32_t read_i32(const std::uint8_t* at) {
  return static_cast<std::int32_t>(read_u32(at));
}
double read_f64(const std::uint8_t* at) {
  return std::bit_cast<double>(std::uint64_t{read_u32(at)} << 32 | read_u32(at + 4));
}

void write_u32(VrpnBytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift));
}
void write_f32(VrpnBytes& out, double value) {
  write_u32(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

}  // namespace

long VrpnStream::Names::count_of(const std::string& name) const {
  return std::ranges::count_if(of, [&](const auto& item) { return item.second == name; });
}

bool VrpnStream::Names::is(std::int32_t number, const char* name) const {
  const auto found = of.find(number);
  return found != of.end() && found->second == name;
}

std::vector<std::string> VrpnStream::devices() const {
  std::vector<std::string> names;
  for (const auto& [number, name] : senders_.of)
    if (name != "VRPN Control") names.push_back(name);
  return names;
}

VrpnStream::Error VrpnStream::feed(const std::uint8_t* bytes, std::size_t count) {
  pending_.insert(pending_.end(), bytes, bytes + count);
  if (!has_cookie_) {
    const Error fault = read_cookie();
    if (fault != Error::none || !has_cookie_) return fault;
  }
  return read_messages();
}

VrpnStream::Error VrpnStream::read_cookie() {
  const char* text = reinterpret_cast<const char*>(pending_.data());
  // Checked as bytes arrive: a peer that sends three wrong bytes and waits is detected.
  const std::size_t known = std::min(pending_.size(), std::strlen("vrpn: ver. "));
  if (std::memcmp(text, kVrpnCookieText, known) != 0) return Error::not_vrpn;
  if (pending_.size() < kVrpnCookie) return Error::none;
  version_.assign(text, kVrpnVersion);
  if (std::memcmp(text, kVrpnCookieText, kVrpnMajor) != 0) return Error::other_version;
  has_cookie_ = true;
  pending_.erase(pending_.begin(), pending_.begin() + kVrpnCookie);
  return Error::none;
}

VrpnStream::Error VrpnStream::read_messages() {
  std::size_t at = 0;
  Error fault = Error::none;
  while (pending_.size() - at >= kVrpnHeader) {
    const std::uint8_t* header = pending_.data() + at;
    const std::uint32_t length = read_u32(header);
    if (length < kVrpnHeader || length > kVrpnMaxLength) return Error::bad_length;
    const std::size_t size = length - kVrpnHeader;
    if (pending_.size() - at < kVrpnHeader + padded(size)) break;
    const Message message{read_i32(header + 12), read_i32(header + 16), header + kVrpnHeader, size};
    at += kVrpnHeader + padded(size);
    if (message.type == -5) {
      fault = Error::goodbye;
      break;
    }
    if (!take(message)) ++malformed_;
  }
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(at));
  return fault;
}

// Each take() returns whether the payload is valid.
bool VrpnStream::take(const Message& message) {
  if (message.type == -1) return take_name(message, senders_);
  if (message.type == -2) return take_name(message, types_);
  if (message.type < 0 || !senders_.is(message.sender, device_.c_str())) return true;
  if (types_.is(message.type, "vrpn_Tracker Pos_Quat")) return take_pose(message);
  if (types_.is(message.type, "vrpn_Button Change")) return take_button(message);
  return !types_.is(message.type, "vrpn_Button States") || take_states(message);
}

bool VrpnStream::take_name(const Message& message, Names& names) {
  const std::uint32_t length = message.size >= 4 ? read_u32(message.payload) : 0;
  const bool fits = length >= 1 && length <= kVrpnMaxName && message.size >= 4 + length;
  if (!fits || message.sender < 0 || message.sender >= kVrpnMaxNames) return false;
  std::string name(reinterpret_cast<const char*>(message.payload) + 4, length);
  names.of[message.sender] = name.substr(0, name.find('\0'));
  return true;
}

bool VrpnStream::take_pose(const Message& message) {
  if (message.size != 64) return false;
  if (read_i32(message.payload) != 0) return true;  // another sensor
  std::array<double, 7> x{};
  for (std::size_t n = 0; n < 7; ++n) x[n] = read_f64(message.payload + 8 + 8 * n);
  const Eigen::Quaterniond rotation(x[6], x[3], x[4], x[5]);
  const bool finite = std::ranges::all_of(x, [](double v) { return std::isfinite(v); });
  if (!finite || std::abs(rotation.norm() - 1) > 0.1) {
    ++not_finite_;
    return true;
  }
  pose_ = {rotation.normalized().toRotationMatrix(), {x[0], x[1], x[2]}};
  ++poses_;
  return true;
}

bool VrpnStream::take_button(const Message& message) {
  if (message.size != 8) return false;
  const std::uint32_t button = read_u32(message.payload);
  if (button < buttons_.size()) buttons_[button] = read_u32(message.payload + 4) != 0;
  return true;
}

bool VrpnStream::take_states(const Message& message) {
  const std::uint32_t count = message.size >= 4 ? read_u32(message.payload) : 0;
  if (message.size < 4 || (message.size - 4) / 4 != count) return false;
  for (std::size_t n = 0; n < buttons_.size() && n < count; ++n)
    buttons_[n] = read_u32(message.payload + 4 + 4 * n) != 0;
  return true;
}

void VrpnWriter::cookie(VrpnBytes& out) const {
  VrpnBytes bytes(kVrpnCookie, 0);
  std::memcpy(bytes.data(), kVrpnCookieText, std::strlen(kVrpnCookieText));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

void VrpnWriter::begin(VrpnBytes& out, std::size_t payload, std::int32_t sender,
                       std::int32_t type) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  write_u32(out, static_cast<std::uint32_t>(kVrpnHeader + payload));
  write_u32(out, static_cast<std::uint32_t>(us / 1000000));
  write_u32(out, static_cast<std::uint32_t>(us % 1000000));
  write_u32(out, static_cast<std::uint32_t>(sender));
  write_u32(out, static_cast<std::uint32_t>(type));
  write_u32(out, sequence_++);
}

void VrpnWriter::name(VrpnBytes& out, std::int32_t type, std::int32_t number,
                      const std::string& text) {
  const std::size_t payload = 4 + text.size() + 1;
  begin(out, payload, number, type);
  write_u32(out, static_cast<std::uint32_t>(text.size() + 1));
  out.insert(out.end(), text.begin(), text.end());
  out.resize(out.size() + 1 + padded(payload) - payload, 0);
}

void VrpnWriter::describe(VrpnBytes& out, const std::string& device, bool forces, bool rates) {
  name(out, -1, kDevice, device);
  if (forces) name(out, -2, force_field, kForceName);
  if (rates) name(out, -2, update_rate, kRateName);
}

void VrpnWriter::request_rate(VrpnBytes& out, double rate) {
  begin(out, 8, kDevice, update_rate);
  const auto bits = std::bit_cast<std::uint64_t>(rate);
  write_u32(out, static_cast<std::uint32_t>(bits >> 32));
  write_u32(out, static_cast<std::uint32_t>(bits));
}

void VrpnWriter::force(VrpnBytes& out, const Vector3& origin, const Vector3& force, double radius) {
  begin(out, 16 * 4, kDevice, force_field);
  for (Eigen::Index n = 0; n < 3; ++n) write_f32(out, origin[n]);
  for (Eigen::Index n = 0; n < 3; ++n) write_f32(out, force[n]);
  for (int n = 0; n < 9; ++n) write_f32(out, 0);  // d force / d position
  write_f32(out, radius);
}

}  // namespace twinarm
