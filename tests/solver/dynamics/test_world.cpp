// World kinematics against poses and their derivatives (world_oracle.h), momentum and energy
// conservation, and the mass matrix.
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"
#include "solver/linear_algebra/dense_algebra.h"

#include "solver/dynamics/energy_momentum.h"
#include "tests/solver/dynamics/every_scalar.h"
#include "tests/solver/dynamics/world_oracle.h"

using namespace twinarm;
using namespace twinarm::testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A point of the last body in body axes, and from the body's origin in world axes.
struct Point {
  std::size_t body;
  Vec3<double> r_B;
  RealVector3 r_W;
  Point(Random& random, const MovingTree& t)
      : body(t.bodies.size()), r_B(from_eigen(random.vector(0.5))) {
    r_W = t.links[body].X.R * real(t.model.R_BL[body]).transpose() * real(r_B);
  }
};
// (angular; linear) by rows, a column for each velocity.
MatrixXd dense(const std::vector<Motion<double>>& J) {
  MatrixXd out(6, static_cast<Eigen::Index>(J.size()));
  for (std::size_t k = 0; k < J.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) << to_eigen(J[k].w), to_eigen(J[k].v);
  return out;
}
// State at time t of the motion with x.qd and qdd at t = 0, second order in q, first order in qd.
State<double> after(const Model<double>& model, const State<double>& x,
                    const std::vector<double>& qdd, double t) {
  State<double> y = x;
  std::vector<double> shift(model.nv);
  for (std::size_t k = 0; k < model.nv; ++k) {
    shift[k] = t * x.qd[k] + t * t / 2 * qdd[k];
    y.qd[k] += t * qdd[k];
  }
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      joint.integrate(&x.q[model.iq[i]], shift.data() + model.iv[i], &y.q[model.iq[i]]);
    });
  return y;
}
std::vector<JointType> without_prescribed() {
  std::vector<JointType> types = kAllJoints;
  std::erase(types, JointType::prescribed);
  return types;
}

}  // namespace

TEST_CASE("points, velocities, classical accelerations and Jacobians agree with poses") {
  Random random(1);
  double velocity = 0, acceleration = 0, column = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 15; ++n) {
      MovingTree t(random, random.integer(1, 4), types);
      const Point p(random, t);
      const LinkMotion& link = t.links[p.body];
      kinematics(t.model, t.x, t.w);
      rnea(t.model, t.x, t.qdd, std::vector<Force<double>>(t.model.parent.size()), t.w);

      CHECK(length_of(real(point_position(t.w, p.body, p.r_B)) - link.X.p - p.r_W) < 1e-13);
      const Vec3<double> v = point_velocity(t.w, p.body, p.r_B), w = angular_velocity(t.w, p.body);
      velocity = std::max(velocity, length_of(real(v) - link.velocity_of(p.r_W)));
      velocity = std::max(velocity, length_of(real(w) - link.w));
      const double scale = 1 + length_of(link.a) + length_of(link.alpha);
      const Vec3<double> a = point_acceleration(t.model, t.w, p.body, p.r_B);
      acceleration =
          std::max(acceleration, length_of(real(a) - link.acceleration_of(p.r_W)) / scale);
      acceleration = std::max(
          acceleration, length_of(real(angular_acceleration(t.w, p.body)) - link.alpha) / scale);

      std::vector<Motion<double>> J(t.model.nv);
      jacobian(t.model, t.w, p.body, p.r_B, J);
      const auto unit = unit_motions(t.bodies, t.model, q_with_prescribed(t.model, t.x));
      for (std::size_t k = 0; k < t.model.nv; ++k) {
        column = std::max(column, length_of(real(J[k].w) - unit[k][p.body].w));
        column = std::max(column, length_of(real(J[k].v) - unit[k][p.body].velocity_of(p.r_W)));
      }
    }
  MESSAGE("velocities " << velocity << " m/s, accelerations " << acceleration
                        << " relative, Jacobians " << column);
  CHECK(velocity < 1e-12);
  CHECK(acceleration < 1e-12);
  CHECK(column < 1e-12);
}

