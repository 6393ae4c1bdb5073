#include "solver/model.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "solver/fault.h"

namespace twinarm {
namespace {

Vec3<double> to_vec3(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
Mat3<double> to_mat3(const Matrix3& R) {
  return {to_vec3(R.row(0)), to_vec3(R.row(1)), to_vec3(R.row(2))};
}
// Pluecker transform of the coordinates in A into those in B, from the pose of B in A.
Transform<double> to_transform(const Pose& X_AB) {
  return {to_mat3(X_AB.R.transpose()), to_vec3(X_AB.p)};
}

// R_LB: the shortest turn that takes z to the axis, exactly the identity for an axis along +z.
Matrix3 turn_z_to(const Vector3& axis) {
  if (axis.x() == 0 && axis.y() == 0 && axis.z() > 0) return Matrix3::Identity();
  return Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
}

bool has_axis(JointType type) {
  return type == JointType::revolute || type == JointType::prismatic;
}

void check_inertia(const std::string& where, const BodyInertia& body, JointType type,
                   FaultList& faults) {
  if (!std::isfinite(body.mass) || !body.com.allFinite() || !body.inertia.allFinite()) {
    faults.add({"", 0, where, "mass, centre of mass or inertia is not a finite number", ""});
    return;
  }
  if (type == JointType::fixed && body.mass == 0 && body.inertia.isZero(0)) return;
  if (body.mass <= 0)
    faults.add({"", 0, where, "mass is " + std::to_string(body.mass) + " kg, must be positive",
                "give the link its mass"});
  const Vector3 A = Eigen::SelfAdjointEigenSolver<Matrix3>(body.inertia).eigenvalues();
  if (A(0) < 0 || A(2) > (A(0) + A(1)) * (1 + 1e-9))
    faults.add({"", 0, where,
                "inertia is not that of a body: its principal moments must be positive, and the "
                "largest at most the sum of the other two",
                "check the signs and the unit (kg m^2) of the inertia about the centre of mass"});
}

Inertia<double> about_origin(const BodyInertia& body, const Matrix3& R_BL) {
  const Vector3 c = R_BL * body.com;
  const Matrix3 I = R_BL * body.inertia * R_BL.transpose() +
                    body.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  return {body.mass, to_vec3(body.mass * c), symmetric_part_of(to_mat3(I))};
}

}  // namespace

int ModelBuilder::add_body(const std::string& body_name, int parent, const std::string& joint_name,
                           JointType type, const Pose& X_PJ, const Vector3& axis,
                           const BodyInertia& inertia) {
  bodies_.push_back({body_name, joint_name, parent, type, X_PJ, axis, inertia});
  return static_cast<int>(bodies_.size());
}

Model<double> ModelBuilder::build() const {
  FaultList faults;
  Model<double> model;
  model.gravity = to_vec3(gravity_);
  model.body_name = {"world"};
  model.joint_name = {""};
  model.parent = {-1};
  model.joint = {JointType::fixed};
  model.iq = model.iv = {0};
  model.Xtree.resize(1);
  model.I.resize(1);
  model.turn = {Mat3<double>::identity()};
  std::vector<Matrix3> R_LB = {Matrix3::Identity()};

  for (const Body& body : bodies_) {
    const std::string where = "link '" + body.name + "'";
    const int i = model.body_count();
    if (body.parent < 0 || body.parent >= i)
      faults.add({"", 0, where, "its parent is not a body that was added before it", ""});
    if (model.find_body(body.name) >= 0)
      faults.add({"", 0, where, "the name is taken already", "give each link its own name"});
    if (model.find_joint(body.joint_name) >= 0)
      faults.add({"", 0, "joint '" + body.joint_name + "'", "the name is taken already",
                  "give each joint its own name"});
    if (has_axis(body.type) && !(body.axis.norm() > 0 && body.axis.allFinite()))
      faults.add({"", 0, "joint '" + body.joint_name + "'", "its axis has no direction",
                  "give an axis that is not zero"});
    check_inertia(where, body.inertia, body.type, faults);
    if (!faults.empty()) {  // keep the indices right, so that the other bodies are checked too
      R_LB.push_back(Matrix3::Identity());
    } else {
      R_LB.push_back(has_axis(body.type) ? turn_z_to(body.axis) : Matrix3::Identity());
    }
    const Matrix3& R_PlPb = R_LB[static_cast<std::size_t>(faults.empty() ? body.parent : 0)];
    const Pose X_PbPl{R_PlPb.transpose(), Vector3::Zero()};
    const Pose X_LB{R_LB.back(), Vector3::Zero()};

    model.body_name.push_back(body.name);
    model.joint_name.push_back(body.joint_name);
    model.parent.push_back(body.parent);
    model.joint.push_back(body.type);
    model.iq.push_back(model.nq);
    model.iv.push_back(model.nv);
    model.Xtree.push_back(to_transform(X_PbPl * body.X_PJ * X_LB));
    model.I.push_back(about_origin(body.inertia, R_LB.back().transpose()));
    model.turn.push_back(to_mat3(R_LB.back().transpose()));
    visit_joint<double>(body.type, [&](auto joint) {
      model.nq += joint.nq;
      model.nv += joint.nv;
    });
  }
  faults.check();
  return model;
}

}  // namespace twinarm
