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

#include "app/lab/run/history.h"
#include "app/run/simulate_input.h"
#include "app/scene/forces/reported_forces.h"
#include "coupling/device/desktop_input.h"
#include "coupling/device/device_mapping.h"
#include "coupling/device/force_feedback.h"
#include "coupling/device/input_device.h"
#include "solver/model/model.h"

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
  void axes(const std::array<double, 6>& rates, double stamp);     // as DesktopInput::axes
  void button(std::size_t index, bool down, double stamp);         // 0: gripper, 1: clutch
  // Keys, axes and the clutch; the robot stays where it is, the gripper as it is.
  void release();

  // For the run. Counts up with each choice: what was made of the old one is made anew.
  unsigned long chosen() const { return chosen_; }
  double stamp() const { return stamp_; }
  void set_stamp(double stamp) { stamp_ = stamp; }
  DesktopInput* gestures() const { return gestures_.get(); }
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
  std::shared_ptr<DesktopInput> gestures_;
  std::unique_ptr<HandDevice> device_;
  std::optional<Vector3> tip_;
  std::vector<std::optional<double>> joints_;
  bool gripper_ = false;
  double stamp_ = 0, clock_ = 0;
  unsigned long chosen_ = 0;
};

// A mouse that pulls a body: a spring-damper from a point of the body to a goal in the world, with
// books of its own in the run's ledgers.
//
//   F = k (x_G - x) - b v,   k = m w^2,  b = 2 m w,
// critically damped for the mass m that the body has as felt at the point: m = rank / trace of
// J M^-1 J^T. The spring pulls with `most` at the most: the goal is then as if nearer. In
// semi-implicit steps it is implicit (solver/forces/spring.h), m* = h b + h^2 k, and stable however
// light the body is; with other integrators it is a force like any other.
class MouseSpring final : public OutsideForce {
 public:
  static constexpr double kOmega = 15;            // [rad/s]
  static constexpr double kLongestStretch = 0.3;  // that the spring pulls with [m]

  // The model must outlive it.
  MouseSpring(const Model<double>& model, const RunPlan& plan);

  // A pull at a point of a body (link axes) that stands at x. nullopt: no force can move it.
  std::optional<PullInput> grab(const State<double>& x, int body, const Vector3& p_L,
                                const Vector3& goal_W) const;
  void set(const std::optional<PullInput>& pull) { pull_ = pull; }
  const std::optional<PullInput>& input() const { return pull_; }
  const Vector3& force() const { return shown_; }  // on the body, mean of the last step [N]

  void begin_step(const Kinematics&, double, double h) noexcept override { h_ = h; }
  void add_forces(const State<double>&, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  void keep() override { kept_ = reading_; }
  void restore() noexcept override { reading_ = kept_; }

  std::string name() const override { return "mouse"; }
  void book(double h, std::span<const double> weights, const State<double>& start,
            const std::vector<State<double>>& inner, const State<double>& end) override;
  const std::vector<Given>& given() const override { return given_; }
  void visit_books(StateArchive& memory) override;

 private:
  struct Reading {  // of the last evaluation
    Vector3 force = Vector3::Zero();
    double m_star = 0;
  };
  Reading read(const Kinematics& k) const;
  void book_step(double h, const State<double>& start, const State<double>& end,
                 EnergyMomentum& sum);
  void book_part(double part, const State<double>& x, EnergyMomentum& sum);

  const Model<double>& model_;
  bool is_implicit_, drifts_first_;
  double h_ = 0;
  std::optional<PullInput> pull_;
  Reading reading_, kept_;
  Vector3 shown_ = Vector3::Zero();
  std::vector<Given> given_;
  Kinematics k_;
};

}  // namespace twinarm
