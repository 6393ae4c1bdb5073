#include "app/inspect/inspection.h"

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

bool is_zero(const Force<double>& f) {
  return dot(f.n, f.n) + dot(f.f, f.f) == 0;
}
bool is_zero(const ArticulatedInertia<double>& a) {
  const auto is_zero_sym = [](const Sym3<double>& s) {
    return s.xx == 0 && s.yy == 0 && s.zz == 0 && s.xy == 0 && s.xz == 0 && s.yz == 0;
  };
  return is_zero_sym(a.I) && is_zero_sym(a.M) &&
         dot(a.H.r0, a.H.r0) + dot(a.H.r1, a.H.r1) + dot(a.H.r2, a.H.r2) == 0;
}

Matrix3 link_from_body(const Model<double>& model, std::size_t body) {
  return to_eigen(model.R_BL[body]).transpose();
}

struct QuantityConverter {
  const Inspection& in;
  std::size_t body;
  LinkAxes axes;

  template <class T>
  DisplayedQuantity of(const Quantity& quantity, const std::vector<T>& field) const {
    using By = Quantity::By;
    if constexpr (std::is_same_v<T, double>) {
      if (quantity.by == By::square) return {quantity, kJointFrame, axes.square(field)};
      return {quantity, kJointFrame, axes.joint(field)};
    } else {
      if constexpr (std::is_same_v<T, Motion<double>> || std::is_same_v<T, Force<double>>)
        if (quantity.by == By::velocity) return {quantity, kLinkFrame, axes.columns(field)};
      const bool is_transform = std::is_same_v<T, Transform<double>>;
      return {quantity, is_transform ? kParentToLinkFrame : kLinkFrame, axes.show(field[body])};
    }
  }
};

std::vector<DisplayedQuantity> quantities_of(const Inspection& in, int pass, std::size_t body) {
  const QuantityConverter converter{in, body, LinkAxes(in, body)};
  std::vector<DisplayedQuantity> all;
  const auto take = [&](const Quantity& quantity, const auto& field) {
    const bool is_input = pass == 1 && quantity.pass == 0;
    if (quantity.pass != pass && !is_input) return;
    if (quantity.by != Quantity::By::body && converter.axes.nv() == 0) return;
    DisplayedQuantity shown = converter.of(quantity, field);
    if (is_input && shown.value.isZero(0)) return;
    all.push_back(std::move(shown));
  };
  in.forces.describe(take);
  if (pass == 1) {
    using By = Quantity::By;
    all.push_back({{"I", 1, By::body, "spatial inertia of the body alone", "kg m^2, kg m, kg",
                    "of the model; (2.63)"},
                   kLinkFrame,
                   converter.axes.show(ArticulatedInertia<double>(in.model.I[body]))});
    in.w.describe(take);
    all.push_back({{"p", 1, By::body, "bias force of the body alone", "N m; N",
                    "p = v x* I v - f_ext, table 7.1; (2.32)"},
                   kLinkFrame,
                   converter.axes.show(bias_force(in, body))});
    return all;
  }
  in.w.describe(take);
  // Children of the base pass no inertia on.
  if (in.parent(body) > 0) in.trace.describe(take);
  return all;
}

}  // namespace

Forces<double> sum_of(const Model<double>& model, const std::vector<AppliedForce>& actors) {
  Forces<double> sum(model);
  for (const AppliedForce& actor : actors) {
    for (const AppliedForce::OnBody& on : actor.bodies) {
      sum.f_ext[on.body] += on.f;
      if (!is_zero(on.added_inertia)) sum.add_inertia(on.body, on.added_inertia);
    }
    for (const AppliedForce::OnJoint& on : actor.joints) {
      sum.tau[on.dof] += on.tau;
      sum.armature[on.dof] += on.armature;
    }
  }
  return sum;
}

AppliedForce actor_of(std::string source, const Forces<double>& added) {
  AppliedForce actor{std::move(source), {}, {}};
  for (std::size_t i = 0; i < added.f_ext.size(); ++i)
    if (!is_zero(added.f_ext[i]) || !is_zero(added.added_inertia[i]))
      actor.bodies.push_back({i, added.f_ext[i], added.added_inertia[i]});
  for (std::size_t dof = 0; dof < added.tau.size(); ++dof)
    if (added.tau[dof] != 0 || added.armature[dof] != 0)
      actor.joints.push_back({dof, added.tau[dof], added.armature[dof]});
  return actor;
}

