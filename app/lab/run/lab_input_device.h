// Who moves the kinematic robot of a scene, and the device in the hand: it outlives the runs that
// it moves. All calls come from the thread that steps.
//
//   scene    the scene's own targets, with the bits of `twinarm simulate`
//   drag     a virtual Omni whose stylus is dragged, through a mapping; its force comes back
//   joints   driven joint by joint, no faster than kFastest
//   device   any hand device (app/device/devices.h), likewise through a mapping
//
// The robot never jumps: whoever begins to move it goes on from where it stands.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/device/desktop_input.h"
#include "coupling/device/device_mapping.h"
#include "coupling/device/force_feedback.h"
#include "coupling/device/input_device.h"

namespace twinarm {

class LabHand {
 public:
  enum class Source { scene, drag, joints, device };
  static constexpr double kFastest = 3;  // of joints that go to where they are told [rad/s, m/s]

  LabHand();
  // Throws InputError: a device that is not known, or not there. `spec` only of Source::device.
  void choose(Source source, const std::string& spec = "");

  Source source() const { return source_; }
  const MappingSpec& mapping() const { return mapping_; }
  const HandForceSpec& force() const { return force_; }
  // Null where the source has none.
  HandDevice* device() const { return device_.get(); }
  std::string description() const;
  const std::string& spec() const { return spec_; }  // of the device that was chosen

  // What a user does. `stamp` comes back in frames.
  void tip(const Vector3& goal_W, double stamp);  // where the led point is to go
  void joint(std::size_t driven, double value, double stamp);
  void turn(double yaw, double pitch, double roll, double stamp);  // the stylus, by [rad]
  void axes(const std::array<double, 6>& rates, double stamp);     // as GestureHand::axes
  void button(std::size_t index, bool down, double stamp);         // 0: gripper, 1: clutch
  // Keys, axes and the clutch; the robot stays where it is, the gripper as it is.
  void release();

  // For the run. Counts up with each choice: what was made of the old one is made anew.
  unsigned long chosen() const { return chosen_; }
  double stamp() const { return stamp_; }
  void set_stamp(double stamp) { stamp_ = stamp; }
  GestureHand* gestures() const { return gestures_.get(); }
  const std::optional<Vector3>& tip_goal() const { return tip_; }
  // By driven joint; no value: it stays.
  const std::vector<std::optional<double>>& joint_goals() const { return joints_; }
  bool gripper_closed() const { return gripper_; }
  double tick(double h) { return clock_ += h; }  // the device's time, which never goes back

 private:
  Source source_ = Source::scene;
  std::string spec_;
  MappingSpec mapping_;
  HandForceSpec force_;
  std::shared_ptr<GestureHand> gestures_;
  std::unique_ptr<HandDevice> device_;
  std::optional<Vector3> tip_;
  std::vector<std::optional<double>> joints_;
  bool gripper_ = false;
  double stamp_ = 0, clock_ = 0;
  unsigned long chosen_ = 0;
};

}  // namespace twinarm
