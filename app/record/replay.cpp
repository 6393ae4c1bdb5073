#include "app/record/replay.h"

#include <algorithm>
#include <cmath>

#include "app/record/record_run.h"
#include "app/support/interrupt.h"

namespace twinarm {
namespace {

Replay run_on(const Recording& recording, std::size_t first, const SimulatePlan& prepared) {
  const RecordedFrame begin = recording.frame(first);
  const RecordedFrame last = recording.frame(recording.size() - 1);
  Replay found;
  found.step = begin.step;
  found.from = found.to = begin.t;
  found.first = first;
  found.hash = begin.hash;
  if (prepared.input.scene)
    for (int b = prepared.input.scene->robot_bodies + 1;
         b < prepared.input.robot.model.body_count(); ++b)
      found.bodies.push_back(prepared.input.robot.model.body_name[static_cast<std::size_t>(b)]);
  std::size_t next = first;
  RunWatch watch;
  watch.look = [&](RunView& run) {
    if (next >= recording.size()) return;
    const RecordedFrame recorded = recording.frame(next);
    if (run.step() != recorded.step) return;
    RecordedFrame frame = frame_of(run, prepared);
    found.to = frame.t;
    if (next == first) {
      found.hash_again = frame.hash;
    } else {
      ++found.compared;
      const bool same = frame.hash == recorded.hash && frame.memory == recorded.memory;
      found.equal += same ? 1 : 0;
      if (!same && found.first_different < 0) found.first_different = frame.t;
    }
    frame.memory.clear();
    add_ledgers(run, found.rows, found.momentum_rows, frame);
    found.frames.push_back(std::move(frame));
    ++next;
  };
  watch.tick = [](double) { check_interrupt(); };
  const RunStart start{begin.memory, last.step};
  run_plan(prepared.input, prepared.run, watch, &start);
  return found;
}

}  // namespace

Replay replay(const Recording& recording, std::size_t first, const std::vector<Change>& changes) {
  const UnpackedRun files(recording.header());
  SimulateOptions options = files.options(changes);
  options.energy_bound = HUGE_VAL;  // the recording says where to stop
  try {
    SimulatePlan prepared = prepare_simulation(options);
    prepared.run.times.clear();
    return run_on(recording, first, prepared);
  } catch (const InputError& error) {
    throw files.as_typed(error, changes);
  }
}

}  // namespace twinarm
