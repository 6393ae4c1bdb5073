// Couplings and constraints refer to the right bodies, points and frames.
#include <Eigen/Geometry>

#include "app/scene/forces/scene_couplings.h"
#include "coupling/analysis/prediction.h"
#include "solver/stepping/simulation.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

const std::string kTwoArms =
    "[[robot]]\nname = 'left'\nmodel = 'robots/findings_set1/findings_set1.urdf'\n"
    "q = { joint1 = 0.4 }\n"
    "[[robot]]\nname = 'right'\nmodel = 'robots/findings_set1/findings_set1.urdf'\n"
    "position = [0, 2, 0]\n"
    "[[body]]\nname = 'ball'\nmass = 1\nshape.sphere.radius = 0.1\nposition = [1, 2, 3]\n"
    "orientation = [0.6, 0, 0.8, 0]\n";

TEST_CASE("scene: constraints are satisfied at the start, at the given point and axis") {
  const SceneModel scene = built(
      kTwoArms +
      "[[constraint]]\nname = 'pin'\ntype = 'hinge'\na = 'left/arm2'\nb = 'ball'\n"
      "point = [0.5, 0.25, 0]\naxis = [0, 3, 4]\n"
      "[[constraint]]\nname = 'rope'\ntype = 'distance'\na = 'ball'\nb = 'world'\n"
      "point = [1, 2, 7]\n"
      "[[constraint]]\nname = 'glue'\ntype = 'weld'\na = 'world'\nb = 'right/arm1'\n"
      "[[constraint]]\nname = 'rod'\ntype = 'distance'\na = 'left/arm1'\nb = 'ball'\n"
      "point = [0, 0, 0]\npoint_b = [0, 3, 4]\n"
      "[[constraint]]\nname = 'wheels'\ntype = 'gear'\na = 'left/joint1'\nb = 'right/joint2'\n"
      "ratio = -2\n");
  Kinematics k(scene.model);
  forward_kinematics(scene.model, scene.start, k);
  REQUIRE(scene.constraints.size() == 5);
  const auto in_world = [&](int body, const Pose& X) {
    return k.X_WL[static_cast<std::size_t>(body)] * X;
  };
  const SceneConstraint& pin = scene.constraints[0];
  CHECK(pin.a == scene.model.find_body("left/arm2"));
  CHECK(pin.b == scene.model.find_body("ball"));
  const Pose X_WC = in_world(pin.a, pin.X_AC);
  CHECK(close(X_WC.p, Vector3(0.5, 0.25, 0)));
  CHECK(close(Vector3(X_WC.R.col(2)), Vector3(0, 0.6, 0.8)));
  CHECK(close(in_world(pin.b, pin.X_BC).p, X_WC.p));
  CHECK(close(in_world(pin.b, pin.X_BC).R, X_WC.R));

  const SceneConstraint& rope = scene.constraints[1];
  CHECK(rope.length == doctest::Approx(4));
  CHECK(close(in_world(rope.a, rope.X_AC).p, Vector3(1, 2, 3)));
  CHECK(close(in_world(rope.b, rope.X_BC).p, Vector3(1, 2, 7)));

  const SceneConstraint& glue = scene.constraints[2];
  CHECK(glue.a == 0);
  CHECK(close(in_world(glue.a, glue.X_AC).R, in_world(glue.b, glue.X_BC).R));

  CHECK(scene.constraints[3].length == doctest::Approx(5));

  const SceneConstraint& wheels = scene.constraints[4];
  CHECK(wheels.a == scene.model.find_joint("left/joint1"));
  CHECK(wheels.b == scene.model.find_joint("right/joint2"));
  CHECK(wheels.ratio == -2);
  CHECK(wheels.offset == doctest::Approx(0.4).epsilon(1e-15));  // q_a = 0.4, q_b = 0
}

TEST_CASE("scene: a distance starts at origins; a single point belongs to the fixed body") {
  const std::string hook = kTwoArms +
                           "[[body]]\nname = 'hook'\nfixed = true\nposition = [0, 0, 9]\n"
                           "shape.sphere.radius = 0.1\n[[constraint]]\ntype = 'distance'\n";
  const auto length = [&](const std::string& more) {
    return built(hook + more).constraints[0].length;
  };
  const Vector3 ball(1, 2, 3);
  CHECK(length("a = 'ball'\nb = 'hook'\n") ==
        doctest::Approx((Vector3(0, 0, 9) - ball).norm()).epsilon(1e-15));
  CHECK(length("a = 'ball'\nb = 'world'\n") == doctest::Approx(ball.norm()).epsilon(1e-15));
  CHECK(length("a = 'ball'\nb = 'hook'\npoint = [1, 2, 8]\n") == doctest::Approx(5));
  CHECK(length("a = 'hook'\nb = 'ball'\npoint = [1, 2, 8]\n") == doctest::Approx(5));
  CHECK(length("a = 'ball'\nb = 'left/base'\npoint = [3, 4, 0]\n") == doctest::Approx(5));
}

