#include "app/device/devices.h"

#include <fmt/format.h>

#include <charconv>
#include <functional>
#include <optional>

#include "app/device/gesture_device.h"
#include "app/device/vrpn_client.h"
#include "app/support/nearest_name.h"
#include "app/support/streams.h"
#include "coupling/device/device_log.h"
#include "coupling/target/automatic_motion.h"
#include "coupling/target/recorded_trace.h"
#include "coupling/target/scripted_motion.h"
#include "coupling/target/synthetic_operator.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// Of scripted motions: a posture well inside the ranges, and how far they go from it [rad].
constexpr OmniAngles kPosture{0, 0.7, 0.2, 0, 0.6, 0};
constexpr double kScriptTurn = 0.3, kChirpTurn = 0.15;

OmniAngles turned_by(double angle) {
  OmniAngles turned = kPosture;
  for (double& theta : turned) theta += angle;
  return turned;
}

[[noreturn]] void refuse_spec(const std::string& spec, const std::string& rule,
                              const std::string& remedy) {
  throw InputError({{"", 0, "--device " + spec, rule, remedy}});
}

template <class Number>
std::optional<Number> whole_number(const std::string& text) {
  Number value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

// One of a list, with how it is made from the text after its name.
struct HandEntry {
  ScriptedHand hand;
  std::function<std::shared_ptr<const HandSource>(const std::string&)> make;
};
struct DeviceEntry {
  DeviceKind kind;
  std::function<std::unique_ptr<HandDevice>(const std::string&, const VirtualOmniSettings&)> make;
};

std::shared_ptr<const HandSource> synthetic_hand_of(const std::string& seed) {
  const auto number = seed.empty() ? std::optional<unsigned>(1) : whole_number<unsigned>(seed);
  if (!number)
    refuse_spec("synthetic:" + seed, "the seed is no whole number", "give one: synthetic:1");
  return std::make_shared<SyntheticOperator>(*number);
}

const std::vector<HandEntry>& hand_entries() {
  static const std::vector<HandEntry> entries{
      {{"paper", "", "the paper's automatic motion: three sweeps of a second each", true},
       [](const std::string&) { return std::make_shared<AutomaticMotion>(HandMapping{}); }},
      {{"step", "", "rests 1 s, jumps by 0.3 rad in every joint, rests", true},
       [](const std::string&) {
         return std::make_shared<StepHand>(kPosture, turned_by(kScriptTurn), 1.0, 5.0);
       }},
      {{"chirp", "", "0.15 rad in every joint, from 0.1 to 5 Hz in 20 s", true},
       [](const std::string&) {
         OmniAngles amplitude{};
         amplitude.fill(kChirpTurn);
         return std::make_shared<ChirpHand>(kPosture, amplitude, 0.1, 5.0, 20.0);
       }},
      {{"minimum-jerk", "", "rests 1 s, reaches 0.3 rad further in every joint in 1 s", true},
       [](const std::string&) {
         return std::make_shared<ReachHand>(kPosture, turned_by(kScriptTurn), 1.0, 1.0);
       }},
      {{"synthetic", "[:SEED]", "random reaches with tremor; no person", true}, synthetic_hand_of},
      {{"trace", ":FILE", "a recorded hand, from a CSV file"},
       [](const std::string& file) -> std::shared_ptr<const HandSource> {
         if (file.empty()) refuse_spec("trace", "no file is given", "give one: trace:hand.csv");
         if (is_hand_log(file)) return read_hand_log(file);
         auto trace = std::make_shared<RecordedTrace>(file);
         for (const std::string& warning : trace->quality().warnings)
           say("twinarm: warning: {}: {}\n", file, warning);
         return trace;
       }}};
  return entries;
}

VrpnAddress vrpn_address(const std::string& text) {
  const auto at = text.rfind('@');
  const std::string remedy = "give the device's name and its server: vrpn:Phantom0@localhost:3883";
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    refuse_spec("vrpn:" + text, "this is not NAME@HOST[:PORT]", remedy);
  VrpnAddress address{text.substr(0, at), text.substr(at + 1)};
  if (address.device.size() > 99)
    refuse_spec("vrpn:" + text, "the name is longer than VRPN's 99 letters", remedy);
  // A colon parts host and port, unless it is one of an IPv6 address without brackets.
  std::string& host = address.host;
  const auto colon = host.rfind(':');
  const bool bracketed = host.front() == '[' && host.find(']') != std::string::npos;
  if (colon != std::string::npos &&
      (bracketed ? colon > host.find(']') : host.find(':') == colon)) {
    const auto port = whole_number<int>(host.substr(colon + 1));
    if (!port || *port < 1 || *port > 65535)
      refuse_spec("vrpn:" + text, "the port is no number from 1 to 65535", remedy);
    address.port = *port;
    host.resize(colon);
  }
  if (bracketed) host = host.substr(1, host.find(']') - 1);
  if (host.empty()) refuse_spec("vrpn:" + text, "there is no host", remedy);
  return address;
}

const std::vector<DeviceEntry>& device_entries() {
  using Settings = VirtualOmniSettings;
  static const std::vector<DeviceEntry> entries{
      {{"virtual", "[:HAND]", "a Phantom Omni in software, moved by a scripted hand", true, true},
       [](const std::string& hand, const Settings& settings) {
         return std::make_unique<VirtualOmni>(scripted_hand(hand.empty() ? "paper" : hand),
                                              settings);
       }},
      {{"keyboard", "[:TERMINAL]", "a virtual Omni moved by the keys of the terminal", false},
       [](const std::string& path, const Settings& settings) {
         return std::make_unique<GestureDevice>(open_keyboard(path), settings);
       }},
      {{"gamepad", "[:/dev/input/jsN]", "a virtual Omni moved by a game controller", false},
       [](const std::string& path, const Settings& settings) {
         return std::make_unique<GestureDevice>(open_gamepad(path), settings);
       }},
      {{"spacemouse", "[:SOCKET]", "a virtual Omni moved by a space mouse, by spacenavd", false},
       [](const std::string& path, const Settings& settings) {
         return std::make_unique<GestureDevice>(open_space_mouse(path), settings);
       }},
      {{"vrpn", ":NAME@HOST[:PORT]", "a real device behind a VRPN server", true},
       [](const std::string& address, const Settings& settings) {
         return std::make_unique<VrpnDevice>(vrpn_address(address), settings.figures);
       }}};
  return entries;
}

// "name:rest" parted at the first colon.
std::pair<std::string, std::string> parted(const std::string& spec) {
  const auto colon = spec.find(':');
  if (colon == std::string::npos) return {spec, ""};
  return {spec.substr(0, colon), spec.substr(colon + 1)};
}

template <class Entries, class NameOf>
auto& entry_named(const Entries& entries, const NameOf& name_of, const std::string& name,
                  const std::string& kind) {
  std::vector<std::string> names;
  for (const auto& entry : entries) {
    names.push_back(name_of(entry));
    if (names.back() == name) return entry;
  }
  refuse_spec(name, fmt::format("there is no {} of this name", kind),
              name_remedy(name, names, kind + "s"));
}

}  // namespace

