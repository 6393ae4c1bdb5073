// How free bodies turn in a step of fixed size (constrained_step.h).
//
// About its centre of mass a free body turns by I w' + w x I w = n. With the moment w x I w of its
// start a step of first order adds h^2 |w x I w|^2 / 2 (in the norm of I^-1) to the energy: of a
// body that spins fast the nutation, of rate W, grows by h^2 W^2 / 2 in each step, without bound.
// With the moment of the mean velocity,
//   I (w' - w) + h m x I m = h n,      m = (w + w') / 2,
// no energy comes of it, and |I w| stays where n = 0: it turns I w, and does no more. w' is the
// velocity without impulses. Newton's method finds it; what the moment differs by enters the step
// as a couple, so that contacts and the step's last ABA have it.
//
// For bodies that are a tree of their own, without implicit terms of couplings.
#include <algorithm>

#include "solver/dynamics/dynamics.h"
#include "solver/stepping/constrained_step.h"

namespace twinarm {
namespace {

// A turn in one step that is left alone [rad]: its nutation grows e-fold in 1e12 steps.
constexpr double least_turn = 1e-6;
constexpr int most_newton_steps = 10;

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

// w' - w of the equation above.
Vector3 turn_freely(const Matrix3& I, const Vector3& w, const Vector3& n, double h) {
  Vector3 change = Vector3::Zero();
  for (int k = 0; k < most_newton_steps; ++k) {
    const Vector3 mean = w + 0.5 * change, L = I * mean;
    const Vector3 left = I * change + h * (mean.cross(L) - n);
    const Matrix3 slope = I + 0.5 * h * (cross_matrix(mean) * I - cross_matrix(L));
    const Vector3 step = slope.inverse() * left;
    change -= step;
    if (!(step.norm() > 1e-15 * w.norm())) break;
  }
  return change;
}

}  // namespace

bool ConstrainedStep::turns_alone(const Forces<double>& forces, std::size_t i) const {
  if (model_->joint[i] != JointType::free || model_->parent[i] != 0 || model_->last_child[i] != 0)
    return false;
  if (!forces.has_impedance) return true;
  const ArticulatedInertia<double>& implicit = forces.impedance[i];
  return !(implicit.I.xx + implicit.I.yy + implicit.I.zz + implicit.M.xx > 0);
}

// After accelerate().
void ConstrainedStep::correct_rotation(Mechanism& m, double h) {
  bool any = false;
  for (std::size_t i = 1; i < model_->parent.size(); ++i) {
    turning_[i] = {};
    if (with_gamma_ || !turns_alone(m.forces, i)) continue;
    const Eigen::Map<const Vector3> w(m.x.qd.data() + model_->iv[i]);
    if (!(h * w.norm() > least_turn)) continue;
    const Matrix3 I = about_centre(model_->I[i]);
    const Vector3 moment = w.cross(I * w);
    const Vector3 n = I * Eigen::Map<const Vector3>(m.w.qdd.data() + model_->iv[i]) + moment;
    const Vector3 mean = w + 0.5 * turn_freely(I, w, n, h);
    turning_[i] = from_eigen(moment - mean.cross(I * mean));
    m.forces.f_ext[i].n += turning_[i];
    any = true;
  }
  if (any) aba(*model_, m.x, m.forces, m.w);
}

}  // namespace twinarm
