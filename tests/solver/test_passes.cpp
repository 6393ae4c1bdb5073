#include <doctest/doctest.h>

#include <Eigen/Cholesky>

#include "solver/aba.h"
#include "solver/crba.h"
#include "solver/energy.h"
#include "solver/kinematics.h"
#include "solver/rnea.h"
#include "tests/solver/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::Map;
using Eigen::VectorXd;

VectorXd eigen(const std::vector<double>& v) {
  return Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

// Every list of joint types that the contract tests run over: each type alone, and all mixed.
std::vector<std::vector<JointType>> lists_of_types() {
  std::vector<std::vector<JointType>> lists;
  for (JointType type : all_joint_types)
    if (type != JointType::fixed) lists.push_back({type});
  lists.push_back({all_joint_types.begin(), all_joint_types.end()});
  return lists;
}

struct Case {
  Model<double> model;
  State<double> x;
  Forces<double> forces;
  Case(Random& random, const std::vector<JointType>& types)
      : model(random_tree(random, random.integer(1, 12), types)),
        x(random_state(random, model)),
        forces(model) {
    for (double& tau : forces.tau) tau = random.uniform(-5, 5);
    for (Force<double>& f : forces.f_ext)
      f = {from_eigen(random.vector(3)), from_eigen(random.vector(3))};
  }
};

}  // namespace

TEST_CASE("rnea gives back the torques that aba was given, on random trees of every joint") {
  Random random(1);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 200; ++n) {
      Case c(random, types);
      Workspace<double> w(c.model), w2(c.model);
      aba(c.model, c.x, c.forces, w);
      rnea(c.model, c.x, w.qdd, c.forces.f_ext, w2);
      Eigen::MatrixXd M;
      Workspace<double> w3(c.model);
      crba(c.model, c.x, w3, M);
      rnea(c.model, c.x, std::vector<double>(c.model.nv), c.forces.f_ext, w3);
      if (c.model.nv == 0) continue;
      const double scale =
          (M.cwiseAbs() * eigen(w.qdd).cwiseAbs() + eigen(w3.tau).cwiseAbs()).maxCoeff();
      const double error = (eigen(w2.tau) - eigen(c.forces.tau)).cwiseAbs().maxCoeff();
      worst = std::max(worst, error / scale);
    }
  MESSAGE("largest |rnea(aba(tau)) - tau| / max(|M||qdd| + |h|) = " << worst);
  CHECK(worst <= 1e-14);
}

TEST_CASE("aba agrees with M^-1 (tau - h) of crba and rnea, on random trees of every joint") {
  Random random(2);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 200; ++n) {
      Case c(random, types);
      if (c.model.nv == 0) continue;
      for (double& armature : c.forces.armature) armature = random.uniform(0, 1);
      Workspace<double> w(c.model), w2(c.model);
      aba(c.model, c.x, c.forces, w);
      Eigen::MatrixXd M;
      crba(c.model, c.x, w2, M);
      M.diagonal() += eigen(c.forces.armature);
      rnea(c.model, c.x, std::vector<double>(c.model.nv), c.forces.f_ext, w2);
      const VectorXd qdd = M.ldlt().solve(eigen(c.forces.tau) - eigen(w2.tau));
      worst = std::max(worst, (eigen(w.qdd) - qdd).norm() / qdd.norm());
    }
  MESSAGE("largest relative difference = " << worst);
  CHECK(worst <= 1e-12);
}

TEST_CASE("the kinetic energy is half qd^T M qd") {
  Random random(3);
  for (int n = 0; n < 100; ++n) {
    Case c(random, {all_joint_types.begin(), all_joint_types.end()});
    Workspace<double> w(c.model);
    Eigen::MatrixXd M;
    crba(c.model, c.x, w, M);
    const VectorXd qd = eigen(c.x.qd);
    CHECK(kinetic_energy(c.model, c.x) == doctest::Approx(0.5 * qd.dot(M * qd)).epsilon(1e-12));
  }
}

