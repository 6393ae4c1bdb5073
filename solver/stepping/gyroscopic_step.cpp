#include "solver/stepping/gyroscopic_step.h"

#include "solver/dynamics/dynamics.h"

namespace twinarm {
namespace {

// Minimum rotation per step [rad] for a correction; below, the nutation grows e-fold in 1e12 steps.
constexpr double kMinRotation = 1e-6;
constexpr int kMaxNewtonSteps = 10;

Matrix3 cross_matrix(const Vector3& a) {
  Matrix3 A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

Matrix3 about_centre(const Inertia<double>& body) {
  const Sym3<double>& I = body.I;
  Matrix3 about_origin;
  about_origin << I.xx, I.xy, I.xz, I.xy, I.yy, I.yz, I.xz, I.yz, I.zz;
  const Matrix3 H = cross_matrix(to_eigen(body.h));
  return about_origin + H * H / body.m;
}

// w' - w of the implicit equation, by Newton's method.
Vector3 velocity_change(const Matrix3& I, const Vector3& w, const Vector3& n, double h) {
  Vector3 change = Vector3::Zero();
  for (int k = 0; k < kMaxNewtonSteps; ++k) {
    const Vector3 mean = w + 0.5 * change, L = I * mean;
    const Vector3 residual = I * change + h * (mean.cross(L) - n);
    const Matrix3 jacobian = I + 0.5 * h * (cross_matrix(mean) * I - cross_matrix(L));
    const Vector3 step = jacobian.inverse() * residual;
    change -= step;
    if (!(step.norm() > 1e-15 * w.norm())) break;
  }
  return change;
}

bool is_free_rigid_body(const Model<double>& model, const Forces<double>& forces, std::size_t i) {
  if (model.joint[i] != JointType::free || model.parent[i] != 0 || model.last_child[i] != 0)
    return false;
  if (!forces.has_added_inertia) return true;
  const ArticulatedInertia<double>& implicit = forces.added_inertia[i];
  return !(implicit.I.xx + implicit.I.yy + implicit.I.zz + implicit.M.xx > 0);
}

}  // namespace

void GyroscopicCouples::apply(IntegrationState& m, double h) {
  bool any = false;
  for (std::size_t i = 1; i < couple_.size(); ++i) {
    couple_[i] = {};
    if (!is_free_rigid_body(m.model(), m.forces, i)) continue;
    const Eigen::Map<const Vector3> w(m.x.qd.data() + m.model().iv[i]);
    if (!(h * w.norm() > kMinRotation)) continue;
    const Matrix3 I = about_centre(m.model().I[i]);
    const Vector3 moment = w.cross(I * w);
    const Vector3 n = I * Eigen::Map<const Vector3>(m.w.qdd.data() + m.model().iv[i]) + moment;
    const Vector3 mean = w + 0.5 * velocity_change(I, w, n, h);
    couple_[i] = from_eigen(moment - mean.cross(I * mean));
    m.forces.f_ext[i].n += couple_[i];
    any = true;
  }
  if (any) aba(m.model(), m.x, m.forces, m.w);
}

}  // namespace twinarm
