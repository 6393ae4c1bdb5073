// Every joint against its definition (world_oracle.h): poses, velocities, accelerations, and the
// equations of motion of whole trees.
#include "tests/solver/dynamics/every_scalar.h"
#include "tests/solver/dynamics/world_oracle.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("poses, velocities and accelerations of links follow the joint definitions") {
  Random random(1);
  double pose = 0, velocity = 0, acceleration = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 20; ++n) {
      MovingTree t(random, random.integer(1, 3), types);
      rnea(t.model, t.x, t.qdd, std::vector<Force<double>>(t.model.parent.size()), t.w);
      const Workspace<double> from_rnea = t.w;
      kinematics(t.model, t.x, t.w);
      Kinematics k(t.model);
      forward_kinematics(t.model, t.x, k);
      for (std::size_t i = 1; i < t.model.parent.size(); ++i) {
        const LinkMotion& link = t.links[i];
        const RealMatrix3 R = real(t.w.X0[i].E).transpose();  // R_WB
        const RealMatrix3 R_WL = R * real(t.model.R_BL[i]);
        pose = std::max(pose, static_cast<double>((R_WL - link.X.R).norm()));
        pose = std::max(pose, static_cast<double>((k.X_WL[i].R.cast<Real>() - link.X.R).norm()));
        pose = std::max(pose, length_of(real(t.w.X0[i].r) - link.X.p));
        pose = std::max(pose, length_of(k.X_WL[i].p.cast<Real>() - link.X.p));

        const Motion<double>& v = t.w.v[i];
        velocity = std::max(velocity, length_of(R * real(v.w) - link.w));
        velocity = std::max(velocity, length_of(R * real(v.v) - link.v));
        // Spatial acceleration is the classical one without w x v, RBDA (2.50); a_0 = -g.
        const Motion<double>& a = from_rnea.a[i];
        const RealVector3 classical = R * (real(a.v) + real(v.w).cross(real(v.v)));
        const double scale =
            1 + length_of(link.a) + length_of(link.alpha) + length_of(real(t.model.gravity));
        acceleration = std::max(acceleration, length_of(R * real(a.w) - link.alpha) / scale);
        acceleration =
            std::max(acceleration, length_of(classical + real(t.model.gravity) - link.a) / scale);
      }
    }
  MESSAGE("poses " << pose << " m, velocities " << velocity << " m/s, accelerations "
                   << acceleration << " relative");
  CHECK(pose < 1e-13);
  CHECK(velocity < 1e-12);
  CHECK(acceleration < 1e-12);
}

TEST_CASE("columns of S are the link velocities per unit joint velocity") {
  Random random(2);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 20; ++n) {
      MovingTree t(random, random.integer(1, 3), types);
      kinematics(t.model, t.x, t.w);
      const auto unit = unit_motions(t.bodies, t.model, q_with_prescribed(t.model, t.x));
      for (std::size_t i = 1; i < t.model.parent.size(); ++i)
        for (std::size_t k = t.model.iv[i]; k < t.model.iv[i] + t.model.dofs(i); ++k) {
          const RealMatrix3 R = real(t.w.X0[i].E).transpose();
          worst = std::max(worst, length_of(R * real(t.w.S_[k].w) - unit[k][i].w));
          worst = std::max(worst, length_of(R * real(t.w.S_[k].v) - unit[k][i].v));
        }
    }
  MESSAGE("largest difference = " << worst);
  CHECK(worst < 1e-12);
}

