#include "app/device/devices.h"

#include <fmt/format.h>

#include "app/support/files.h"
#include "app/support/text.h"
#include "coupling/device/device_motion.h"
#include "coupling/target/recorded_trace.h"
#include "coupling/target/scripted_motion.h"
#include "coupling/target/synthetic_operator.h"

namespace twinarm {
namespace {

// Scripted motions: a posture well inside the joint ranges, and amplitudes about it [rad].
constexpr OmniAngles kPosture{0, 0.7, 0.2, 0, 0.6, 0};
constexpr double kScriptAngle = 0.3, kChirpAngle = 0.15;

OmniAngles posture_plus(double angle) {
  OmniAngles theta = kPosture;
  for (double& angle_of : theta) angle_of += angle;
  return theta;
}

std::shared_ptr<const OperatorMotion> synthetic_motion(const std::string& seed) {
  const auto number = seed.empty() ? std::optional<unsigned>(1) : whole_number<unsigned>(seed);
  if (!number)
    refuse_spec("synthetic:" + seed, "the seed is not a whole number", "give one: synthetic:1");
  return std::make_shared<SyntheticOperator>(*number);
}

// "name:rest" at the first colon.
std::pair<std::string, std::string> split_at_colon(const std::string& spec) {
  const auto colon = spec.find(':');
  if (colon == std::string::npos) return {spec, ""};
  return {spec.substr(0, colon), spec.substr(colon + 1)};
}

template <class Entry>
const Entry& entry_named(const std::vector<Entry>& entries, const std::string& name,
                         const std::string& kind) {
  for (const Entry& entry : entries)
    if (entry.name == name) return entry;
  refuse_spec(name, fmt::format("unknown {}", kind),
              name_remedy(name, names_of(entries), kind + "s"));
}

}  // namespace

const std::vector<ScriptedMotion>& scripted_motions() {
  static const std::vector<ScriptedMotion> motions{
      {"paper", "", "the paper's automatic motion: three sweeps of one second each", true,
       [](const std::string&) { return std::make_shared<AutomaticMotion>(OperatorMapping{}); }},
      {"step", "", "rests 1 s, jumps by 0.3 rad in every joint, rests", true,
       [](const std::string&) {
         return std::make_shared<StepMotion>(kPosture, posture_plus(kScriptAngle), 1.0, 5.0);
       }},
      {"chirp", "", "0.15 rad in every joint, from 0.1 to 5 Hz in 20 s", true,
       [](const std::string&) {
         OmniAngles amplitude{};
         amplitude.fill(kChirpAngle);
         return std::make_shared<ChirpMotion>(kPosture, amplitude, 0.1, 5.0, 20.0);
       }},
      {"minimum-jerk", "", "rests 1 s, reaches 0.3 rad further in every joint in 1 s", true,
       [](const std::string&) {
         return std::make_shared<ReachMotion>(kPosture, posture_plus(kScriptAngle), 1.0, 1.0);
       }},
      {"synthetic", "[:SEED]", "random reaches with tremor", true, synthetic_motion},
      {"trace", ":FILE", "recorded operator motion, from a CSV file", false,
       [](const std::string& file) {
         if (file.empty()) refuse_spec("trace", "the file is missing", "give one: trace:hand.csv");
         return recorded_motion(file);
       }}};
  return motions;
}

std::string device_list() {
  std::string text = "devices:\n";
  for (const DeviceKind& kind : device_kinds())
    text += fmt::format("  {:26} {}{}\n", kind.name + kind.argument, kind.help,
                        kind.has_motors ? "; with force feedback" : "");
  text += "motions of virtual:MOTION:\n";
  for (const ScriptedMotion& motion : scripted_motions())
    text += fmt::format("  {:26} {}\n", motion.name + motion.argument, motion.help);
  return text;
}

std::unique_ptr<OperatorMotion> recorded_motion(const std::filesystem::path& file) {
  std::unique_ptr<OperatorMotion> motion = read_motion_file(file);
  if (const auto* trace = dynamic_cast<const RecordedTrace*>(motion.get()))
    for (const std::string& warning : trace->quality().warnings)
      print_error("twinarm: warning: {}: {}\n", file.string(), warning);
  return motion;
}

std::shared_ptr<const OperatorMotion> scripted_motion(const std::string& spec) {
  const auto [name, argument] = split_at_colon(spec);
  const ScriptedMotion& motion = entry_named(scripted_motions(), name, "motion");
  if (motion.argument.empty() && !argument.empty())
    refuse_spec(spec, "this motion has no argument", "give " + name + " alone");
  return motion.make(argument);
}

bool stays_inside(const std::string& spec) {
  const auto [name, argument] = split_at_colon(spec);
  const DeviceKind& device = entry_named(device_kinds(), name, "device");
  if (!device.stays_inside || argument.empty()) return device.stays_inside;
  return entry_named(scripted_motions(), split_at_colon(argument).first, "motion").stays_inside;
}

std::unique_ptr<InputDevice> open_device(const std::string& spec,
                                         const VirtualOmniSettings& settings) {
  const auto [name, argument] = split_at_colon(spec);
  return entry_named(device_kinds(), name, "device").open(argument, settings);
}

}  // namespace twinarm
