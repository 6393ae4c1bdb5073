#include "app/inspect/viewpoint.h"

#include <cmath>
#include <utility>

namespace twinarm {

Matrix3 Viewpoint::R_WV(const Inspection& in, std::size_t body) const {
  switch (axes) {
    case Axes::own:
      return in.k.X_WL[body].R;
    case Axes::body:
      return in.k.X_WL[axes_of].R;
    case Axes::world:
      break;
  }
  return Matrix3::Identity();
}

Vector3 Viewpoint::p_WV(const Inspection& in, std::size_t body) const {
  switch (about) {
    case About::own_com: {
      const Inertia<double>& I = in.model.I[body];
      const Vector3 h = in.k.R_WB[body] * to_eigen(I.h);
      return I.m > 0 ? Vector3(in.k.X_WL[body].p + h / I.m) : in.k.X_WL[body].p;
    }
    case About::body:
      return in.k.X_WL[about_body].p;
    case About::point:
      return point;
    case About::own_origin:
      break;
  }
  return in.k.X_WL[body].p;
}

NamedWrench Viewpoint::see(const Inspection& in, std::size_t body, NamedWrench wrench) const {
  const Vector3 r = p_WV(in, body) - in.k.X_WL[body].p;
  const Matrix3 R_VW = R_WV(in, body).transpose();
  wrench.torque = R_VW * (wrench.torque - r.cross(wrench.force));
  wrench.force = R_VW * wrench.force;
  return wrench;
}

std::vector<NamedForce> named_forces(const Inspection& in, const Viewpoint& from) {
  std::vector<NamedForce> all;
  for (const Actor& actor : in.actors) {
    NamedForce named{actor.source,   {},           {},          actor.point_W,
                     actor.normal_W, std::nullopt, actor.is_tie};
    for (const Actor::OnBody& on : actor.bodies) {
      const Force<double> f = in.force_of(on);
      const Matrix3& R = in.k.R_WB[on.body];
      const Vector3 force = R * to_eigen(f.f);
      if (actor.normal_W) {
        const double normal = actor.normal_W->dot(force);
        named.parts =
            NamedForce::Parts{std::abs(normal), (force - normal * *actor.normal_W).norm()};
      }
      named.ends.push_back({on.body,
                            from.see(in, on.body, {actor.source, force, R * to_eigen(f.n)}),
                            from.p_WV(in, on.body)});
    }
    for (const Actor::OnJoint& on : actor.joints)
      for (std::size_t i = 1; i < in.body_count(); ++i)
        if (on.dof >= in.model.iv[i] && on.dof < in.model.iv[i] + in.model.dofs(i))
          named.joints.push_back({i, on.dof, in.torque_of(on)});
    all.push_back(std::move(named));
  }
  return all;
}

}  // namespace twinarm
