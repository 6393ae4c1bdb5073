#include "app/inspect/displayed_quantities.h"

#include <algorithm>

namespace twinarm {
namespace {

Matrix3 link_from_body(const Model<double>& model, std::size_t body) {
  return to_eigen(model.turn[body]).transpose();
}

// Converts whatever a field holds.
struct Shower {
  const Inspection& in;
  std::size_t body;
  LinkAxes axes;

  template <class T>
  Shown of(const Quantity& quantity, const std::vector<T>& field) const {
    switch (quantity.by) {
      case Quantity::By::velocity:
        return by_velocity(quantity, field);
      case Quantity::By::square:
        if constexpr (std::is_same_v<T, double>) return {quantity, kJointFrame, axes.square(field)};
        [[fallthrough]];
      case Quantity::By::body:
        break;
    }
    if constexpr (std::is_same_v<T, double>)
      return {quantity, kJointFrame, axes.joint(field)};
    else
      return {quantity, std::is_same_v<T, Transform<double>> ? kParentToLinkFrame : kLinkFrame,
              axes.show(field[body])};
  }
  template <class T>
  Shown by_velocity(const Quantity& quantity, const std::vector<T>& field) const {
    if constexpr (std::is_same_v<T, double>)
      return {quantity, kJointFrame, axes.joint(field)};
    else if constexpr (std::is_same_v<T, Motion<double>> || std::is_same_v<T, Force<double>>)
      return {quantity, kLinkFrame, axes.columns(field)};
    else
      return {quantity, kLinkFrame, {}};
  }
};

}  // namespace

LinkFrame::LinkFrame(const Model<double>& model, std::size_t body)
    : R_LB_(link_from_body(model, body)),
      R_PB_(link_from_body(model, static_cast<std::size_t>(std::max(model.parent[body], 0)))) {}

Vector6 LinkFrame::show(const Motion<double>& m) const {
  return (Vector6() << R_LB_ * to_eigen(m.w), R_LB_ * to_eigen(m.v)).finished();
}
Vector6 LinkFrame::show(const Force<double>& f) const {
  return (Vector6() << R_LB_ * to_eigen(f.n), R_LB_ * to_eigen(f.f)).finished();
}
Matrix6 LinkFrame::show(const ArticulatedInertia<double>& a) const {
  const auto turned = [&](const Mat3<double>& block) {
    return Matrix3(R_LB_ * to_eigen(block) * R_LB_.transpose());
  };
  // Turning rounds; both triangles are to show the same digits.
  const auto symmetric = [](const Matrix3& m) { return Matrix3(0.5 * (m + m.transpose())); };
  Matrix6 shown;
  shown.topLeftCorner<3, 3>() = symmetric(turned(full(a.I)));
  shown.topRightCorner<3, 3>() = turned(a.H);
  shown.bottomLeftCorner<3, 3>() = shown.topRightCorner<3, 3>().transpose();
  shown.bottomRightCorner<3, 3>() = symmetric(turned(full(a.M)));
  return shown;
}
Matrix6 LinkFrame::show(const Transform<double>& X) const {
  const Matrix3 E = turn_from_parent(X);
  const Vector3 r = shift_from_parent(X);
  const Matrix3 cross =
      (Matrix3() << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0).finished();
  Matrix6 shown = Matrix6::Zero();
  shown.topLeftCorner<3, 3>() = shown.bottomRightCorner<3, 3>() = E;
  shown.bottomLeftCorner<3, 3>() = -E * cross;
  return shown;
}
Matrix3 LinkFrame::turn_from_parent(const Transform<double>& X) const {
  return R_LB_ * to_eigen(X.E) * R_PB_.transpose();
}
Vector3 LinkFrame::shift_from_parent(const Transform<double>& X) const {
  return R_PB_ * to_eigen(X.r);
}

LinkAxes::LinkAxes(const Inspection& in, std::size_t body)
    : LinkFrame(in.model, body),
      in_(in),
      body_(body),
      iv_(in.model.iv[body]),
      nv_(in.model.dofs(body)) {
  const auto nv = static_cast<Eigen::Index>(nv_);
  T_ = Eigen::MatrixXd::Identity(nv, nv);
  if (in.model.joint[body] == JointType::free) {
    T_.setZero();
    T_.topRightCorner<3, 3>() = to_eigen(quaternion_E(in.x.q.data() + in.model.iq[body] + 3));
    T_.bottomLeftCorner<3, 3>().setIdentity();
  }
}

Eigen::VectorXd LinkAxes::joint(const std::vector<double>& by_velocity) const {
  const Eigen::Map<const Eigen::VectorXd> part(by_velocity.data() + iv_,
                                               static_cast<Eigen::Index>(nv_));
  return T_.transpose() * part;
}
Eigen::MatrixXd LinkAxes::square(const std::vector<double>& D) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto nv = static_cast<Eigen::Index>(nv_);
  return T_.transpose() * Eigen::Map<const RowMajor>(D.data() + in_.w.iD[body_], nv, nv) * T_;
}

Force<double> own_force(const Inspection& in, std::size_t body) {
  return crf(in.w.v[body], in.model.I[body] * in.w.v[body]) - in.forces.f_ext[body];
}

std::vector<Shown> shown_quantities(const Inspection& in, int pass, std::size_t body) {
  const Shower shower{in, body, LinkAxes(in, body)};
  std::vector<Shown> all;
  const auto take = [&](const Quantity& quantity, const auto& field) {
    const bool is_input = pass == 1 && quantity.pass == 0;
    if (quantity.pass != pass && !is_input) return;
    if (quantity.by != Quantity::By::body && shower.axes.nv() == 0) return;
    Shown shown = shower.of(quantity, field);
    if (is_input && shown.value.isZero(0)) return;
    all.push_back(std::move(shown));
  };
  in.forces.describe(take);
  if (pass == 1) {
    using By = Quantity::By;
    all.push_back({{"I", 1, By::body, "spatial inertia of the body alone", "kg m^2, kg m, kg",
                    "of the model; (2.63)"},
                   kLinkFrame,
                   shower.axes.show(ArticulatedInertia<double>(in.model.I[body]))});
    in.w.describe(take);
    all.push_back({{"p", 1, By::body, "bias force of the body alone", "N m; N",
                    "p = v x* I v - f_ext, table 7.1; (2.32)"},
                   kLinkFrame,
                   shower.axes.show(own_force(in, body))});
    return all;
  }
  in.w.describe(take);
  // What the base carries hands nothing on.
  if (in.parent(body) > 0) in.trace.describe(take);
  return all;
}

}  // namespace twinarm
