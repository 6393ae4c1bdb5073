#include "app/lab/stream/lab_channels.h"

namespace twinarm {

LabChannels::LabChannels(const SimulateInput& input, const RecordingHeader& header,
                         const std::vector<SceneCoupling>& led)
    : channels_(input, header) {
  channels_.add_led_joints(input.robot.coordinates, led);
  pull_ = channels_.add("pull", "N", "pull", "mouse");
  hand_ = channels_.add("hand/force", "N", "hand", "force");
  for (const char* motor : {"1", "2", "3"})
    channels_.add(std::string("hand/torque") + motor, "N m", "hand", "torque");
  time_ = channels_.add("time/step", "s", "time", "step");
  channels_.add("time/longest", "s", "time", "step");
  channels_.add("time/pace", "1", "time", "pace");
}

bool LabChannels::add_pairs(const LabFrame& frame) {
  bool any = false;
  for (const RecordedContact& c : frame.recorded.contacts)
    if (channels_.add_pair(c.a, c.b)) any = true;
  return any;
}

void LabChannels::values(const LabFrame& frame, const Moment& moment, SceneCouplings* couplings,
                         std::vector<double>& values) const {
  channels_.values(frame.recorded, moment, couplings, values);
  if (frame.pull) values[pull_] = frame.pull->force_W.norm();
  if (frame.hand) {
    values[hand_] = frame.hand->force_W.norm();
    for (std::size_t i = 0; i < 3; ++i) values[hand_ + 1 + i] = frame.hand->torque[i];
  }
  values[time_] = frame.step_time;
  values[time_ + 1] = frame.longest_step;
  values[time_ + 2] = frame.pace;
}

}  // namespace twinarm