TEST_CASE("scene: a coupling without target acts towards the start") {
  SceneModel scene =
      built(kTwoArms +
            "[[coupling]]\nname = 'pull'\ntype = 'linear'\nrobot = 'left'\nlink = 'arm1'\n"
            "point = [0.2, 0, 0]\nstiffness = 300\ndamping = 7\n");
  REQUIRE(scene.couplings.size() == 1);
  const SceneCoupling& pull = scene.couplings[0];
  CHECK(pull.spring.body == scene.model.find_body("left/arm1"));
  CHECK(pull.discretization == Discretization::implicit);
  CHECK(pull.driven.turned.empty());

  SceneCouplings couplings(scene, 0.001);
  Kinematics k(scene.model);
  State<double> x = scene.start;
  // Turned on by 0.1: the force at the point is k times the chord, against the motion.
  x.q[scene.model.iq[static_cast<std::size_t>(scene.model.find_joint("left/joint1"))]] += 0.1;
  forward_kinematics(scene.model, x, k);
  const TargetSample& target = couplings.target(0, 0.0);
  const Vector3 chord = target.k.position(pull.spring.body, pull.spring.p_L) -
                        k.position(pull.spring.body, pull.spring.p_L);
  CHECK(chord.norm() == doctest::Approx(2 * 0.2 * std::sin(0.05)).epsilon(1e-12));
  couplings.source(0)->begin_step(k, 0, 0.001);
  Forces<double> forces(scene.model);
  couplings.source(0)->add_forces(x, k, forces);
  CHECK(close(couplings.coupling(0).readings()[0].force_W, 300 * chord, 1e-12));
}

TEST_CASE("scene: targets are a state, the paper's motion, a trace") {
  const TemporaryFolder folder;
  folder.write("hand.csv",
               "t[s],theta1[rad],theta2[rad],theta3[rad],theta4[rad],theta5[rad],theta6[rad]\n"
               "0,0.1,0,0,0.3,0,0\n1,0.2,0,0,0.5,0,0\n");
  const std::string head =
      "[[robot]]\nname = 'r'\nmodel = 'robots/s103/s103.urdf'\nq = { gripper_lift = 0.02 }\n"
      "collide = false\n";
  const std::string pull =
      "[[coupling]]\ntype = 'torsional'\nmeasure = 'joint'\nlink = 'arm1'\nstiffness = 10\n";
  const auto good =
      folder.write("good.toml", head + pull + "target = { q = { joint1 = 0.7 } }\n" + pull +
                                    "target = 'paper'\n" + pull + "target = 'hand.csv'\n");
  SceneModel scene = build_scene(read_scene(good));
  SceneCouplings couplings(scene, 0.001);
  const auto q = [&](const State<double>& x, const char* joint) {
    return x.q[scene.model.iq[static_cast<std::size_t>(scene.model.find_joint(joint))]];
  };
  CHECK(q(couplings.target(0, 0.5).x, "joint1") == 0.7);
  CHECK(q(couplings.target(0, 0.5).x, "gripper_lift") == 0.02);
  // The paper: joint 1 from 90 to -90 degrees in a second, joint 2 from -45 to 45.
  CHECK(q(couplings.target(1, 0.25).x, "joint1") == doctest::Approx(0.785398163397448));
  CHECK(q(couplings.target(1, 0.25).x, "joint2") == doctest::Approx(-0.392699081698724));
  CHECK(q(couplings.target(1, 0.25).x, "gripper_lift") == 0.02);
  // theta1 with gain 2, theta4 with gain 1.
  CHECK(q(couplings.target(2, 0.5).x, "joint1") == doctest::Approx(0.3));
  CHECK(q(couplings.target(2, 0.5).x, "joint2") == doctest::Approx(0.4));
}

TEST_CASE("scene: synthetic operators that differ in the range of speeds alone move apart") {
  const auto pull = [](const std::string& range) {
    return "[[coupling]]\ntype = 'torsional'\nmeasure = 'joint'\nlink = 'arm1'\nstiffness = 10\n"
           "target = { seed = 1, peak_speed = " +
           range + " }\n";
  };
  SceneModel scene =
      built("[[robot]]\nname = 'r'\nmodel = 'robots/findings_set0/findings_set0.urdf'\n" +
            pull("[1, 1.1]") + pull("[3, 3.1]") + pull("[1, 1.1]"));
  SceneCouplings couplings(scene, 0.001);
  const auto q = [&](std::size_t c) { return couplings.target(c, 0.5).x.q; };
  const std::vector<double> slow = q(0), fast = q(1);
  CHECK(slow != fast);
  CHECK(q(2) == slow);
}

