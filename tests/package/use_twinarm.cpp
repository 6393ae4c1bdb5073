// Every library of the installed package, each against a closed form: use_twinarm ROD.urdf
#include <cmath>
#include <cstdio>
#include <numbers>

#include "collision/detection/collision_world.h"
#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "coupling/laws/coupling_spec.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace {

using namespace twinarm;

constexpr double kG = 9.81;
int failed = 0;

void check(const char* sentence, double got, double expected) {
  const bool holds = std::abs(got - expected) <= 1e-12 * (1 + std::abs(expected));
  std::printf("%s: %s: %.15g, expected %.15g\n", holds ? "pass" : "FAIL", sentence, got, expected);
  failed += !holds;
}

// Two rods that hang down -z and turn about x, the second from the end of the first.
void double_pendulum() {
  constexpr double m1 = 1.3, m2 = 0.7, l1 = 0.8, c1 = 0.45, c2 = 0.3, I1 = 0.05, I2 = 0.02;
  const auto rod = [](double m, double c, double I) {
    return BodyInertia{m, {0, 0, -c}, Vector3(I, I, 1e-3).asDiagonal().toDenseMatrix()};
  };
  ModelBuilder builder;
  const Vector3 x_axis = Vector3::UnitX();
  const int upper =
      builder.add_body("upper", 0, "shoulder", JointType::revolute, {}, x_axis, rod(m1, c1, I1));
  const Pose elbow{Matrix3::Identity(), {0, 0, -l1}};
  builder.add_body("lower", upper, "elbow", JointType::revolute, elbow, x_axis, rod(m2, c2, I2));
  const Model<double> model = builder.build();

  State<double> x(model);
  x.q = {0.4, -1.1};
  x.qd = {1.7, -0.6};
  Forces<double> forces(model);
  forces.tau = {0.9, -0.2};
  Workspace<double> w(model);
  aba(model, x, forces, w);

  // Lagrange's equations, solved by Cramer's rule.
  const double q1 = x.q[0], q2 = x.q[1], s = m2 * l1 * c2 * std::sin(q2), c = std::cos(q2);
  const double M11 = I1 + m1 * c1 * c1 + I2 + m2 * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * c);
  const double M12 = I2 + m2 * (c2 * c2 + l1 * c2 * c), M22 = I2 + m2 * c2 * c2;
  const double b1 = forces.tau[0] + s * (2 * x.qd[0] + x.qd[1]) * x.qd[1] -
                    kG * ((m1 * c1 + m2 * l1) * std::sin(q1) + m2 * c2 * std::sin(q1 + q2));
  const double b2 = forces.tau[1] - s * x.qd[0] * x.qd[0] - kG * m2 * c2 * std::sin(q1 + q2);
  const double det = M11 * M22 - M12 * M12;
  check("the shoulder accelerates as Lagrange says", w.qdd[0], (M22 * b1 - M12 * b2) / det);
  check("the elbow accelerates as Lagrange says", w.qdd[1], (M11 * b2 - M12 * b1) / det);
}

void ball_on_a_floor() {
  CollisionWorld world;
  world.add({"floor", HalfSpace{}, 0});
  world.add({"ball", Sphere{0.1}, 1});
  const std::vector<Pose> X_WG{{}, {Matrix3::Identity(), {0.3, 0, 0.07}}};
  std::vector<Contact> contacts;
  world.detect(X_WG, 1e-3, contacts);
  check("a ball in a floor has one contact", static_cast<double>(contacts.size()), 1);
  check("it is as deep as the ball", contacts.at(0).depth, 0.03);
  check("it pushes up", contacts.at(0).n_W.z(), 1);
}

// The hand of a kinematic robot that stands still.
struct StillHand final : OperatorMotion {
  OperatorSample sample(double, double) const override { return {}; }
  double duration() const override { return 1; }
  std::string description() const override { return "still"; }
};

void rod_under_a_spring(const char* urdf) {
  constexpr double m = 2, l = 0.6, I = m * l * l / 3, k = 50, h = 1e-3;
  const Model<double> model = build_model(read_urdf(urdf));
  State<double> target(model), start(model);
  target.q[0] = std::numbers::pi / 2;  // the twin lies along y
  const StillHand hand;
  TargetRobot twin(model, hand, {}, {});
  twin.set_pose(target);
  const int rod = model.find_body("rod");
  CouplingSpec spec{.name = "pull", .type = CouplingSpec::Type::linear};
  spec.springs = {{"tip", rod, {0, 0, -l}, k, 0}};
  const auto coupling = make_coupling(spec, model, twin);

  Simulation simulation(model, start);
  simulation.add(*coupling);
  simulation.step(h);
  check("the spring pulls to the twin", coupling->readings().at(0).force_W.y(), k * l);
  check("and up", coupling->readings().at(0).force_W.z(), k * l);
  check("the rod follows", simulation.state().qd[0], h * k * l * l / I);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: use_twinarm ROD.urdf\n", stderr), 2;
  int unused_by_the_user;  // -Wall warns of it, and no more
  double_pendulum();
  ball_on_a_floor();
  rod_under_a_spring(argv[1]);
  return failed == 0 ? 0 : 1;
}