// tau_k = sum over bodies of (unit motion k) . (Newton-Euler wrench).
TEST_CASE("rnea and crba agree with the Newton-Euler equations of each body in the world") {
  Random random(3);
  double torque = 0, mass = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 15; ++n) {
      MovingTree t(random, random.integer(1, 4), types);
      for (std::size_t i = 0; i < t.bodies.size(); ++i)
        t.bodies[i].properties.armature = random.uniform(0, 1);
      t.model = build(t.bodies, to_eigen(t.model.gravity));
      const Forces<double> forces = random_forces(random, t.model);
      rnea(t.model, t.x, t.qdd, forces.f_ext, t.w);
      const auto unit = unit_motions(t.bodies, t.model, q_with_prescribed(t.model, t.x));
      const RealVector3 g = real(t.model.gravity);
      const std::size_t nv = t.model.nv;
      double scale = 1, largest = 0, difference = 0;
      std::vector<Real> M(nv * nv), tau(nv);
      std::vector<double> by_crba(nv * nv);
      crba(t.model, t.x, t.w, by_crba);
      for (std::size_t i = 1; i < t.model.parent.size(); ++i) {
        const BodyInertia& body = t.bodies[i - 1].inertia;
        const LinkMotion& link = t.links[i];
        const RealMatrix3 R_WB = link.X.R * real(t.model.R_BL[i]).transpose();
        const RealVector3 c = link.X.R * body.com.cast<Real>();
        const RealMatrix3 I = link.X.R * body.inertia.cast<Real>() * link.X.R.transpose();
        const RealVector3 f = body.mass * (link.acceleration_of(c) - g);
        const RealVector3 couple = I * link.alpha + link.w.cross(I * link.w);
        const RealVector3 F = R_WB * real(forces.f_ext[i].f), N = R_WB * real(forces.f_ext[i].n);
        for (std::size_t k = 0; k < nv; ++k) {
          const LinkMotion& e = unit[k][i];
          tau[k] += e.velocity_of(c).dot(f) + e.w.dot(couple) - e.v.dot(F) - e.w.dot(N);
          for (std::size_t l = 0; l < nv; ++l)
            M[k * nv + l] += body.mass * e.velocity_of(c).dot(unit[l][i].velocity_of(c)) +
                             e.w.dot(I * unit[l][i].w);
        }
      }
      for (std::size_t i = 1; i < t.model.parent.size(); ++i)
        for (std::size_t k = t.model.iv[i]; k < t.model.iv[i] + t.model.dofs(i); ++k) {
          const double armature = t.bodies[i - 1].properties.armature;
          tau[k] += armature * t.qdd[k];
          M[k * nv + k] += armature;
        }
      for (std::size_t k = 0; k < nv; ++k) {
        scale = std::max(scale, static_cast<double>(std::abs(tau[k])));
        difference = std::max(difference, static_cast<double>(std::abs(tau[k] - t.w.tau[k])));
        largest = std::max(largest, static_cast<double>(M[k * nv + k]));
      }
      torque = std::max(torque, difference / scale);
      for (std::size_t k = 0; k < nv * nv; ++k)
        mass = std::max(mass, static_cast<double>(std::abs(M[k] - by_crba[k])) / largest);
    }
  MESSAGE("relative differences: tau " << torque << ", M " << mass);
  CHECK(torque < 1e-12);
  CHECK(mass < 1e-13);
}

TEST_CASE("the joint wrench is the sum of the Newton-Euler wrenches of the descendants") {
  Random random(4);
  for (int n = 0; n < 100; ++n) {
    MovingTree t(random, random.integer(1, 5), {all_joint_types.begin(), all_joint_types.end()});
    const Forces<double> forces = random_forces(random, t.model);
    rnea(t.model, t.x, t.qdd, forces.f_ext, t.w);
    const std::vector<Force<double>> f = t.w.f;
    kinematics(t.model, t.x, t.w);
    RealVector3 linear = RealVector3::Zero(), angular = RealVector3::Zero();  // about the world's o
    for (std::size_t i = 1; i < t.model.parent.size(); ++i) {
      const BodyInertia& body = t.bodies[i - 1].inertia;
      const LinkMotion& link = t.links[i];
      const RealMatrix3 R_WB = link.X.R * real(t.model.R_BL[i]).transpose();
      const RealVector3 c = link.X.R * body.com.cast<Real>();
      const RealMatrix3 I = link.X.R * body.inertia.cast<Real>() * link.X.R.transpose();
      const RealVector3 need = body.mass * (link.acceleration_of(c) - real(t.model.gravity));
      const RealVector3 F = R_WB * real(forces.f_ext[i].f), N = R_WB * real(forces.f_ext[i].n);
      linear += need - F;
      angular += (link.X.p + c).cross(need) + I * link.alpha + link.w.cross(I * link.w) - N -
                 link.X.p.cross(F);
    }
    // f[0]: wrench of the base on all bodies, about the world's origin.
    CHECK(length_of(real(f[0].f) - linear) < 1e-10 * (1 + length_of(linear)));
    CHECK(length_of(real(f[0].n) - angular) < 1e-10 * (1 + length_of(angular)));
  }
}