TEST_CASE("point_jacobian and rotation_jacobian agree with jacobian()") {
  Random random(2);
  for (int n = 0; n < 50; ++n) {
    MovingTree t(random, random.integer(1, 6), kAllJoints);
    const Point p(random, t);
    kinematics(t.model, t.x, t.w);
    std::vector<Motion<double>> J(t.model.nv);
    jacobian(t.model, t.w, p.body, p.r_B, J);
    const Kinematics k = kinematics_at(t.model, t.x);
    const int body = static_cast<int>(p.body);
    const Vector3 p_L = to_eigen(t.model.R_BL[p.body]).transpose() * to_eigen(p.r_B);
    const Vector3 p_W = k.position(body, p_L);
    CHECK((p_W - to_eigen(point_position(t.w, p.body, p.r_B))).norm() < 1e-13);
    CHECK((k.velocity(body, p_W) - to_eigen(point_velocity(t.w, p.body, p.r_B))).norm() < 1e-12);
    MatrixXd both(6, static_cast<Eigen::Index>(t.model.nv));
    both << rotation_jacobian(t.model, k, body), point_jacobian(t.model, k, body, p_W);
    CHECK((both - dense(J)).norm() < 1e-12);
  }
}

TEST_CASE("mass, centre of mass, momentum and energy are sums over the bodies") {
  Random random(3);
  double com_error = 0, linear_error = 0, angular_error = 0, energy_error = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 10; ++n) {
      MovingTree t(random, random.integer(1, 5), types);
      kinematics(t.model, t.x, t.w);
      Real mass = 0, kinetic = 0, potential = 0;
      RealVector3 moment = RealVector3::Zero(), linear = moment, angular = moment;
      for (std::size_t i = 1; i < t.model.parent.size(); ++i) {
        const BodyInertia& body = t.bodies[i - 1].inertia;
        const LinkMotion& link = t.links[i];
        const RealVector3 r = link.X.R * body.com.cast<Real>();
        const RealVector3 c = link.X.p + r, v = link.velocity_of(r);
        const RealMatrix3 I = link.X.R * body.inertia.cast<Real>() * link.X.R.transpose();
        mass += body.mass;
        moment += body.mass * c;
        linear += body.mass * v;
        angular += body.mass * c.cross(v) + I * link.w;
        kinetic += (body.mass * v.squaredNorm() + link.w.dot(I * link.w)) / 2;
        potential -= body.mass * c.dot(real(t.model.gravity));
      }
      const MassAndCom<double> all = mass_and_com(t.model, t.w);
      const Force<double> h = momentum(t.model, t.w);
      CHECK(all.mass == doctest::Approx(static_cast<double>(mass)).epsilon(1e-14));
      com_error = std::max(com_error, length_of(real(all.com) - moment / mass));
      linear_error =
          std::max(linear_error, length_of(real(h.f) - linear) / (1 + length_of(linear)));
      angular_error =
          std::max(angular_error, length_of(real(h.n) - angular) / (1 + length_of(angular)));
      const double T = kinetic_energy(t.model, t.x, t.w), V = potential_energy(t.model, t.w);
      energy_error =
          std::max(energy_error, static_cast<double>(std::abs(T - kinetic) / (1 + kinetic)));
      energy_error = std::max(
          energy_error, static_cast<double>(std::abs(V - potential) / (1 + std::abs(potential))));
      CHECK(kinetic_energy(t.model, t.x) == T);
      CHECK(potential_energy(t.model, t.x) == V);
    }
  MESSAGE("com " << com_error << " m, momentum " << linear_error << ", " << angular_error
                 << ", energies " << energy_error);
  CHECK(com_error < 1e-13);
  CHECK(linear_error < 1e-12);
  CHECK(angular_error < 1e-12);
  CHECK(energy_error < 1e-12);
}