const std::vector<DeviceKind>& device_kinds() {
  static const std::vector<DeviceKind> kinds = [] {
    std::vector<DeviceKind> made;
    for (const DeviceEntry& entry : device_entries()) made.push_back(entry.kind);
    return made;
  }();
  return kinds;
}

const std::vector<ScriptedHand>& scripted_hands() {
  static const std::vector<ScriptedHand> hands = [] {
    std::vector<ScriptedHand> made;
    for (const HandEntry& entry : hand_entries()) made.push_back(entry.hand);
    return made;
  }();
  return hands;
}

std::string device_list() {
  std::string text = "devices:\n";
  for (const DeviceKind& kind : device_kinds())
    text += fmt::format("  {:26} {}{}\n", kind.name + kind.argument, kind.help,
                        kind.has_motors ? "; forces can be felt" : "");
  text += "hands of virtual:HAND:\n";
  for (const ScriptedHand& hand : scripted_hands())
    text += fmt::format("  {:26} {}\n", hand.name + hand.argument, hand.help);
  return text;
}

std::shared_ptr<const HandSource> scripted_hand(const std::string& spec) {
  const auto [name, argument] = parted(spec);
  const auto& entry = entry_named(
      hand_entries(), [](const HandEntry& e) { return e.hand.name; }, name, "hand");
  if (entry.hand.argument.empty() && !argument.empty())
    refuse_spec(spec, "this hand takes nothing after its name", "give " + name + " alone");
  return entry.make(argument);
}

bool stays_inside(const std::string& spec) {
  const auto [name, argument] = parted(spec);
  const auto& device = entry_named(
      device_entries(), [](const DeviceEntry& e) { return e.kind.name; }, name, "device");
  if (!device.kind.stays_inside || argument.empty()) return device.kind.stays_inside;
  const auto& entry = entry_named(
      hand_entries(), [](const HandEntry& e) { return e.hand.name; }, parted(argument).first,
      "hand");
  return entry.hand.stays_inside;
}

std::unique_ptr<HandDevice> open_device(const std::string& spec,
                                        const VirtualOmniSettings& settings) {
  const auto [name, argument] = parted(spec);
  const auto& entry = entry_named(
      device_entries(), [](const DeviceEntry& e) { return e.kind.name; }, name, "device");
  return entry.make(argument, settings);
}

}  // namespace twinarm
