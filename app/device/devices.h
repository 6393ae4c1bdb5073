// All hand devices by name: what `--device` takes. A file NAME_kind.cpp of this folder defines
// `DeviceKind NAME_kind()` (docs/develop/extending.md).
#pragma once

#include <charconv>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/device/input_device.h"
#include "coupling/device/virtual_omni.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

struct DeviceKind {
  int place = 0;               // in the list, ascending
  std::string name, argument;  // as in "vrpn" and ":NAME@HOST[:PORT]"; [..] may be left out
  std::string help;            // one line
  // Of the text after name and colon. Throws InputError where it does not answer.
  std::function<std::unique_ptr<HandDevice>(const std::string&, const VirtualOmniSettings&)> open;
  bool has_motors = false;
  bool stays_inside = false;  // it opens no file, device or socket
};
const std::vector<DeviceKind>& device_kinds();
const std::vector<DeviceKind>& device_kinds_of_files();  // not in their order

// The hands that move a virtual device, as in virtual:NAME.
struct ScriptedMotion {
  std::string name, argument, help;
  bool stays_inside = false;
  std::function<std::shared_ptr<const OperatorMotion>(const std::string&)> make;  // of the argument
};
const std::vector<ScriptedMotion>& scripted_hands();

// What `--device list` prints: one line for each kind, then the hands.
std::string device_list();

// "virtual", "virtual:HAND", "keyboard", "gamepad:/dev/input/js1", "vrpn:Phantom0@lab:3883"...
// `settings` are of the virtual Omni that keyboard, gamepad and space mouse move as well. Throws
// one InputError: names that are not known, and devices that do not answer, with what to do.
std::unique_ptr<HandDevice> open_device(const std::string& spec,
                                        const VirtualOmniSettings& settings = {});

// Whether it opens no file, device or socket of this machine: what somebody else may ask for.
// Throws InputError: names that are not known.
bool stays_inside(const std::string& spec);

// The hand alone: "paper", "synthetic:7", "trace:hand.csv". Throws InputError.
std::shared_ptr<const OperatorMotion> scripted_hand(const std::string& spec);

// What these read from the text after a name, and how they refuse it.
[[noreturn]] inline void refuse_spec(const std::string& spec, const std::string& problem,
                                     const std::string& fix) {
  throw InputError({{"", 0, "--device " + spec, problem, fix, "device.spec"}});
}

template <class Number>
std::optional<Number> whole_number(const std::string& text) {
  Number value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace twinarm
