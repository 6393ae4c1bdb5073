// Mimic joints: saddle-point system of M and A, closed forms, no net work.
#include <doctest/doctest.h>

#include <string>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/model_builder.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/constrained_dynamics.h"
#include "solver/model/mimic.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/solver/linear_algebra/friction_oracle.h"
#include "tests/support/eigen_vectors.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A tree of six revolute and prismatic joints; joint 3 mimics 1, 5 mimics 2, 6 mimics 5 (hence 2).
Model<double> tree(Random& random, double friction) {
  ModelBuilder builder;
  for (int i = 1; i <= 6; ++i) {
    JointProperties p;
    p.damping = random.uniform(0, friction);
    p.coulomb_plus = random.uniform(0, 3 * friction);
    p.coulomb_minus = random.uniform(0, 3 * friction);
    builder.add_body(
        "body" + std::to_string(i), random.integer(std::max(0, i - 3), i - 1),
        "joint" + std::to_string(i), i % 3 == 2 ? JointType::prismatic : JointType::revolute,
        {random.rotation(), random.vector(0.5)}, random.vector(1), random.inertia(), p);
  }
  builder.add_mimic("joint3", "joint1", random.uniform(-2, 2), 0.3);
  builder.add_mimic("joint6", "joint5", random.uniform(-2, 2), -0.1);
  builder.add_mimic("joint5", "joint2", random.uniform(-2, 2), 0.2);
  return builder.build();
}
State<double> state_of(Random& random, const Model<double>& model) {
  State<double> x = random_state(random, model);
  apply_mimics(model, x);
  return x;
}
struct Dense {
  MatrixXd M, A;
  VectorXd h;
  Dense(const Model<double>& model, const State<double>& x) {
    Workspace<double> w(model);
    M = mass_matrix(model, x);
    rnea(model, x, std::vector<double>(model.nv), Forces<double>(model).f_ext, w);
    h = vector_of(w.tau);
    A = MatrixXd::Zero(index(model.mimics.size()), index(model.nv));
    for (std::size_t j = 0; j < model.mimics.size(); ++j) {
      A(index(j), index(model.mimics[j].follower)) = 1;
      A(index(j), index(model.mimics[j].leader)) = -model.mimics[j].ratio;
    }
  }
};

}  // namespace

TEST_CASE("mimics: accelerations and forces solve the saddle-point system of M and A") {
  Random random(31);
  for (int trial = 0; trial < 50; ++trial) {
    const Model<double> model = tree(random, 0);
    const State<double> x = state_of(random, model);
    Forces<double> forces(model);
    forces.clear();
    for (double& tau : forces.tau) tau = random.uniform(-5, 5);
    const Dense dense(model, x);
    const Eigen::Index n = dense.M.rows(), m = dense.A.rows();
    MatrixXd K = MatrixXd::Zero(n + m, n + m);
    K << dense.M, -dense.A.transpose(), dense.A, MatrixXd::Zero(m, m);
    VectorXd right = VectorXd::Zero(n + m);
    right.head(n) = vector_of(forces.tau) - dense.h;
    const VectorXd solution = solve_pivoted(K, right);

    ForwardDynamics dynamics(model);
    Workspace<double> w(model), plain(model);
    dynamics(x, forces, w);
    const double scale = 1 + largest(solution);
    CHECK(largest(vector_of(w.qdd) - solution.head(n)) < 1e-11 * scale);
    CHECK(largest(vector_of(dynamics.torques().mimic) - dense.A.transpose() * solution.tail(m)) <
          1e-11 * scale);
    rnea(model, x, w.qdd, forces.f_ext, plain);
    for (std::size_t i = 1; i < model.parent.size(); ++i) {
      CHECK((to_eigen(w.a[i].w) - to_eigen(plain.a[i].w)).norm() < 1e-11 * scale);
      CHECK((to_eigen(w.a[i].v) - to_eigen(plain.a[i].v)).norm() < 1e-11 * scale);
    }

    // The same in independent velocities.
    const MatrixXd G = mimic_projection(model);
    CHECK((dense.A * G).norm() < 1e-15);
    CHECK(largest(vector_of(x.qd) - G * vector_of(x.qd)(independent_dofs(model))) < 1e-15);
    const VectorXd ydd = solve_symmetric(G.transpose() * dense.M * G,
                                         G.transpose() * (vector_of(forces.tau) - dense.h));
    CHECK(largest(vector_of(w.qdd) - G * ydd) < 1e-11 * scale);
  }
}

