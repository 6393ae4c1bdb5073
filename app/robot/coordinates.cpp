#include "app/robot/coordinates.h"

#include <fmt/format.h>

#include "app/support/text.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

bool is_six_dof(const NamedJoint& joint) {
  return joint.type == JointType::free;
}

// R_CP of a joint with six degrees of freedom.
Mat3<double> rotation_of(const NamedJoint& joint, const State<double>& x) {
  return quaternion_E(x.q.data() + joint.iq + 3);
}

std::vector<std::string> moving_joints(const RobotDescription& robot) {
  std::vector<std::string> names;
  for (const JointDescription& joint : robot.joints)
    if (joint.dofs() > 0 && !joint.mimic) names.push_back(joint.name);
  return names;
}

// Warns of an angle that is likely in degrees: beyond two turns, or far beyond the joint's limits.
void check_angle(const std::string& place, const JointDescription& joint, double q,
                 std::vector<std::string>& warnings) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double max = std::max(std::abs(joint.lower), std::abs(joint.upper));
  if (std::abs(q) <= (joint.is_limited() ? std::min(2 * max + 1, 2 * kTurn) : 2 * kTurn)) return;
  warnings.push_back(fmt::format(
      "{}: q of joint '{}' is {:g} rad, {:.1f} turns; angles are in radians: {:g} degrees are "
      "{:.5g}",
      place, joint.name, q, std::abs(q) / kTurn, q, q * kTurn / 360));
}

}  // namespace

// A quaternion's x, y, z are paired with the angular velocity; its w with none.
std::vector<JointComponent> NamedJoint::components() const {
  const JointFacts facts = facts_of(type);
  std::vector<JointComponent> components;
  for (const Coordinate& coordinate : facts.coordinates) {
    const int q = static_cast<int>(components.size());
    const bool is_quaternion = facts.quaternion >= 0 && q >= facts.quaternion;
    const int v = !is_quaternion ? q : q == facts.quaternion ? -1 : q - 1;
    components.push_back({coordinate.label, q, v, coordinate.is_angle, is_quaternion});
  }
  return components;
}

Coordinates::Coordinates(const Model<double>& model, bool floating, int last)
    : floating_(floating) {
  std::size_t row = 0;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(last); ++i) {
    const std::size_t nv = model.dofs(i), iv = model.iv[i];
    const bool is_mimic = std::ranges::any_of(
        model.mimics, [&](const Mimic& m) { return nv == 1 && m.follower == iv; });
    if (nv == 0 || is_mimic) continue;
    const std::size_t nq = facts_of(model.joint[i]).nq;
    all_.push_back({model.joint_name[i], i, model.joint[i], nq, nv, model.iq[i], iv, row});
    row += nv;
  }
  rows_ = static_cast<Eigen::Index>(row);
}

const NamedJoint* Coordinates::find(const std::string& name) const {
  for (std::size_t j = first_joint(); j < all_.size(); ++j)
    if (all_[j].name == name) return &all_[j];
  return nullptr;
}

std::vector<std::string> Coordinates::names() const {
  std::vector<std::string> names;
  for (std::size_t j = first_joint(); j < all_.size(); ++j) names.push_back(all_[j].name);
  return names;
}

Eigen::SparseMatrix<double> Coordinates::P(const Model<double>& model,
                                           const State<double>& x) const {
  Eigen::SparseMatrix<double> P = mimic_projection(model);
  for (const NamedJoint& joint : all_) {
    if (!is_six_dof(joint)) continue;
    std::vector<double> column(model.nv);
    for (std::size_t c = 0; c < 6; ++c) {
      double unit[6] = {};
      unit[c] = 1;
      to_solver(joint, x, unit, column);
      for (std::size_t r = 0; r < 6; ++r)
        P.coeffRef(static_cast<Eigen::Index>(joint.iv + r),
                   static_cast<Eigen::Index>(joint.row + c)) = column[joint.iv + r];
    }
  }
  return P;
}

std::vector<double> coordinates_of(const NamedJoint& joint, const State<double>& x) {
  const auto first = x.q.begin() + static_cast<std::ptrdiff_t>(joint.iq);
  return {first, first + static_cast<std::ptrdiff_t>(joint.nq)};
}

std::vector<double> from_solver(const NamedJoint& joint, const State<double>& x,
                                const std::vector<double>& by_velocity) {
  const double* y = by_velocity.data() + joint.iv;
  if (!is_six_dof(joint)) return {y, y + joint.nv};
  const Vec3<double> w = transpose_times(rotation_of(joint, x), Vec3<double>{y[0], y[1], y[2]});
  return {y[3], y[4], y[5], w.x, w.y, w.z};
}

void to_solver(const NamedJoint& joint, const State<double>& x, const double* values,
               std::vector<double>& by_velocity) {
  double* y = by_velocity.data() + joint.iv;
  if (!is_six_dof(joint)) {
    std::copy_n(values, joint.nv, y);
    return;
  }
  const Vec3<double> w = rotation_of(joint, x) * Vec3<double>{values[3], values[4], values[5]};
  y[0] = w.x, y[1] = w.y, y[2] = w.z;
  std::copy_n(values, 3, y + 3);
}

void normalise(TableReader& table, const std::string& key, std::span<double, 4> q,
               std::vector<std::string>* warnings) {
  constexpr double kRounding = 1e-15, kSilent = 1e-12;
  const auto length = table.unit_length(key, q);
  if (!length) return;
  if (std::abs(*length - 1) > kRounding)
    for (double& c : q) c /= *length;
  if (warnings && std::abs(*length - 1) > kSilent)
    warnings->push_back(fmt::format(
        "{}:{}: {}: the quaternion's length differs from 1 by {:.1e}; it was normalised",
        table.file(), table.find(key)->line, table.where(key), *length - 1));
}

JointValueMap read_joint_values(TableReader& joints, const RobotDescription& robot, JointRows rows,
                                std::vector<std::string>* warnings) {
  JointValueMap found;
  for (const Value& value : joints.value().members) {
    if (joints.is_full()) break;  // each needs a search
    const std::string& name = value.key;
    const auto joint = std::ranges::find(robot.joints, name, &JointDescription::name);
    if (joint == robot.joints.end()) {
      joints.fault(name, "there is no such joint",
                   name_remedy(name, moving_joints(robot), "joints"), "scene.unknown-name");
    } else if (joint->mimic || joint->dofs() == 0) {
      joints.fault(name,
                   joint->mimic ? "it mimics joint '" + joint->mimic->joint + "'"
                                : "it is fixed: it has no coordinate",
                   "leave it out", "scene.no-coordinate");
    } else {
      const bool velocities = rows == JointRows::velocities;
      const std::size_t count = velocities ? joint->facts().nv : joint->facts().nq;
      std::optional<std::vector<double>> numbers;
      if (count > 1)
        numbers = joints.numbers(name, count);
      else if (const auto number = joints.number(name))
        numbers = {*number};
      if (!numbers) continue;
      if (const int first = velocities ? -1 : joint->facts().quaternion; first >= 0)
        normalise(joints, name, std::span<double, 4>(numbers->data() + first, 4), warnings);
      if (warnings && !velocities && joint->joint_type() == JointType::revolute)
        check_angle(fmt::format("{}:{}", joints.file(), value.line), *joint, numbers->front(),
                    *warnings);
      found[name] = {*numbers, value.line};
    }
  }
  return found;
}

}  // namespace twinarm