Inspection::Inspection(const Model<double>& model_of, State<double> at,
                       std::vector<AppliedForce> acting, std::vector<LoopClosure> closed)
    : model(model_of),
      x(std::move(at)),
      actors(std::move(acting)),
      loops(std::move(closed)),
      forces(sum_of(model, actors)),
      k(model),
      w(model),
      trace(model.parent.size()) {
  forward_kinematics(model, x, k);
  aba(model, x, forces, w, trace);
}

// p'' = R (a_lin + w x v) + g; w.a is a spatial acceleration with a_0 = -g.
Vector3 Inspection::origin_acceleration(std::size_t body) const {
  const Vec3<double> a_B = classical_acceleration(w.v[body], w.a[body], {});
  return k.R_WB[body] * to_eigen(a_B) + to_eigen(model.gravity);
}

std::vector<std::size_t> Inspection::children(std::size_t i) const {
  std::vector<std::size_t> found;
  for (std::size_t j = i + 1; j < body_count(); ++j)
    if (parent(j) == i) found.push_back(j);
  return found;
}

LinkFrame::LinkFrame(const Model<double>& model, std::size_t body)
    : R_LB_(link_from_body(model, body)),
      R_PB_(link_from_body(model, static_cast<std::size_t>(std::max(model.parent[body], 0)))) {}

Matrix6 LinkFrame::show(const ArticulatedInertia<double>& a) const {
  const auto rotated = [&](const Mat3<double>& block) {
    return Matrix3(R_LB_ * to_eigen(block) * R_LB_.transpose());
  };
  // Rotation rounds; symmetric parts keep equal digits in both triangles.
  const auto symmetric = [](const Matrix3& m) { return Matrix3(0.5 * (m + m.transpose())); };
  Matrix6 shown;
  shown.topLeftCorner<3, 3>() = symmetric(rotated(full(a.I)));
  shown.topRightCorner<3, 3>() = rotated(a.H);
  shown.bottomLeftCorner<3, 3>() = shown.topRightCorner<3, 3>().transpose();
  shown.bottomRightCorner<3, 3>() = symmetric(rotated(full(a.M)));
  return shown;
}
Matrix6 LinkFrame::show(const Transform<double>& Xup) const {
  const Matrix3 E = rotation_from_parent(Xup);
  const Vector3 r = translation_from_parent(Xup);
  const Matrix3 cross =
      (Matrix3() << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0).finished();
  Matrix6 shown = Matrix6::Zero();
  shown.topLeftCorner<3, 3>() = shown.bottomRightCorner<3, 3>() = E;
  shown.bottomLeftCorner<3, 3>() = -E * cross;
  return shown;
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

Force<double> bias_force(const Inspection& in, std::size_t body) {
  return crf(in.w.v[body], in.model.I[body] * in.w.v[body]) - in.forces.f_ext[body];
}

std::string unit_at_joint(const Model<double>& model, std::size_t body, const std::string& unit) {
  const std::size_t end = unit.find("; ");
  if (model.dofs(body) != 1 || end == std::string::npos) return unit;
  return is_translational(model.joint[body]) ? unit.substr(end + 2) : unit.substr(0, end);
}

std::vector<DisplayedQuantity> shown_quantities(const Inspection& in, int pass, std::size_t body) {
  std::vector<DisplayedQuantity> all = quantities_of(in, pass, body);
  for (DisplayedQuantity& shown : all)
    shown.unit = shown.quantity.by == Quantity::By::body
                     ? shown.quantity.unit
                     : unit_at_joint(in.model, body, shown.quantity.unit);
  return all;
}

void ConstraintUnknowns::mark(std::vector<AppliedForce>& actors) const {
  constexpr double kTolerance = 1e-6;
  Eigen::Index count = 0;
  for (const Unknowns& of : all_) count += of.by_velocity.cols();
  if (count == 0 || count > kMax) return;
  Eigen::MatrixXd A(all_.front().by_velocity.rows(), count);
  Eigen::Index column = 0;
  for (const Unknowns& of : all_) {
    A.middleCols(column, of.by_velocity.cols()) = of.by_velocity;
    column += of.by_velocity.cols();
  }
  const Eigen::VectorXd part = undetermined_part(A, 1e-9);
  column = 0;
  for (const Unknowns& of : all_) {
    const auto own = part.segment(column, of.by_velocity.cols());
    if (of.actor && (own.array() > kTolerance).any()) actors[*of.actor].is_unique = false;
    column += of.by_velocity.cols();
  }
}

}  // namespace twinarm
