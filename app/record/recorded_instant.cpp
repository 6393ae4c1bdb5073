#include "app/record/recorded_instant.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "app/record/recording_reader.h"
#include "app/record/recording_writer.h"
#include "app/robot/dynamics.h"
#include "app/run/run.h"
#include "app/support/streams.h"

namespace twinarm {
bool is_recording(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(8, '\0');
  stream.read(start.data(), 8);
  if (stream && start == std::string(recording_format::kMagic, 8)) return true;
  if (file.extension() == ".twinrec") return true;  // one that is not there is told by its reader
  std::error_code ignored;
  return !std::filesystem::exists(file, ignored) && std::filesystem::exists(part_of(file), ignored);
}

void check_recorded(const RobotOptions& given, FaultList& faults) {
  if (given.state.empty() && given.gravity.empty() && !given.floating && given.friction &&
      given.armature && !given.strict)
    return;
  faults.add({"", 0, "--state, --gravity, --floating, --no-friction, --no-armature, --strict",
              "a recording has its own state and model", "leave them out; choose by --at",
              "option.conflict"});
}

RecordedInstant open_instant(const std::filesystem::path& file, std::optional<double> at) {
  const Recording recording(file);
  for (const std::string& note : recording.notes()) say("twinarm: {}\n", note);
  const RecordedFrame frame =
      recording.frame(at ? recording.at(*at, "--at") : recording.size() - 1);
  const auto files = std::make_shared<const UnpackedRun>(recording.header());
  SimulateOptions options = files->options();
  options.integrator = "semi-implicit";
  options.step = recording.header().step;
  options.tolerance.reset();
  auto prepared = [&] {
    try {
      return prepare_simulation(options);
    } catch (const InputError& error) {
      throw files->as_typed(error);
    }
  }();
  prepared.run.integrator =
      find_integrator(recording.header().integrator).value_or(Integrator::semi_implicit);
  RecordedInstant instant{std::move(prepared), simulation_memory(frame.memory), frame.t, {}, files};
  for (std::size_t i = 0; i < frame.rows.size(); ++i)
    instant.ledger.push_back(
        {LedgerKind::earlier, recording.rows()[frame.rows[i]], frame.works[i]});
  Memory memory = instant.memory;
  State<double> x(instant.prepared.input.robot.model);
  memory.visit(x.q);
  memory.visit(x.qd);
  memory.visit(x.t);
  stand_at(instant.prepared.input.robot, x);
  return instant;
}

}  // namespace twinarm
