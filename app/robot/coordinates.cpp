#include "app/robot/coordinates.h"

#include <algorithm>

#include "solver/model/mimic.h"

namespace twinarm {
namespace {

bool is_six_dof(const NamedJoint& joint) {
  return joint.type == JointType::free;
}

// R_CP of a joint of six degrees of freedom.
Mat3<double> turn_of(const NamedJoint& joint, const State<double>& x) {
  return quaternion_E(x.q.data() + joint.iq + 3);
}

}  // namespace

// In the order of here: what a quaternion leads, its x, y, z have the velocities after it.
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
    const bool follows = std::ranges::any_of(
        model.mimics, [&](const Mimic& m) { return nv == 1 && m.follower == iv; });
    if (nv == 0 || follows) continue;
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

Eigen::MatrixXd Coordinates::P(const Model<double>& model, const State<double>& x) const {
  Eigen::MatrixXd P = mimic_projection(model);
  for (const NamedJoint& joint : all_) {
    if (!is_six_dof(joint)) continue;
    std::vector<double> column(model.nv);
    for (std::size_t c = 0; c < 6; ++c) {
      double unit[6] = {};
      unit[c] = 1;
      to_solver(joint, x, unit, column);
      for (std::size_t r = 0; r < 6; ++r)
        P(static_cast<Eigen::Index>(joint.iv + r), static_cast<Eigen::Index>(joint.row + c)) =
            column[joint.iv + r];
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
  const Vec3<double> w = transpose_times(turn_of(joint, x), Vec3<double>{y[0], y[1], y[2]});
  return {y[3], y[4], y[5], w.x, w.y, w.z};
}

void to_solver(const NamedJoint& joint, const State<double>& x, const double* values,
               std::vector<double>& by_velocity) {
  double* y = by_velocity.data() + joint.iv;
  if (!is_six_dof(joint)) {
    std::copy_n(values, joint.nv, y);
    return;
  }
  const Vec3<double> w = turn_of(joint, x) * Vec3<double>{values[3], values[4], values[5]};
  y[0] = w.x, y[1] = w.y, y[2] = w.z;
  std::copy_n(values, 3, y + 3);
}

}  // namespace twinarm
