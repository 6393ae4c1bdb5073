// External inputs of a run: who moves the target robot, and the mouse spring. OperatorInput
// outlives the runs; only the thread that steps may call it.
//
//   scene    the scene's own targets; same bits as `twinarm simulate`
//   drag     virtual Omni whose stylus is dragged, through a mapping, with force feedback
//   joints   targets joint by joint, at most kMaxJointSpeed
//   device   any input device (app/device/devices.h), through a mapping
//
// Switching the source never makes the target robot jump.
#pragma once

#include "app/lab/run/history.h"
#include "coupling/device/desktop_input.h"
#include "coupling/device/force_feedback.h"

namespace twinarm {

class OperatorInput {
 public:
  enum class Source { scene, drag, joints, device };
  static constexpr std::array<const char*, 4> kSourceNames{"scene", "drag", "joints", "device"};
  static constexpr double kMaxJointSpeed = 3;  // of Source::joints [rad/s, m/s]

  OperatorInput();
  // `spec`: of Source::device. Throws InputError: unknown device, or no answer.
  void choose(Source source, const std::string& spec = "");

  // As after choose() with the same source: a virtual device at rest and without force. A physical
  // one stays as it is. restart() also opens the gripper.
  void renew() {
    if (source_ != Source::device) choose(source_);
  }
  void restart();

  Source source() const { return source_; }
  const MappingSpec& mapping() const { return mapping_; }
  const ForceFeedbackSpec& force() const { return force_; }
  InputDevice* device() const { return device_.get(); }  // null: the source has none
  std::string description() const;
  const std::string& spec() const { return spec_; }

  // Input of a client.
  void tip(const Vector3& goal_W) {  // goal of the driven point
    if (goal_W.allFinite()) tip_ = goal_W;
  }
  void joint(std::size_t driven, double value);
  void rotate_stylus(const Vector3& angles) {  // yaw, pitch, roll [rad]
    if (gestures_) gestures_->rotate_stylus(angles);
  }
  void axes(const std::array<double, 6>& rates);  // as DesktopInput::axes
  void button(std::size_t index, bool down);      // 0: gripper, 1: clutch
  void release();  // keys, axes and clutch; target robot and gripper stay as they are

  unsigned long revision() const { return revision_; }  // counts calls of choose()
  double stamp() const { return stamp_; }               // of the newest input, returned in frames
  void set_stamp(double stamp) { stamp_ = stamp; }
  DesktopInput* gestures() const { return gestures_.get(); }
  const std::optional<Vector3>& tip_goal() const { return tip_; }
  // By driven joint; no value: it stays.
  const std::vector<std::optional<double>>& joint_goals() const { return joints_; }
  bool gripper_closed() const { return gripper_; }
  double tick(double h) { return clock_ += h; }  // time of the device, which never goes back

 private:
  Source source_ = Source::scene;
  std::string spec_;
  MappingSpec mapping_;
  ForceFeedbackSpec force_;
  std::shared_ptr<DesktopInput> gestures_;
  std::unique_ptr<InputDevice> device_;
  std::optional<Vector3> tip_;
  std::vector<std::optional<double>> joints_;
  bool gripper_ = false;
  double stamp_ = 0, clock_ = 0;
  unsigned long revision_ = 0;
};

// Spring-damper from a point of a body to the mouse, with its own rows in energy and momentum
// balance.
//
//   F = k (x_G - x) - b v,   k = m w^2,  b = 2 m w
//
// critically damped for the apparent mass m at the point: m = rank / trace of J M^-1 J^T. The
// spring's force is limited to max_force. In semi-implicit steps it is implicit
// (solver/forces/spring.h), with added mass m* = h b + h^2 k, and stable for any mass; for other
// integrators it is an explicit force.
class MouseSpring final : public OutsideForce {
 public:
  static constexpr double kOmega = 15;        // [rad/s]
  static constexpr double kMaxStretch = 0.3;  // max_force / k [m]

  // The model must outlive it.
  MouseSpring(const Model<double>& model, const RunPlan& plan);

  // Spring at a point of a body (link axes) in the state x. nullopt: no force moves that point.
  std::optional<MouseSpringInput> grab(const State<double>& x, int body, const Vector3& p_L,
                                       const Vector3& goal_W) const;
  void set(const std::optional<MouseSpringInput>& input) { input_ = input; }
  const Vector3& force() const { return mean_force_; }  // on the body, over the last step [N]

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
  void account_implicit(double h, const State<double>& start, const State<double>& end,
                        EnergyMomentum& sum);
  void account_part(double weight, const State<double>& x, EnergyMomentum& sum);

  const Model<double>& model_;
  bool is_implicit_, moves_first_;
  double h_ = 0;
  std::optional<MouseSpringInput> input_;
  Reading reading_, kept_;
  Vector3 mean_force_ = Vector3::Zero();
  std::vector<Given> given_;
  Kinematics k_;
};

}  // namespace twinarm
