// Accelerations and forces with loops: the saddle-point system of M and A, reactions in closed
// form, friction of joints coupled by loops.
#include <doctest/doctest.h>

#include <string>

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/model/mimic.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/support/eigen_vectors.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A mechanism with loops in a state: result of ForwardDynamics, and the dense solution.
struct Both {
  ForwardDynamics dynamics;
  Workspace<double> w;
  Kinematics k;
  MatrixXd M, A;  // rows of mimics, then of loops
  VectorXd h, gamma;
  Both(const Model<double>& model, const std::vector<LoopClosure>& closures, const State<double>& x)
      : dynamics(model), w(model), k(model) {
    dynamics.bilateral().set_loops(LoopClosures(model, closures));
    forward_kinematics(model, x, k);
    LoopClosures& loops = dynamics.bilateral().loops();
    loops.evaluate(x, k);
    Workspace<double> dense(model);
    const auto n = static_cast<Index>(model.nv), mimics = static_cast<Index>(model.mimics.size());
    M = mass_matrix(model, x);
    rnea(model, x, std::vector<double>(model.nv), Forces<double>(model).f_ext, dense);
    h = vector_of(dense.tau);
    A = MatrixXd::Zero(mimics + loops.J().rows(), n);
    for (Index j = 0; j < mimics; ++j) {
      const Mimic& m = model.mimics[static_cast<std::size_t>(j)];
      A(j, static_cast<Index>(m.follower)) = 1;
      A(j, static_cast<Index>(m.leader)) = -m.ratio;
    }
    A.bottomRows(loops.J().rows()) = loops.J();
    gamma = VectorXd::Zero(A.rows());
    gamma.tail(loops.J().rows()) = loops.gamma();
  }
  // (qdd; lambda) of minimum norm.
  VectorXd solve(const VectorXd& tau) const {
    const Index n = M.rows(), m = A.rows();
    MatrixXd K = MatrixXd::Zero(n + m, n + m);
    K.topLeftCorner(n, n) = M;
    K.topRightCorner(n, m) = -A.transpose();
    K.bottomLeftCorner(m, n) = A;
    VectorXd right(n + m);
    right << tau - h, -gamma;
    return min_solution(K, right, 1e-10);
  }
};

LoopCase rubbing_slider_crank(double on_crank, double on_slide) {
  LoopCase c = slider_crank();
  c.model.coulomb_plus = c.model.coulomb_minus = {on_crank, 0, on_slide};
  return c;
}

}  // namespace

TEST_CASE(
    "loops: accelerations and forces solve the saddle-point system, redundant rows included") {
  Random random(61);
  for (int trial = 0; trial < 60; ++trial) {
    ModelBuilder builder;
    for (int i = 1; i <= 9; ++i) {
      const JointType type = i == 1       ? JointType::free
                             : i % 4 == 0 ? JointType::spherical
                             : i % 4 == 1 ? JointType::prismatic
                                          : JointType::revolute;
      builder.add_body("body" + std::to_string(i),
                       i == 1 ? 0 : random.integer(std::max(1, i - 3), i - 1),
                       "joint" + std::to_string(i), type, {random.rotation(), random.vector(0.5)},
                       random.vector(1), random.inertia());
    }
    builder.add_mimic("joint6", "joint3", random.uniform(-2, 2), 0.1);
    const Model<double> model = builder.build();
    State<double> x = random_state(random, model);
    apply_mimics(model, x);
    const Pose A{random.rotation(), random.vector(0.5)}, B{random.rotation(), random.vector(0.5)};
    std::vector<LoopClosure> loops{{"hinge", LoopType::hinge, 9, 0, A, B},
                                   {"rod", LoopType::distance, 8, 0, A, B},
                                   {"gear", LoopType::gear, 2, 3}};
    loops[1].length = 1;
    loops[2].ratio = 0.7;
    if (trial % 2) loops.push_back({"ball", LoopType::ball, 9, 0, A, B});  // redundant
    const bool geared_again = trial % 3 == 0;  // redundant with the mimic
    if (geared_again) {
      loops.push_back({"again", LoopType::gear, 6, 3});
      loops.back().ratio = model.mimics[0].ratio;
    }

    Both both(model, loops, x);
    Forces<double> forces(model);
    forces.clear();
    for (double& tau : forces.tau) tau = random.uniform(-5, 5);
    both.dynamics(x, forces, both.w);
    const VectorXd dense = both.solve(vector_of(forces.tau));
    const Index n = both.M.rows(), m = both.A.rows() - 1;
    const double scale = 1 + largest(dense);
    CHECK(largest(vector_of(both.w.qdd) - dense.head(n)) < 1e-9 * scale);
    CHECK(largest(both.A * vector_of(both.w.qdd) + both.gamma) < 1e-9 * scale);
    if (geared_again) continue;  // the forces of the two are not unique
    CHECK(largest(vector_of(both.dynamics.torques().loop) -
                  both.A.bottomRows(m).transpose() * dense.tail(m)) < 1e-8 * scale);
    CHECK(largest(both.dynamics.bilateral().lambda_of_loops() - dense.tail(m)) < 1e-7 * scale);
    // Body accelerations consistent with qdd.
    Workspace<double> plain(model);
    rnea(model, x, both.w.qdd, forces.f_ext, plain);
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      CHECK((to_eigen(both.w.a[i].v) - to_eigen(plain.a[i].v)).norm() < 1e-9 * scale);
  }
}