TEST_CASE("the planar two-link arm has the closed-form mass matrix and Coriolis terms (CASES F2)") {
  const double m1 = 5, m2 = 3, l1 = 0.4, c1 = 0.2, c2 = 0.15, I1 = 0.07, I2 = 0.02;
  ModelBuilder builder;
  const Vector3 z = Vector3::UnitZ();
  const auto rod = [](double m, double c, double I) {
    return BodyInertia{m, {c, 0, 0}, Vector3(0.6 * I, 0.7 * I, I).asDiagonal()};
  };
  builder.add_body("arm1", 0, "joint1", JointType::revolute, {}, z, rod(m1, c1, I1));
  builder.add_body("arm2", 1, "joint2", JointType::revolute, {Matrix3::Identity(), {l1, 0, 0}}, z,
                   rod(m2, c2, I2));
  const Model<double> model = builder.build();
  Random random(4);
  for (int n = 0; n < 50; ++n) {
    const State<double> x = random_state(random, model);
    const double q2 = x.q[1], w1 = x.qd[0], w2 = x.qd[1];
    const double M11 = I1 + m1 * c1 * c1 + I2 + m2 * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * cos(q2));
    const double M12 = I2 + m2 * (c2 * c2 + l1 * c2 * cos(q2)), M22 = I2 + m2 * c2 * c2;
    const double h = m2 * l1 * c2 * sin(q2);
    Workspace<double> w(model);
    Eigen::MatrixXd M;
    crba(model, x, w, M);
    CHECK(M(0, 0) == doctest::Approx(M11).epsilon(1e-14));
    CHECK(M(0, 1) == doctest::Approx(M12).epsilon(1e-14));
    CHECK(M(1, 1) == doctest::Approx(M22).epsilon(1e-14));
    rnea(model, x, {0, 0}, std::vector<Force<double>>(3), w);
    CHECK(w.tau[0] == doctest::Approx(-h * (2 * w1 * w2 + w2 * w2)).epsilon(1e-12));
    CHECK(w.tau[1] == doctest::Approx(h * w1 * w1).epsilon(1e-12));
  }
}

TEST_CASE("velocities and Jacobians are the derivatives of positions, for every joint") {
  Random random(5);
  for (int n = 0; n < 50; ++n) {
    Case c(random, {all_joint_types.begin(), all_joint_types.end()});
    const int body = c.model.body_count() - 1;
    const Vector3 p_L = random.vector(0.5);
    const auto moved = [&](double s) {  // q exp(s qd)
      State<double> y = c.x;
      std::vector<double> shift = c.x.qd;
      for (double& d : shift) d *= s;
      for (std::size_t i = 1; i < c.model.parent.size(); ++i)
        visit_joint<double>(c.model.joint[i], [&](auto joint) {
          joint.integrate(c.x.q.data() + c.model.iq[i], shift.data() + c.model.iv[i],
                          y.q.data() + c.model.iq[i]);
        });
      Kinematics k(c.model);
      forward_kinematics(c.model, y, k);
      return k.position(body, p_L);
    };
    Kinematics k(c.model);
    forward_kinematics(c.model, c.x, k);
    const Vector3 p_W = k.position(body, p_L);
    const double e = 1e-5;
    const Vector3 by_difference = (moved(e) - moved(-e)) / (2 * e);
    const Vector3 by_pass = k.velocity(body, p_W);
    const Vector3 by_jacobian = point_jacobian(c.model, k, body, p_W) * eigen(c.x.qd);
    CHECK((by_pass - by_difference).norm() < 1e-7);
    CHECK((by_pass - by_jacobian).norm() < 1e-12);
    const Vector3 turn_rate = rotation_jacobian(c.model, k, body) * eigen(c.x.qd);
    CHECK((k.w_WL[static_cast<std::size_t>(body)] - turn_rate).norm() < 1e-12);
  }
}
