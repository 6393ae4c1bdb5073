#include "coupling/device/device_mapping.h"

#include <algorithm>
#include <cmath>

#include "coupling/device/inverse_kinematics.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

bool is_engaged(const DeviceState& device) {
  bool finite = device.stylus.p.allFinite();
  for (const double angle : device.theta) finite = finite && std::isfinite(angle);
  return device.alive && finite && !device.buttons[1];
}

// Common part of all mappings: target, gripper, clutch.
class ClutchedMapping : public DeviceMapping {
 public:
  explicit ClutchedMapping(const MappedRobot& robot) {
    for (const int body : robot.turned) {
      const std::size_t iq = robot.model->iq[static_cast<std::size_t>(body)];
      target_.q.push_back(robot.rest.q.empty() ? 0.0 : robot.rest.q[iq]);
    }
    target_.qd.assign(target_.q.size(), 0.0);
    before_ = target_.q;
  }

  void begin(const DeviceState& device, const std::vector<double>& q) noexcept override {
    for (std::size_t j = 0; j < target_.q.size(); ++j) target_.q[j] = q[j];
    std::fill(target_.qd.begin(), target_.qd.end(), 0.0);
    placed_ = true;
    engaged_ = is_engaged(device);
    if (engaged_) engage(device);
  }

  const MappedTarget& map(const DeviceState& device, double h) noexcept override {
    std::fill(target_.qd.begin(), target_.qd.end(), 0.0);
    if (device.alive) target_.gripper_closed = device.buttons[0];
    if (!is_engaged(device)) {
      placed_ = true;
      engaged_ = false;
      return target_;
    }
    const bool was_engaged = engaged_;
    if (!engaged_ && placed_) engage(device);
    if (!engaged_ && !placed_) engage_first(device);
    engaged_ = placed_ = true;
    before_ = target_.q;
    follow(device, h);
    for (std::size_t j = 0; was_engaged && h > 0 && j < before_.size(); ++j)
      target_.qd[j] = (target_.q[j] - before_[j]) / h;
    return target_;
  }

 protected:
  virtual void engage(const DeviceState& device) = 0;        // without a jump of target_.q
  virtual void engage_first(const DeviceState& device) = 0;  // no initial target given
  virtual void follow(const DeviceState& device, double h) = 0;

  MappedTarget target_;
  bool engaged_ = false;

 private:
  std::vector<double> before_;
  bool placed_ = false;
};

class JointMapping final : public ClutchedMapping {
 public:
  JointMapping(const MappingSpec& spec, const MappedRobot& robot)
      : ClutchedMapping(robot), spec_(spec), lower_(robot.lower), upper_(robot.upper) {
    if (spec.kind == MappingKind::arm) spec_.device_joint = {0, 1, 2};
  }

  DeviceForce motor_torques(const DeviceState&, const std::vector<double>& tau) noexcept override {
    DeviceForce force;
    for (std::size_t j = 0; engaged_ && j < target_.q.size(); ++j)
      if (spec_.device_joint[j] < 3 && follows_[j])
        force.torque[spec_.device_joint[j]] = spec_.force_scale * spec_.gain[j] * tau[j];
    return force;
  }
  std::string force_feedback_description() const override {
    return spec_.kind == MappingKind::paper
               ? "torque of joint 1 only: theta4 and theta6 (joints 2 and 3) have no motors"
               : "torques of joints 1, 2 and 3, by the motors of theta1, theta2 and theta3";
  }

 private:
  void engage(const DeviceState& device) override {
    for (std::size_t j = 0; j < target_.q.size(); ++j)
      spec_.offset[j] = target_.q[j] - spec_.gain[j] * device.theta[spec_.device_joint[j]];
  }
  void engage_first(const DeviceState&) override {}
  void follow(const DeviceState& device, double) override {
    for (std::size_t j = 0; j < target_.q.size(); ++j) {
      const double q = spec_.offset[j] + spec_.gain[j] * device.theta[spec_.device_joint[j]];
      target_.q[j] = q;
      if (!lower_.empty()) target_.q[j] = std::max(target_.q[j], lower_[j]);
      if (!upper_.empty()) target_.q[j] = std::min(target_.q[j], upper_[j]);
      follows_[j] = target_.q[j] == q;
    }
  }

  MappingSpec spec_;               // with the offsets of the last engage()
  std::array<bool, 3> follows_{};  // false: at a joint limit
  std::vector<double> lower_, upper_;
};

class CartesianMapping final : public ClutchedMapping {
 public:
  CartesianMapping(const MappingSpec& spec, const OmniParameters& omni, const MappedRobot& robot)
      : ClutchedMapping(robot), spec_(spec), omni_(omni), inverse_(robot) {}