TEST_CASE("loops: reactions of a hinged rod, m g / 4 when released, 5/2 m g at the bottom") {
  ModelBuilder builder;
  const BodyInertia rod{2, {0.5, 0, 0}, Vector3(0.01, 2 / 12.0, 2 / 12.0).asDiagonal()};
  builder.add_body("rod", 0, "free", JointType::free, {}, Vector3::UnitZ(), rod);
  const Model<double> model = builder.build();
  const Matrix3 z_along_y = (Matrix3() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
  const Pose C{z_along_y, Vector3::Zero()};
  const std::vector<LoopClosure> loops{{"pivot", LoopType::hinge, 1, 0, C, C}};
  State<double> x(model);
  Forces<double> none(model);
  none.clear();
  const auto wrench = [&] {
    Both both(model, loops, x);
    both.dynamics(x, none, both.w);
    return both.dynamics.bilateral().loops().wrench(0, both.dynamics.bilateral().lambda_of_loops());
  };
  LoopWrench on_rod = wrench();
  CHECK((on_rod.force - Vector3(0, 0, 2 * 9.81 / 4)).norm() < 1e-12);
  CHECK(on_rod.couple.norm() < 1e-12);
  const double r = std::sqrt(0.5);  // rotated by 90 degrees about y: along -z
  const double rate = std::sqrt(3 * 9.81);
  x.q = {0, 0, 0, r, 0, r, 0};
  x.qd = {0, rate, 0, 0, 0, 0};
  on_rod = wrench();
  CHECK((on_rod.force - Vector3(0, 0, 2 * 9.81 * 2.5)).norm() < 1e-10);
  CHECK(on_rod.couple.norm() < 1e-12);
}

TEST_CASE("loops: Andrews' mechanism starts with the published acceleration and forces") {
  const LoopCase c = squeezer();
  Both both(c.model, c.loops, c.start);
  Forces<double> forces(c.model);
  forces.clear();
  c.sources[0]->add_forces(c.start, both.k, forces);
  both.dynamics(c.start, forces, both.w);
  // Hairer and Wanner, Solving ODEs II, VII.7: beta'', Theta'', and lambda of the loop through K3.
  CHECK(std::abs(both.w.qdd[0] / 14222.4439199541139 - 1) < 1e-11);
  CHECK(std::abs(both.w.qdd[1] / -10666.8329399655854 - 1) < 1e-11);
  for (std::size_t d = 2; d < 7; ++d) CHECK(std::abs(both.w.qdd[d]) < 1e-7);
  const LoopWrench on_K2 =
      both.dynamics.bilateral().loops().wrench(0, both.dynamics.bilateral().lambda_of_loops());
  CHECK(on_K2.force.norm() == doctest::Approx(98.5668703962410896).epsilon(0.01));
  CHECK(both.dynamics.bilateral().rank() == 6);
}

TEST_CASE("loops: sliding friction of coupled joints acts through the loop") {
  for (const double direction : {1.0, -1.0}) {
    const LoopCase c = rubbing_slider_crank(0.3, 0.8);
    State<double> x = c.start;
    for (double& v : x.qd) v *= direction;
    x.q = {std::acos(-1.0) / 3, 0, 0.33722813232690142};
    x.q[1] = std::asin(-0.1 * std::sin(x.q[0]) / 0.3) - x.q[0];
    const double s = -0.1 * std::cos(x.q[0]) / (0.3 * std::cos(x.q[0] + x.q[1]));
    x.qd = {direction * 2, direction * 2 * (s - 1), 0};
    x.qd[2] =
        -0.1 * std::sin(x.q[0]) * x.qd[0] - 0.3 * std::sin(x.q[0] + x.q[1]) * (x.qd[0] + x.qd[1]);
    Both both(c.model, c.loops, x);
    CHECK(both.dynamics.bilateral().loops().rate().norm() < 1e-14);
    Forces<double> forces(c.model);
    forces.clear();
    const VectorXd friction{{-0.3 * direction, 0, 0.8 * direction}};  // the piston moves backward
    both.dynamics(x, forces, both.w);
    CHECK(largest(vector_of(both.w.qdd) - both.solve(friction).head(3)) < 1e-10);
    CHECK(largest(vector_of(both.dynamics.torques().coulomb) - friction) < 1e-15);
  }
}

TEST_CASE("loops: static friction of coupled joints holds up to its sum reflected to the crank") {
  const LoopCase c = rubbing_slider_crank(0.3, 0.8);
  State<double> x = c.start;
  const double q = std::acos(-1.0) / 3;
  x.q = {q, std::asin(-0.1 * std::sin(q) / 0.3) - q, 0.33722813232690142};
  x.qd = {0, 0, 0};
  // dx/dq of the piston, and the torque that balances gravity, by virtual work.
  const double s = -0.1 * std::cos(q) / (0.3 * std::cos(x.q[0] + x.q[1]));
  const double dx = -0.1 * std::sin(q) - 0.3 * std::sin(x.q[0] + x.q[1]) * s;
  const double weight = 9.81 * 0.1 * std::cos(q) * (1 * 0.5 + 2 * 0.5);  // rod: half the height
  const double most = 0.3 + 0.8 * std::abs(dx);
  for (const double part : {-1.02, -0.98, 0.0, 0.98, 1.02}) {
    CAPTURE(part);
    Both both(c.model, c.loops, x);
    Forces<double> forces(c.model);
    forces.clear();
    forces.tau[0] = weight + part * most;
    both.dynamics(x, forces, both.w);
    if (std::abs(part) < 1) {
      CHECK(largest(vector_of(both.w.qdd)) < 1e-8);
      continue;
    }
    VectorXd tau = vector_of(forces.tau);
    tau[0] -= 0.3 * (part > 0 ? 1 : -1);
    tau[2] -= 0.8 * (part > 0 ? 1 : -1) * (dx > 0 ? 1 : -1);
    CHECK(std::abs(both.w.qdd[0]) > 0.01);
    CHECK(largest(vector_of(both.w.qdd) - both.solve(tau).head(3)) < 1e-7);
  }
}

TEST_CASE("loops: a slider-crank with friction stops, does not creep, and remains closed") {
  for (const Integrator integrator :
       {Integrator::semi_implicit, Integrator::semi_implicit_xv, Integrator::rk4,
        Integrator::dopri5, Integrator::implicit_midpoint}) {
    CAPTURE(std::string(integrator_name(integrator)));
    const LoopCase c = rubbing_slider_crank(0.5, 4);
    Simulation simulation(c.model, c.start);
    simulation.set_loops(c.loops);
    simulation.set_integrator(integrator);
    double open = 0;
    for (int n = 0; n < 2000; ++n) open = std::max(open, simulation.step(2e-3).loop_position_error);
    CHECK(open < 1e-12);
    const std::vector<double> rest = simulation.state().q;
    CHECK(largest(vector_of(simulation.state().qd)) < 1e-20);
    for (int n = 0; n < 500; ++n) simulation.step(2e-3);
    CHECK(simulation.state().q[0] == rest[0]);
    CHECK(largest(vector_of(simulation.state().q) - vector_of(rest)) < 1e-13);
  }
}
