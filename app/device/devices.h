// Input devices by name, as of `--device`. A file NAME_kind.cpp of this folder defines
// `DeviceKind NAME_kind()` (docs/develop/extending.md).
#pragma once

#include <charconv>
#include <filesystem>
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
  int place = 0;               // order in the list
  std::string name, argument;  // "vrpn" and ":NAME@HOST[:PORT]"; [..] is optional
  std::string help;            // one line
  // Takes the text after name and colon. Throws InputError: no answer.
  std::function<std::unique_ptr<InputDevice>(const std::string&, const VirtualOmniSettings&)> open;
  bool has_motors = false;
  bool stays_inside = false;  // it opens no file, device or socket
};
const std::vector<DeviceKind>& device_kinds();  // by `place`

// Motions of the virtual device, as in virtual:NAME.
struct ScriptedMotion {
  std::string name, argument, help;
  bool stays_inside = false;
  std::function<std::shared_ptr<const OperatorMotion>(const std::string&)>
      make;  // takes the argument
};
const std::vector<ScriptedMotion>& scripted_motions();

// Output of `--device list`: kinds, then motions.
std::string device_list();

// "virtual", "virtual:MOTION", "keyboard", "gamepad:/dev/input/js1", "vrpn:Phantom0@lab:3883"...
// `settings`: of the virtual Omni, which keyboard, gamepad and space mouse move too. Throws
// InputError: unknown name, or no answer.
std::unique_ptr<InputDevice> open_device(const std::string& spec,
                                         const VirtualOmniSettings& settings = {});

// Whether it opens no file, device or socket of this machine, so that remote clients may request
// it. Throws InputError: unknown name.
bool stays_inside(const std::string& spec);

// A log or a trace; prints the warnings of a trace. Throws InputError.
std::unique_ptr<OperatorMotion> recorded_motion(const std::filesystem::path& file);

// "paper", "synthetic:7", "trace:hand.csv". Throws InputError.
std::shared_ptr<const OperatorMotion> scripted_motion(const std::string& spec);

[[noreturn]] inline void refuse_spec(const std::string& spec, const std::string& problem,
                                     const std::string& fix) {
  throw InputError("--device " + spec, problem, fix, "device.spec");
}

template <class Number>
std::optional<Number> whole_number(const std::string& text) {
  Number value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace twinarm
