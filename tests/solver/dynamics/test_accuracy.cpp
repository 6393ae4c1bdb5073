// Accelerations, torques and mass matrices in closed form: one evaluation, no integration. Cases of
// textbooks (by their number in the validation catalogue where they have one).
#include <cmath>
#include <numbers>

#include "solver/dynamics/mass_matrix.h"
#include "solver/dynamics/world_kinematics.h"
#include "tests/solver/dynamics/every_scalar.h"

using namespace twinarm;
using namespace twinarm::testing;
using std::numbers::pi;

namespace {

constexpr double kGravity = 9.81;
const Vector3 kX = Vector3::UnitX(), kY = Vector3::UnitY(), kZ = Vector3::UnitZ();

// Relative to the larger of the two; the first decimal place that differs is the 12th at the least.
bool equal(double a, double b) {
  return std::abs(a - b) <= 1e-12 * std::max(1.0, std::max(std::abs(a), std::abs(b)));
}
TreeBody body(int parent, JointType type, const Vector3& axis, const BodyInertia& inertia,
              const Pose& X_PJ = {}, const JointProperties& properties = {}) {
  return {parent, type, X_PJ, axis, inertia, properties};
}
std::vector<double> qdd_of(const Model<double>& model, const State<double>& x,
                           const std::vector<double>& tau = {}) {
  Forces<double> forces(model);
  if (!tau.empty()) forces.tau = tau;
  Workspace<double> w(model);
  aba(model, x, forces, w);
  return w.qdd;
}
Matrix3 turned(const Vector3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

TEST_CASE("B4: a nut falls along its screw at m g p / (I + m p^2), and turns as the pitch says") {
  const double m = 2, I = 0.05, p = 0.1 / (2 * pi);
  for (const double hand : {1.0, -1.0}) {
    JointProperties screw;
    screw.pitch = hand * p;
    const Model<double> model =
        build({body(0, JointType::screw, kZ, {m, {0, 0, 0.3}, Vector3(0.04, 0.04, I).asDiagonal()},
                    {}, screw)});
    const State<double> x(model);
    const double qdd = qdd_of(model, x)[0];
    CHECK(equal(qdd, -hand * m * kGravity * p / (I + m * p * p)));
    CHECK(equal(std::abs(qdd), 6.1825971606954312));
    CHECK(equal(hand * p * qdd, -0.098399089927059503));
    CHECK(std::abs(qdd_of(model, x, {hand * 0.31226199834629865})[0]) < 1e-14);  // holds it
    State<double> turn = x;
    turn.q[0] = 3;
    Workspace<double> w(model);
    kinematics(model, turn, w);
    CHECK(equal(w.X0[1].r.z, hand * p * 3));
  }
}

TEST_CASE("B9: cylindrical, planar and free joints fall and turn as if each dof were alone") {
  const BodyInertia drum{1.5, Vector3::Zero(), Vector3(0.01, 0.01, 0.02).asDiagonal()};
  const Model<double> cylinder = build({body(0, JointType::cylindrical, kZ, drum)});
  const std::vector<double> qdd = qdd_of(cylinder, State<double>(cylinder), {0.3, 0});
  CHECK(equal(qdd[0], 15));
  CHECK(equal(qdd[1], -kGravity));

  // On a plane inclined by 20 degrees whose x points down the slope.
  const Model<double> plane =
      build({body(0, JointType::planar, kZ, drum, {turned(kY, 20 * pi / 180), Vector3::Zero()})});
  State<double> x(plane);
  x.q = {0.4, -2, 0.7};
  x.qd = {1, 2, 3};
  const std::vector<double> slide = qdd_of(plane, x);
  CHECK(equal(slide[0], kGravity * std::sin(20 * pi / 180)));
  CHECK(equal(slide[0], 2 * (18.098479227111646 - 3) / 9));  // of x(3 s) with v = 1 m/s
  CHECK(equal(slide[1], 0));
  CHECK(equal(slide[2], 0));

  const Model<double> thrown = build({body(0, JointType::free, kZ, drum)});
  State<double> flight(thrown);
  flight.q = {0, 0, 1, 0.5, 0.5, -0.5, 0.5};
  flight.qd = {1, 2, 3, 3, 0, 4};
  const std::vector<double> fall = qdd_of(thrown, flight);
  // Euler: I w' = (I w) x w in body axes; and the origin falls at g in the world's.
  CHECK(equal(fall[0], (0.01 - 0.02) / 0.01 * 2 * 3));
  CHECK(equal(fall[1], (0.02 - 0.01) / 0.01 * 3 * 1));
  CHECK(equal(fall[2], 0));
  CHECK(equal(fall[3], 0));
  CHECK(equal(fall[4], 0));
  CHECK(equal(fall[5], -kGravity));
}

TEST_CASE("B8: Hooke's joint turns its output shaft by tan(out) = tan(in) / cos(angle)") {
  // The yoke of the input turns about z; the output shaft is turned from it by the two axes of the
  // cross, so that the shaft's own axis stays 30 degrees off: q2 by closed form.
  const double beta = pi / 6, in = pi / 6;
  const double out = std::atan2(std::sin(in) / std::cos(beta), std::cos(in));
  CHECK(equal(out * 180 / pi, 33.690067525979787));
  const double ratio = std::cos(beta) / (1 - std::pow(std::sin(beta) * std::cos(in), 2));
  // The cross carried by the input yoke: first axis x of the yoke, second axis y of the cross.
  // Output shaft s = (sin b, 0, cos b) in the world. Its yoke axis is normal to s and to the
  // input's yoke axis; the universal joint must carry z of the input to s.
  const Vector3 s(std::sin(beta), 0, std::cos(beta));
  const Vector3 s_in = turned(kZ, in).transpose() * s;  // seen from the input shaft
  // Rx(q1) Ry(q2) z = (sin q2, -sin q1 cos q2, cos q1 cos q2)
  const double q2 = std::asin(s_in.x()), q1 = std::atan2(-s_in.y(), s_in.z());
  const BodyInertia any{1, Vector3::Zero(), Matrix3::Identity()};
  // About -z turned onto x: the axis is x, and the second y turned with it, which stays y.
  const Model<double> model =
      build({body(0, JointType::revolute, kZ, any), body(1, JointType::universal, kX, any)});
  State<double> x(model);
  x.q = {in, q1, q2};
  // Rates: the shaft's axis stands still while the input turns at 1 rad/s.
  const double h = 1e-5;
  const auto cross_at = [&](double angle) {
    const Vector3 seen = turned(kZ, angle).transpose() * s;
    return std::array{std::atan2(-seen.y(), seen.z()), std::asin(seen.x())};
  };
  const auto plus = cross_at(in + h), minus = cross_at(in - h);
  x.qd = {1, (plus[0] - minus[0]) / (2 * h), (plus[1] - minus[1]) / (2 * h)};
  Workspace<double> w(model);
  kinematics(model, x, w);
  const Vector3 omega = to_eigen(angular_velocity(w, 2));
  CHECK((omega - omega.norm() * s).norm() < 1e-9);  // about its own axis
  CHECK(omega.norm() == doctest::Approx(ratio).epsilon(1e-9));
  CHECK(ratio == doctest::Approx(1.065877420042386).epsilon(1e-14));
}

TEST_CASE("B8: a plate on a universal joint swings at the frequencies of its two axes") {
  // 1 m long along -z, 0.6 m wide along x, hung by its edge's centre; axes x and y.
  const double m = 1, l = 1, b = 0.6;
  const BodyInertia plate{
      m,
      {0, 0, -l / 2},
      Vector3(m * l * l / 12, m * (l * l + b * b) / 12, m * b * b / 12).asDiagonal()};
  const Model<double> model = build({body(0, JointType::universal, kX, plate)});
  for (const auto& [dof, frequency] :
       {std::pair{0, 3.8360135557633265}, std::pair{1, 3.6742346141747671}}) {
    State<double> x(model);
    const double angle = 1e-4;
    x.q[static_cast<std::size_t>(dof)] = angle;
    const double qdd = qdd_of(model, x)[static_cast<std::size_t>(dof)];
    // One axis alone is a compound pendulum: exact at any angle.
    CHECK(std::sqrt(-qdd / std::sin(angle)) == doctest::Approx(frequency).epsilon(1e-12));
  }
}

TEST_CASE("B7: the spherical pendulum's equations of motion, on a ball joint and a universal one") {
  // theta'' = sin cos phi'^2 - g sin; released at 60 degrees with phi' = 2.
  const double theta = pi / 3, phi_rate = 2;
  const Vector3 r(std::sin(theta), 0, -std::cos(theta));
  const Vector3 v = Vector3(0, 0, phi_rate).cross(r);
  // The bob's acceleration: gravity and a tension along -r that keeps |r| = 1.
  const Vector3 weight(0, 0, -kGravity);
  const Vector3 a = weight - (weight.dot(r) + v.squaredNorm()) * r;
  CHECK(v.y() == doctest::Approx(2 * std::sin(theta)).epsilon(1e-15));

  const BodyInertia bob{1, {0, 0, -1}, Matrix3(Vector3(1e-9, 1e-9, 1e-9).asDiagonal())};
  const BodyInertia point{1, {0, 0, -1}, Matrix3::Zero()};
  // Ball: a little inertia about its own axis, without which the spin has no acceleration.
  const Model<double> ball = build({body(0, JointType::spherical, kZ, bob)});
  State<double> x(ball);
  Eigen::Quaterniond q(turned(kY, -theta));
  x.q = {q.w(), q.x(), q.y(), q.z()};
  const Vector3 w_B = turned(kY, -theta).transpose() * r.cross(v);  // no spin about the rod
  x.qd = {w_B.x(), w_B.y(), w_B.z()};
  Workspace<double> w(ball);
  aba(ball, x, Forces<double>(ball), w);
  kinematics(ball, x, w);
  const Vec3<double> tip{0, 0, -1};
  const Motion<double> spatial{w.a[1].w, w.a[1].v + w.X0[1].E * ball.gravity};
  const Vec3<double> rate = cross(w.v[1].w, tip);
  const Vector3 a_B = to_eigen(spatial.v + cross(spatial.w, tip) + cross(w.v[1].w, rate));
  CHECK((turned(kY, -theta) * a_B - a).norm() < 2e-8);  // of the inertia that was added

  // Universal joint with a point mass: no spin to speak of. First about x, then about y:
  // bob = -(sin q2, -sin q1 cos q2, cos q1 cos q2).
  const Model<double> hooke = build({body(0, JointType::universal, kX, point)});
  State<double> y(hooke);
  y.q = {0, -theta};
  y.qd = {v.y() / std::cos(theta), 0};
  const std::vector<double> qdd = qdd_of(hooke, y);
  // Lagrange for r = (-sin q2, sin q1 cos q2, -cos q1 cos q2):
  //   cos q2 q1'' - 2 sin q2 q1' q2' = -g sin q1,  q2'' + sin q2 cos q2 q1'^2 = -g cos q1 sin q2
  CHECK(equal(qdd[0], 0));
  CHECK(equal(qdd[1], -std::sin(-theta) * std::cos(theta) * y.qd[0] * y.qd[0] -
                          kGravity * std::sin(-theta)));
  y.q = {0.4, -0.9};
  y.qd = {1.3, -0.6};
  const std::vector<double> moving = qdd_of(hooke, y);
  CHECK(equal(moving[0],
              (2 * std::sin(-0.9) * 1.3 * -0.6 - kGravity * std::sin(0.4)) / std::cos(-0.9)));
  CHECK(equal(moving[1], -std::sin(-0.9) * std::cos(-0.9) * 1.3 * 1.3 -
                             kGravity * std::cos(0.4) * std::sin(-0.9)));
}

TEST_CASE("B3: a rod let go from the horizontal starts at 3 g / 2 L, its hinge bears a quarter") {
  const double L = 1, m = 1.7;
  const Model<double> model =
      build({body(0, JointType::revolute, kY,
                  {m, {0, 0, -L / 2}, Vector3(m * L * L / 12, m * L * L / 12, 0).asDiagonal()})});
  State<double> x(model);
  x.q[0] = pi / 2;
  const std::vector<double> qdd = qdd_of(model, x);
  CHECK(equal(qdd[0], -1.5 * kGravity / L));
  Workspace<double> w(model);
  rnea(model, x, qdd, std::vector<Force<double>>(2), w);
  CHECK(equal(w.f[0].f.x, 0));
  CHECK(equal(w.f[0].f.z, m * kGravity / 4));
  // At the bottom it hangs on 5/2 m g.
  x.q[0] = 0;
  x.qd[0] = 5.4249423960075373;
  rnea(model, x, qdd_of(model, x), std::vector<Force<double>>(2), w);
  CHECK(equal(w.f[0].f.z, 2.5 * m * kGravity));
}

TEST_CASE("F2: the planar two-link arm's mass matrix and Coriolis terms") {
  const double m1 = 5, m2 = 3, l1 = 0.4, c1 = 0.2, c2 = 0.15, I1 = 0.07, I2 = 0.02;
  const auto rod = [](double m, double c, double I) {
    return BodyInertia{m, {c, 0, 0}, Vector3(0.6 * I, 0.7 * I, I).asDiagonal()};
  };
  const Model<double> model =
      build({body(0, JointType::revolute, kZ, rod(m1, c1, I1)),
             body(1, JointType::revolute, kZ, rod(m2, c2, I2), {Matrix3::Identity(), {l1, 0, 0}})});
  Random random(4);
  for (int n = 0; n < 50; ++n) {
    const State<double> x = random_state(random, model);
    const double q2 = x.q[1], w1 = x.qd[0], w2 = x.qd[1];
    const double M11 = I1 + m1 * c1 * c1 + I2 + m2 * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * cos(q2));
    const double M12 = I2 + m2 * (c2 * c2 + l1 * c2 * cos(q2)), M22 = I2 + m2 * c2 * c2;
    const double h = m2 * l1 * c2 * sin(q2);
    Workspace<double> w(model);
    const Eigen::MatrixXd M = mass_matrix(model, x);
    CHECK(equal(M(0, 0), M11));
    CHECK(equal(M(0, 1), M12));
    CHECK(equal(M(1, 0), M12));
    CHECK(equal(M(1, 1), M22));
    rnea(model, x, {0, 0}, std::vector<Force<double>>(3), w);
    CHECK(equal(w.tau[0], -h * (2 * w1 * w2 + w2 * w2)));
    CHECK(equal(w.tau[1], h * w1 * w1));
  }
}

TEST_CASE("C8: Furuta's pendulum") {
  const double J0 = 0.02, L = 0.3, m = 0.2, l = 0.15, J = 0.0015;
  // Arm along x, turning about z; the pendulum turns about the arm, and hangs on -z at 0. Positive
  // q2 lifts it towards +y, the way the arm moves: M12 = + m L l cos q2.
  const Model<double> model = build(
      {body(0, JointType::revolute, kZ, {1, Vector3::Zero(), Vector3(J0, J0, J0).asDiagonal()}),
       body(1, JointType::revolute, kX, {m, {0, 0, -l}, Vector3(J, J, 0).asDiagonal()},
            {Matrix3::Identity(), {L, 0, 0}})});
  State<double> x(model);
  x.q = {0.3, 1};
  x.qd = {2, 3};
  const Eigen::MatrixXd M = mass_matrix(model, x);
  const double Jp = J + m * l * l;
  CHECK(equal(M(0, 0), J0 + m * L * L + Jp * std::pow(std::sin(1), 2)));
  CHECK(equal(M(0, 1), m * L * l * std::cos(1)));
  CHECK(equal(M(1, 1), Jp));
  const std::vector<double> qdd = qdd_of(model, x);
  CHECK(equal(qdd[0], 5.9332037721307034));
  CHECK(equal(qdd[1], -44.264142470077606));
}