TEST_CASE("the kinetic energy is half qd^T M qd, rotors included") {
  Random random(4);
  double worst = 0;
  for (int n = 0; n < 200; ++n) {  // a prescribed base has energy at qd = 0
    const Model<double> model =
        build(uneven_bodies(random, random.integer(1, 12), without_prescribed()));
    const State<double> x = random_state(random, model);
    Workspace<double> w(model);
    kinematics(model, x, w);
    const VectorXd qd = lane_of(x.qd, 0);
    const double expected = 0.5 * qd.dot(mass_matrix(model, x) * qd);
    worst = std::max(worst, std::abs(kinetic_energy(model, x, w) - expected) / (1e-3 + expected));
  }
  MESSAGE("largest relative difference = " << worst);
  CHECK(worst < 1e-13);
}

TEST_CASE("the gradient of the potential is the gravity term of inverse dynamics") {
  Random random(5);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 10; ++n) {
      const Model<double> model = random_tree(random, random.integer(1, 6), types);
      State<double> x = random_state(random, model);
      x.qd.assign(model.nv, 0);
      x.prescribed.assign(model.np, 0);
      Workspace<double> w(model);
      rnea(model, x, std::vector<double>(model.nv), std::vector<Force<double>>(model.parent.size()),
           w);
      for (std::size_t k = 0; k < model.nv; ++k) {
        State<double> along = x;
        along.qd[k] = 1;
        Real slope, curvature;
        differentiate(
            [&](Real t) -> Real {
              const State<double> y =
                  after(model, along, std::vector<double>(model.nv), static_cast<double>(t));
              return potential_energy(model, y);
            },
            slope, curvature);
        worst = std::max(worst, std::abs(static_cast<double>(slope) - w.tau[k]));
      }
    }
  MESSAGE("largest difference = " << worst << " N m");
  CHECK(worst < 1e-10);
}

TEST_CASE("the rate of momentum is the sum of the external forces") {
  Random random(6);
  double worst = 0;
  for (int n = 0; n < 60; ++n) {
    std::vector<TreeBody> bodies =
        random_bodies(random, random.integer(1, 6), without_prescribed());
    bodies[0].type = JointType::free;
    for (TreeBody& b : bodies) b.parent = std::max(b.parent, &b == &bodies[0] ? 0 : 1);
    const Model<double> model = build(bodies, random.vector(10));
    const State<double> x = random_state(random, model);
    Forces<double> forces = random_forces(random, model);
    std::fill_n(forces.tau.begin(), 6, 0.0);  // the base has f_ext only
    Workspace<double> w(model);
    aba(model, x, forces, w);
    const std::vector<double> qdd = w.qdd;
    kinematics(model, x, w);
    Force<double> outside;  // about the world's origin
    const MassAndCom<double> all = mass_and_com(model, w);
    const Vec3<double> weight = all.mass * model.gravity;
    outside += {cross(all.com, weight), weight};
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      outside += transpose_times(w.X0[i], forces.f_ext[i]);
    const auto at = [&](Real t) {
      Workspace<double> later(model);
      kinematics(model, after(model, x, qdd, static_cast<double>(t) / 40), later);
      return momentum(model, later);
    };
    RealVector3 linear, angular, unused;
    differentiate([&](Real t) -> RealVector3 { return real(at(t).f); }, linear, unused);
    differentiate([&](Real t) -> RealVector3 { return real(at(t).n); }, angular, unused);
    linear *= 40, angular *= 40;  // steps of 1e-4
    const double scale = 1 + length_of(real(outside.f)) + length_of(real(outside.n));
    worst = std::max(worst, length_of(linear - real(outside.f)) / scale);
    worst = std::max(worst, length_of(angular - real(outside.n)) / scale);
  }
  MESSAGE("largest relative difference = " << worst);
  CHECK(worst < 1e-8);
}
