#include "app/inspect/force_balance.h"

namespace twinarm {
namespace {

Vector3 in_world(const Inspection& in, std::size_t body, const Vec3<double>& a_B) {
  return in.k.R_WB[body] * to_eigen(a_B);
}

NamedWrench named(const Inspection& in, std::string source, std::size_t body,
                  const Force<double>& f) {
  return {std::move(source), in_world(in, body, f.f), in_world(in, body, f.n)};
}

// Minus m a_C and minus the rate of angular momentum about the link's origin O:
//   m a_C = m a_O + alpha x h + w x (w x h),   h = m r_OC
//   I_O alpha + w x I_O w + h x a_O
NamedWrench inertia_of(const Inspection& in, std::size_t i) {
  const Inertia<double>& I = in.model.I[i];
  const Matrix3& R = in.k.R_WB[i];
  const Vector3 w = in_world(in, i, in.w.v[i].w), alpha = in_world(in, i, in.w.a[i].w);
  const Vector3 v = in_world(in, i, in.w.v[i].v);
  const Vector3 a_O = in_world(in, i, in.w.a[i].v) + to_eigen(in.model.gravity) + w.cross(v);
  const Vector3 h = R * to_eigen(I.h);
  const Matrix3 I_O = R * to_eigen(full(I.I)) * R.transpose();
  const Vector3 force = I.m * a_O + alpha.cross(h) + w.cross(w.cross(h));
  const Vector3 torque = I_O * alpha + w.cross(I_O * w) + h.cross(a_O);
  return {"inertia", -force, -torque};
}

// Weight of the subtree [N]: scale of the rounding error where a body falls freely.
double subtree_weight(const Inspection& in, std::size_t i) {
  double mass = 0;
  for (std::size_t j = i; j < in.body_count(); ++j)
    if (in.is_below(j, i)) mass += in.model.I[j].m;
  return mass * to_eigen(in.model.gravity).norm();
}

}  // namespace

std::string joint_label(const Inspection& in, std::size_t body) {
  const std::string& name = in.model.joint_name[body];
  return name.empty() ? "base" : name;
}

double gyroscopic_load(const Inspection& in, std::size_t i) {
  const Force<double> h = in.model.I[i] * in.w.v[i];
  const Vector3 w = to_eigen(in.w.v[i].w), v = to_eigen(in.w.v[i].v);
  const Vector3 n = to_eigen(h.n), f = to_eigen(h.f);
  return std::max((w.cross(n) + v.cross(f)).lpNorm<Eigen::Infinity>(),
                  w.cross(f).lpNorm<Eigen::Infinity>());
}

Force<double> joint_force(const Inspection& in, std::size_t i) {
  return in.w.IA[i] * in.w.a[i] + in.w.pA[i];
}

BodyBalance balance_of(const Inspection& in, std::size_t body, const Viewpoint& from) {
  BodyBalance balance;
  balance.body = body;
  std::vector<NamedWrench>& all = balance.wrenches;
  const Vector3 g = to_eigen(in.model.gravity), h = in_world(in, body, in.model.I[body].h);
  all.push_back({"gravity", in.model.I[body].m * g, h.cross(g)});
  all.push_back(named(in, "joint/" + joint_label(in, body), body, joint_force(in, body)));
  for (const std::size_t child : in.children(body)) {
    NamedWrench back =
        named(in, "child/" + in.model.body_name[child], child, -joint_force(in, child));
    back.torque += (in.k.X_WL[child].p - in.k.X_WL[body].p).cross(back.force);
    all.push_back(std::move(back));
  }
  for (const AppliedForce& actor : in.actors)
    for (const AppliedForce::OnBody& on : actor.bodies)
      if (on.body == body) all.push_back(named(in, actor.source, body, in.force_of(on)));
  all.push_back(inertia_of(in, body));

  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (NamedWrench& wrench : all) {
    wrench = from.see(in, body, std::move(wrench));
    force += wrench.force;
    torque += wrench.torque;
    balance.largest = std::max({balance.largest, wrench.force.lpNorm<Eigen::Infinity>(),
                                wrench.torque.lpNorm<Eigen::Infinity>()});
  }
  const double rest = std::max(force.lpNorm<Eigen::Infinity>(), torque.lpNorm<Eigen::Infinity>());
  const double size =
      std::max({balance.largest, subtree_weight(in, body), gyroscopic_load(in, body)});
  balance.residual = rest == 0 ? 0 : rest / size;
  return balance;
}

std::vector<JointBalance> joint_balances(const Inspection& in) {
  std::vector<JointBalance> all;
  for (std::size_t i = 1; i < in.body_count(); ++i) {
    if (in.model.dofs(i) == 0) continue;
    const Force<double> f = joint_force(in, i);
    const double weight = subtree_weight(in, i);
    for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof) {
      JointBalance balance;
      balance.body = i;
      balance.dof = dof;
      for (const AppliedForce& actor : in.actors)
        for (const AppliedForce::OnJoint& on : actor.joints)
          if (on.dof == dof) balance.torques.push_back({actor.source, in.torque_of(on)});
      if (in.model.armature[dof] != 0)
        balance.torques.push_back({"rotor", -in.model.armature[dof] * in.w.qdd[dof]});
      balance.torques.push_back({"body", -dot(in.w.S_[dof], f)});
      double sum = 0;
      for (const JointBalance::Torque& torque : balance.torques) {
        sum += torque.value;
        balance.largest = std::max(balance.largest, std::abs(torque.value));
      }
      // S^T f is a sum of products that may cancel: the residual is relative to |f| and |pA| too.
      const Force<double>& pA = in.w.pA[i];
      const double size =
          std::sqrt(std::max({dot(f.n, f.n), dot(f.f, f.f), dot(pA.n, pA.n), dot(pA.f, pA.f)}));
      balance.largest = std::max({balance.largest, size, weight});
      balance.residual = sum == 0 ? 0 : std::abs(sum) / balance.largest;
      all.push_back(std::move(balance));
    }
  }
  return all;
}

Matrix3 Viewpoint::R_WV(const Inspection& in, std::size_t body) const {
  if (axes == Axes::world) return Matrix3::Identity();
  return in.k.X_WL[axes == Axes::own ? body : axes_of].R;
}

Vector3 Viewpoint::p_WV(const Inspection& in, std::size_t body) const {
  if (about == About::point) return point;
  if (about == About::body) return in.k.X_WL[about_body].p;
  const Inertia<double>& I = in.model.I[body];
  if (about == About::own_origin || !(I.m > 0)) return in.k.X_WL[body].p;
  const Vector3 h = in.k.R_WB[body] * to_eigen(I.h);
  return in.k.X_WL[body].p + h / I.m;
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
  for (const AppliedForce& actor : in.actors) {
    NamedForce named{&actor, {}, {}, std::nullopt};
    for (const AppliedForce::OnBody& on : actor.bodies) {
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
    for (const AppliedForce::OnJoint& on : actor.joints)
      for (std::size_t i = 1; i < in.body_count(); ++i)
        if (on.dof >= in.model.iv[i] && on.dof < in.model.iv[i] + in.model.dofs(i))
          named.joints.push_back({i, on.dof, in.torque_of(on)});
    all.push_back(std::move(named));
  }
  return all;
}

}  // namespace twinarm