TEST_CASE("friction of mimic joints acts on the independent joint through the ratio") {
  Random random(32);
  int stuck = 0, slipping = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Model<double> model = tree(random, 2);
    State<double> x = state_of(random, model);
    for (double& qd : x.qd)
      if (random.uniform(0, 1) < 0.7) qd = 0;
    apply_mimics(model, x);
    Forces<double> forces(model);
    forces.clear();
    for (double& tau : forces.tau) tau = random.uniform(-15, 15);
    const double h = trial % 2 ? random.uniform(0.01, 0.3) : 0;

    // In independent velocities y: limits of a mimic group are summed.
    const Dense dense(model, x);
    const MatrixXd G = mimic_projection(model);
    const VectorXd b = vector_of(model.damping), v = vector_of(x.qd);
    const VectorXd y = v(independent_dofs(model));
    VectorXd low = VectorXd::Zero(G.cols()), high = low;
    for (Eigen::Index c = 0; c < G.cols(); ++c)
      for (Eigen::Index d = 0; d < G.rows(); ++d) {
        const double plus = model.coulomb_plus[static_cast<std::size_t>(d)];
        const double minus = model.coulomb_minus[static_cast<std::size_t>(d)], r = G(d, c);
        low[c] -= r > 0 ? r * plus : -r * minus;
        high[c] += r > 0 ? r * minus : -r * plus;
      }
    MatrixXd M = dense.M;
    M += (h * b).asDiagonal();
    const MatrixXd inverse = inverse_of(G.transpose() * M * G);
    const VectorXd a =
        inverse * G.transpose() * (vector_of(forces.tau) - dense.h - VectorXd(b.cwiseProduct(v)));
    VectorXd target = a;
    if (h > 0) target += y / h;
    for (Eigen::Index c = 0; c < y.size(); ++c)
      if (h == 0 && y[c] != 0) (y[c] > 0 ? high : low)[c] = y[c] > 0 ? low[c] : high[c];
    VectorXd shifted = target;
    std::vector<Eigen::Index> open;
    for (Eigen::Index c = 0; c < y.size(); ++c)
      if (h > 0 || y[c] == 0)
        open.push_back(c);
      else
        shifted += inverse.col(c) * low[c];
    const auto f_open =
        friction_by_enumeration(inverse(open, open), shifted(open), low(open), high(open));
    REQUIRE(f_open);
    VectorXd f = low;
    f(open) = *f_open;
    const VectorXd ydd = a + inverse * f;
    for (const Eigen::Index c : open)
      ++(std::abs(target[c] + inverse.row(c) * f) < 1e-9 ? stuck : slipping);

    ForwardDynamics dynamics(model);
    Workspace<double> w(model);
    using Rule = ForwardDynamics::FrictionRule;
    dynamics(x, forces, w, h > 0 ? Rule::end_of_step : Rule::current, h);
    const double scale = 1 + largest(a);
    CHECK(largest(vector_of(w.qdd) - G * ydd) < 1e-10 * scale);
    const VectorXd rubbing = vector_of(dynamics.torques().coulomb);
    CHECK(largest(G.transpose() * rubbing - f) < 1e-9 * scale);
    for (std::size_t d = 0; d < model.nv; ++d) {
      CHECK(rubbing[index(d)] <= model.coulomb_minus[d] + 1e-12);
      CHECK(rubbing[index(d)] >= -model.coulomb_plus[d] - 1e-12);
    }
    // Equation of motion with all forces.
    const VectorXd sum = vector_of(forces.tau) + rubbing + vector_of(dynamics.torques().damping) +
                         vector_of(dynamics.torques().mimic) - dense.h;
    CHECK(largest(dense.M * vector_of(w.qdd) - sum) < 1e-9 * (1 + largest(sum)));
  }
  CHECK(stuck > 100);
  CHECK(slipping > 100);
}

TEST_CASE("a rack and pinion under gravity falls as m g / (m + I r^2), by closed form") {
  constexpr double m = 2, I = 0.05, r = 3;  // angle = r x + 0.7
  ModelBuilder builder;
  builder.add_body("pinion", 0, "turn", JointType::revolute, {}, Vector3::UnitX(),
                   {1, Vector3::Zero(), I * Matrix3::Identity()});
  builder.add_body("rack", 0, "slide", JointType::prismatic, {}, -Vector3::UnitZ(),
                   {m, Vector3::Zero(), Matrix3::Identity()});
  builder.add_mimic("turn", "slide", r, 0.7);
  const Model<double> model = builder.build();
  const double a = m * 9.81 / (m + I * r * r);
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation simulation(model, State<double>(model));
    CHECK(simulation.state().q[0] == 0.7);
    simulation.set_integrator(facts.integrator);
    for (int n = 0; n < 100; ++n) {
      CHECK(simulation.step(0.01).ok());
      CHECK(simulation.state().q[0] == r * simulation.state().q[1] + 0.7);
      CHECK(simulation.state().qd[0] == r * simulation.state().qd[1]);
    }
    CHECK(simulation.state().qd[1] == doctest::Approx(a).epsilon(1e-12));
    CHECK(std::abs(simulation.state().q[1] - a / 2) < (facts.order > 1 ? 1e-12 : 0.06 * a));
    CHECK(simulation.mechanism().dynamics.torques().mimic[0] ==
          doctest::Approx(I * r * a).epsilon(1e-12));
    CHECK(simulation.mechanism().dynamics.torques().mimic[1] ==
          doctest::Approx(-I * r * r * a).epsilon(1e-12));
  }
}

TEST_CASE("mimic joints do no net work: energy of a tree constant to 1e-9 for 1 s (rk4, 0.2 ms)") {
  Random random(33);
  const Model<double> model = tree(random, 0);
  Simulation simulation(model, state_of(random, model));
  simulation.set_integrator(Integrator::rk4);
  const auto energy = [&] {
    return kinetic_energy(model, simulation.state()) + potential_energy(model, simulation.state());
  };
  const double start = energy();
  double scale = 1, worst = 0, force = 0;
  for (int n = 0; n < 5000; ++n) {
    simulation.step(2e-4);
    scale = std::max(scale, kinetic_energy(model, simulation.state()));
    worst = std::max(worst, std::abs(energy() - start));
    force = std::max(force, largest(vector_of(simulation.mechanism().dynamics.torques().mimic)));
  }
  CHECK(force > 1);
  CHECK(worst < 1e-9 * scale);
}