  // dgoal = scale R J_O dtheta, tau . dq = f . dgoal, so torque = J_O^T R^T scale f.
  DeviceForce motor_torques(const DeviceState& device,
                            const std::vector<double>& tau) noexcept override {
    DeviceForce force;
    if (!engaged_ || !is_engaged(device)) return force;
    const Vector3 f = spec_.force_scale * spec_.scale * inverse_.force_of(tau);
    const Vector3 torque = omni_jacobian(omni_, device.theta).transpose() * device_from_world(f);
    force.torque = {torque.x(), torque.y(), torque.z()};
    return force;
  }
  std::optional<Vector3> stylus_for(const Vector3& goal_W) const noexcept override {
    return Vector3(stylus_start_ + device_from_world((goal_W - start_) / spec_.scale));
  }
  std::string force_feedback_description() const override {
    return "force on the robot's point that follows the stylus, in the directions in which its "
           "driven joints can move it; no torques";
  }

 private:
  void engage(const DeviceState& device) override {
    inverse_.set_pose(target_.q);
    start_ = inverse_.position();
    stylus_start_ = device.stylus.p;
  }
  void engage_first(const DeviceState& device) override { engage(device); }
  void follow(const DeviceState& device, double h) override {
    const Vector3 moved = world_from_device(device.stylus.p - stylus_start_);
    inverse_.move_towards(start_ + spec_.scale * moved, spec_.fastest * h);
    target_.q = inverse_.q();
  }

  MappingSpec spec_;
  OmniParameters omni_;
  PointInverseKinematics inverse_;
  Vector3 start_ = Vector3::Zero(), stylus_start_ = Vector3::Zero();
};

void check_number(const std::string& what, double value, bool positive, DiagnosticList& faults) {
  if (std::isfinite(value) && (!positive || value > 0)) return;
  faults.add("mapping, " + what,
             "it is " + short_number_text(value) + ", must be a " + (positive ? "positive " : "") +
                 "number",
             "give a " + std::string(positive ? "positive " : "") + "number", "mapping.number");
}

void check_spec(const MappingSpec& spec, DiagnosticList& faults) {
  for (std::size_t j = 0; j < 3; ++j) {
    check_number("gain of joint " + std::to_string(j + 1), spec.gain[j], false, faults);
    check_number("offset of joint " + std::to_string(j + 1), spec.offset[j], false, faults);
  }
  check_number("scale", spec.scale, true, faults);
  check_number("fastest", spec.fastest, true, faults);
  check_number("force_scale", spec.force_scale, false, faults);
}

bool moves(const Model<double>& model, const std::vector<int>& turned, int body) {
  for (int b = body; b > 0; b = model.parent[static_cast<std::size_t>(b)])
    if (std::find(turned.begin(), turned.end(), b) != turned.end()) return true;
  return false;
}

void check_robot(MappingKind kind, const MappedRobot& robot, DiagnosticList& faults) {
  const Model<double>& model = *robot.model;
  const bool in_joints = kind != MappingKind::cartesian;
  if (robot.turned.empty() || (in_joints && robot.turned.size() > 3))
    faults.add("mapping", std::to_string(robot.turned.size()) + " driven joints are given",
               in_joints ? "give one to three joints" : "give at least one joint",
               "mapping.joints");
  for (const int body : robot.turned) {
    if (body <= 0 || body >= model.body_count())
      faults.add("mapping", "body index " + std::to_string(body) + " does not exist",
                 "give joints of the robot", "mapping.body");
    else if (model.dofs(static_cast<std::size_t>(body)) != 1)
      faults.add("joint '" + model.joint_name[static_cast<std::size_t>(body)] + "'",
                 "a driven joint must have one degree of freedom",
                 "give revolute or prismatic joints", "mapping.degrees-of-freedom");
  }
  for (const auto* range : {&robot.lower, &robot.upper})
    if (!range->empty() && range->size() != robot.turned.size())
      faults.add("mapping", "the numbers of ranges and joints differ", "give one range per joint",
                 "mapping.ranges");
  if (!in_joints && !moves(model, robot.turned, robot.body))
    faults.add("mapping",
               "no driven joint moves body " + std::to_string(robot.body) +
                   ", whose point follows the stylus",
               "give a point on a descendant of a driven joint", "mapping.point");
}

}  // namespace

std::unique_ptr<DeviceMapping> make_mapping(const MappingSpec& spec, const OmniParameters& omni,
                                            const MappedRobot& robot) {
  DiagnosticList faults;
  check_spec(spec, faults);
  check_robot(spec.kind, robot, faults);
  faults.check();
  if (spec.kind == MappingKind::cartesian)
    return std::make_unique<CartesianMapping>(spec, omni, robot);
  return std::make_unique<JointMapping>(spec, robot);
}

}  // namespace twinarm
