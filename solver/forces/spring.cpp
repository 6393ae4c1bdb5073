#include "solver/forces/spring.h"

namespace twinarm {
namespace {

std::size_t at(int body) {
  return static_cast<std::size_t>(body);
}

Vec3<double> in_body_axes(const Kinematics& k, int body, const Vector3& x_W) {
  return from_eigen(k.R_WB[at(body)].transpose() * x_W);
}
// p_W from the body's origin, body axes.
Vec3<double> arm(const Kinematics& k, int body, const Vector3& p_W) {
  return in_body_axes(k, body, p_W - k.X_WL[at(body)].p);
}
void add_inertia(const Kinematics& k, int body, const ArticulatedInertia<double>& inertia,
                 Forces<double>& forces) {
  forces.add_inertia(at(body), inertia);
  forces.f_ext[at(body)] += inertia * k.a_bias[at(body)];  // cancels inertia * a_bias
}

}  // namespace

void add_point_force(const Kinematics& k, int body, const Vector3& p_W, const Vector3& f_W,
                     Forces<double>& forces) {
  const Vec3<double> f = in_body_axes(k, body, f_W);
  forces.f_ext[at(body)] += Force<double>{cross(arm(k, body, p_W), f), f};
}

void add_couple(const Kinematics& k, int body, const Vector3& n_W, Forces<double>& forces) {
  forces.f_ext[at(body)] += Force<double>{in_body_axes(k, body, n_W), {}};
}

void add_particle(const Kinematics& k, int body, const Vector3& p_W, double mass,
                  Forces<double>& forces) {
  add_inertia(k, body, ArticulatedInertia<double>(particle_inertia(mass, arm(k, body, p_W))),
              forces);
}

void add_flywheel(const Kinematics& k, int body, double inertia, Forces<double>& forces) {
  add_inertia(k, body, {Sym3<double>::scaled_identity(inertia), {}, {}}, forces);
}

}  // namespace twinarm
