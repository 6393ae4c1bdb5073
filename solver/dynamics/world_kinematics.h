// Kinematics in world axes: points, velocities, classical accelerations, Jacobians, momentum,
// energy. Any scalar.
//
// All functions read a workspace after kinematics() at the same state (X0, Xup, v, c, S_); those of
// accelerations also after aba() or rnea() (a). Points are given in body axes from the body's
// origin; results are in world axes. Spatial quantities are (angular; linear).
#pragma once

#include <vector>

#include "solver/model/workspace.h"

namespace twinarm {

template <class S>
Vec3<S> to_world(const BodyKinematics<S>& w, std::size_t body, const Vec3<S>& a_B) {
  return transpose_times(w.X0[body].E, a_B);
}
template <class S>
Vec3<S> point_position(const BodyKinematics<S>& w, std::size_t body, const Vec3<S>& r_B) {
  return w.X0[body].r + to_world(w, body, r_B);
}
template <class S>
Vec3<S> angular_velocity(const BodyKinematics<S>& w, std::size_t body) {
  return to_world(w, body, w.v[body].w);
}
template <class S>
Vec3<S> point_velocity(const BodyKinematics<S>& w, std::size_t body, const Vec3<S>& r_B) {
  return to_world(w, body, plus_cross(w.v[body].v, w.v[body].w, r_B));
}

// d^2 p/dt^2 of a point, from spatial velocity v and spatial acceleration a of its body (without
// the fictitious -a_g), RBDA section 2.10:  a_v + w x (v + w x r) + alpha x r.
template <class S>
Vec3<S> classical_acceleration(const Motion<S>& v, const Motion<S>& a, const Vec3<S>& r) {
  const Vec3<S> rate = plus_cross(v.v, v.w, r);
  return plus_cross(plus_cross(a.v, v.w, rate), a.w, r);
}
template <class S>
Motion<S> without_gravity(const Model<S>& model, const Workspace<S>& w, std::size_t body) {
  Motion<S> a = w.a[body];
  a.v += w.X0[body].E * model.gravity;
  return a;
}
template <class S>
Vec3<S> point_acceleration(const Model<S>& model, const Workspace<S>& w, std::size_t body,
                           const Vec3<S>& r_B) {
  return to_world(w, body, classical_acceleration(w.v[body], without_gravity(model, w, body), r_B));
}
template <class S>
Vec3<S> angular_acceleration(const Workspace<S>& w, std::size_t body) {
  return to_world(w, body, w.a[body].w);
}

// Columns J[0 .. nv): d(angular velocity of the body; velocity of its point) / d qd.
template <class S>
void jacobian(const Model<S>& model, const BodyKinematics<S>& w, std::size_t body,
              const Vec3<S>& r_B, std::vector<Motion<S>>& J) {
  const Vec3<S> p = point_position(w, body, r_B);
  for (Motion<S>& column : J) column = {};
  for (std::size_t i = body; i > 0; i = static_cast<std::size_t>(model.parent[i]))
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + model.dofs(i); ++dof) {
      const Vec3<S> angular = to_world(w, i, w.S_[dof].w), linear = to_world(w, i, w.S_[dof].v);
      J[dof] = {angular, plus_cross(linear, angular, p - w.X0[i].r)};
    }
}

// ---- the whole mechanism ----

template <class S>
struct MassAndCom {
  S mass{};
  Vec3<S> com;  // world axes [m]; zero if the total mass is zero
};
template <class S>
MassAndCom<S> mass_and_com(const Model<S>& model, const BodyKinematics<S>& w) {
  MassAndCom<S> all;
  Vec3<S> first_moment;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    all.mass = all.mass + model.I[i].m;
    first_moment += model.I[i].m * w.X0[i].r + to_world(w, i, model.I[i].h);
  }
  if (is_nonzero(all.mass)) all.com = (S(1) / all.mass) * first_moment;
  return all;
}
// (angular momentum about the world's origin; linear momentum), without rotors (armature): the
// model does not contain their axes.
template <class S>
Force<S> momentum(const Model<S>& model, const BodyKinematics<S>& w) {
  Force<S> sum;
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    sum += transpose_times(w.X0[i], model.I[i] * w.v[i]);
  return sum;
}
// Kinetic energy of bodies and rotors [J].
template <class S>
S kinetic_energy(const Model<S>& model, const State<S>& x, const BodyKinematics<S>& w) {
  S twice(0);
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    twice = twice + dot(w.v[i], model.I[i] * w.v[i]);
  for (std::size_t k = 0; k < model.nv; ++k) twice = twice + model.armature[k] * x.qd[k] * x.qd[k];
  return S(0.5) * twice;
}
// Potential energy of gravity, 0 at the world's origin [J].
template <class S>
S potential_energy(const Model<S>& model, const BodyKinematics<S>& w) {
  S sum(0);
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    sum = sum - dot(model.gravity, model.I[i].m * w.X0[i].r + to_world(w, i, model.I[i].h));
  return sum;
}

}  // namespace twinarm
