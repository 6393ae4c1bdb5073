// Forces at points of links, and the added inertia of implicit spring-dampers.
//
// A spring-damper at a point p of a link, target x_K', v_K' at the END of the step. With
//   v' = J(q) (qd + h qdd)   and   x' = x + h v'
// the force at the end of the step is
//   F = k (x_K' - x') + b (v_K' - v')
//     = k (x_K' - x - h v) + b (v_K' - v)  -  m* J qdd,      m* = h b + h^2 k.
// An implicit spring-damper is therefore an explicit force plus a particle of added mass m* at p,
// whose inertia is added to IA of the link only. ABA multiplies this inertia by the whole
// acceleration a = a_bias + J qdd; its product with a_bias (velocity products, and gravity as
// a_0 = -a_g) is added to f_ext, so that only -m* J qdd remains. No matrix is assembled, ABA stays
// O(n). Without a damper each step divides the energy of one degree of freedom by 1 + k h^2 / m
// (docs/learn/lessons/10_implicit_springs_cost_energy/lesson.md).
//
// A couple on a link's orientation adds m* 1 to the rotational block (flywheel), a couple on a
// joint angle adds m* to Forces::armature.
//
// Points and forces are in world axes.
#pragma once

#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

// Inertia of a particle at r from the body's origin, body axes.
inline Inertia<double> particle_inertia(double mass, const Vec3<double>& r) {
  return {
      mass,
      mass * r,
      {mass * (r.y * r.y + r.z * r.z), mass * (r.x * r.x + r.z * r.z),
       mass * (r.x * r.x + r.y * r.y), -mass * r.x * r.y, -mass * r.x * r.z, -mass * r.y * r.z}};
}

void add_point_force(const Kinematics& k, int body, const Vector3& p_W, const Vector3& f_W,
                     Forces<double>& forces);
void add_couple(const Kinematics& k, int body, const Vector3& n_W, Forces<double>& forces);

// Added mass m* [kg] at p.
void add_particle(const Kinematics& k, int body, const Vector3& p_W, double mass,
                  Forces<double>& forces);
// Added isotropic rotational inertia m* [kg m^2].
void add_flywheel(const Kinematics& k, int body, double inertia, Forces<double>& forces);

}  // namespace twinarm