TEST_CASE("scene: a target with delay and speed is the motion at speed (t - delay)") {
  const double delay = 0.12345, speed = 1.7;  // no number of steps of 1 ms
  SceneModel scene = built(
      "[[robot]]\nname = 'r'\nmodel = 'robots/findings_set0/findings_set0.urdf'\n[[coupling]]\n"
      "type = 'torsional'\nmeasure = 'joint'\nlink = 'arm1'\nstiffness = 10\ndamping = 1\n"
      "discretization = 'explicit'\ntarget = 'paper'\ndelay = 0.12345\nspeed = 1.7\n");
  using Side = SceneCouplings::Side;
  const double pi = 3.14159265358979323846;
  SceneCouplings couplings(scene, 0.001);
  const auto at = [&](double t, Side side = Side::after) {
    const State<double>& x = couplings.target(0, t, side).x;
    return std::pair{x.q[0], x.qd[0]};
  };
  for (const double t : {0.0, 0.05, 0.12}) {  // not seen yet: at the start, at rest
    CHECK(at(t).first == doctest::Approx(pi / 2));
    CHECK(at(t).second == 0);
  }
  for (const double t : {0.13, 0.4, 0.7}) {  // the first sweep, from pi/2 at -pi rad/s
    CHECK(at(t).first == doctest::Approx(pi / 2 - pi * speed * (t - delay)).epsilon(1e-12));
    CHECK(at(t).second == doctest::Approx(-pi * speed).epsilon(1e-12));
  }
  // The corners: where it begins to move, and where it turns back.
  CHECK(at(delay, Side::before).second == 0);
  CHECK(at(delay, Side::after).second == doctest::Approx(-pi * speed));
  CHECK(at(delay + 1 / speed, Side::before).second == doctest::Approx(-pi * speed));
  CHECK(at(delay + 1 / speed, Side::after).second == doctest::Approx(pi * speed));
  CHECK(at(9).first == doctest::Approx(-pi / 2));  // three sweeps, and it is over
  CHECK(at(9).second == 0);

  // The force is k (q_K - q_D) + b (qd_K - qd_D) with the delayed target.
  Kinematics k(scene.model);
  State<double> x = scene.start;
  x.t = 0.4;
  forward_kinematics(scene.model, x, k);
  couplings.source(0)->begin_step(k, x.t, 0.001);
  Forces<double> forces(scene.model);
  couplings.source(0)->add_forces(x, k, forces);
  const double q_K = pi / 2 - pi * speed * (0.4 - delay);
  CHECK(couplings.coupling(0).readings()[0].size ==
        doctest::Approx(10 * (q_K - x.q[0]) - pi * speed).epsilon(1e-12));
}

TEST_CASE("scene: the target of a missing device is at rest at the robot's start") {
  const SceneModel scene = built(
      "[[robot]]\nname = 'r'\nmodel = 'robots/findings_set0/findings_set0.urdf'\n"
      "q = { joint1 = 0.7, joint2 = -0.3 }\n[[coupling]]\ntype = 'linear'\nlink = 'arm1'\n"
      "stiffness = 10\ntarget = 'device'\n");
  SceneCouplings couplings(scene, 0.001);
  for (const double t : {0.0, 0.5, 3.0}) {
    const TargetSample& kvr = couplings.target(0, t);
    CHECK(kvr.x.q[0] == doctest::Approx(0.7).epsilon(1e-14));
    CHECK(kvr.x.q[1] == doctest::Approx(-0.3).epsilon(1e-14));
    CHECK(kvr.x.qd[0] == 0);
  }
}

TEST_CASE(
    "scene: an absolute damper acts on the link's velocity, a relative one on the velocity error") {
  for (const bool absolute : {false, true}) {
    SceneModel scene = built(
        "gravity = [0, 0, 0]\n[[robot]]\nname = 'r'\n"
        "model = 'robots/findings_set0/findings_set0.urdf'\nq = { joint1 = 1.5707963267948966 }\n"
        "[[coupling]]\ntype = 'torsional'\nmeasure = 'joint'\nlink = 'arm1'\nstiffness = 0\n"
        "damping = 5\ntarget = 'paper'\ndiscretization = 'explicit'\ndamper = '" +
        std::string(absolute ? "absolute" : "relative") + "'\n");
    SceneCouplings couplings(scene, 0.001);
    Kinematics k(scene.model);
    forward_kinematics(scene.model, scene.start, k);
    couplings.source(0)->begin_step(k, 0.25, 0.001);
    State<double> x = scene.start;
    x.t = 0.25;
    Forces<double> forces(scene.model);
    couplings.source(0)->add_forces(x, k, forces);
    const double wanted = absolute ? 0 : -5 * 3.14159265358979;  // the target turns at -pi rad/s
    CHECK(couplings.coupling(0).readings()[0].size == doctest::Approx(wanted));
  }
}

}  // namespace
}  // namespace twinarm