TEST_CASE("integrate() is q exp(delta) of the joint definition") {
  Random random(5);
  const std::vector<double> none;
  for (const JointType type : all_joint_types)
    for (const double length : {1e-9, 1e-3, 0.0999, 0.1001, 1.0, 3.0, 7.0}) {
      CAPTURE(std::string(name_of(type)));
      MovingTree t(random, 1, {type});
      std::vector<double> shift = random_numbers(random, t.model.nv, 1);
      for (double& s : shift) s *= length;
      State<double> moved = t.x;
      visit_joint(t.model, 1,
                  [&](auto joint) { joint.integrate(t.x.q.data(), shift.data(), moved.q.data()); });
      const std::vector<double> zero(t.model.nv);
      State<double> in_place = t.x;
      visit_joint(t.model, 1, [&](auto joint) {
        joint.integrate(in_place.q.data(), shift.data(), in_place.q.data());
      });
      CHECK(in_place.q == moved.q);
      // Prescribed joints: at time 0.
      const RealPose expected = link_poses(t.bodies, t.model, q_with_prescribed(t.model, t.x),
                                           shift, zero, type == JointType::prescribed ? 0 : 1)[1];
      const RealPose got =
          link_poses(t.bodies, t.model, q_with_prescribed(t.model, moved), zero, zero, 0)[1];
      CHECK(static_cast<double>((expected.R - got.R).norm()) < 2e-15);
      CHECK(length_of(expected.p - got.p) < 4e-15);
      if (const int at = facts_of(type).quaternion; at >= 0 && t.model.nv > 0)
        CHECK(std::abs(Eigen::Map<const Eigen::Vector4d>(&moved.q[0] + at).norm() - 1) < 3e-16);
    }
}

TEST_CASE("dexpinv is the rate of the exponential coordinates, to fifth order in them") {
  Random random(6);
  for (const JointType type : {JointType::spherical, JointType::free})
    for (int n = 0; n < 20; ++n) {
      // R(t) = exp(theta + t theta') has the body rate w at t = 0; dexpinv(theta, w) = theta'.
      const RealVector3 theta = random.vector(0.05).cast<Real>();
      const RealVector3 rate = random.vector(1).cast<Real>();
      RealMatrix3 dR, ddR;
      differentiate([&](Real t) -> RealMatrix3 { return rotation_by(theta + t * rate); }, dR, ddR);
      const RealMatrix3 spin = rotation_by(theta).transpose() * dR;
      const std::array<double, 3> angle{static_cast<double>(theta.x()),
                                        static_cast<double>(theta.y()),
                                        static_cast<double>(theta.z())},
          w{static_cast<double>(spin(2, 1)), static_cast<double>(spin(0, 2)),
            static_cast<double>(spin(1, 0))};
      RealVector3 got;
      if (type == JointType::spherical) {
        const auto r = SphericalJoint<double>::dexpinv(angle, w);
        got = {r[0], r[1], r[2]};
      } else {
        const auto r = FreeJoint<double>::dexpinv({angle[0], angle[1], angle[2], 1, 2, 3},
                                                  {w[0], w[1], w[2], 4, 5, 6});
        got = {r[0], r[1], r[2]};
        CHECK(r[3] == 4);
        CHECK(r[4] == 5);
        CHECK(r[5] == 6);
      }
      CHECK(length_of(got - rate) < 1e-11);  // theta^6 / 30240 of the next term
    }
}
