// Friction of chains against enumeration of all modes; box LCP.
#include <doctest/doctest.h>

#include <string>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/model_builder.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/constrained_dynamics.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/solver/linear_algebra/friction_oracle.h"
#include "tests/support/eigen_vectors.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A chain of revolute and prismatic joints, all with friction.
Model<double> rubbing_chain(Random& random, int n) {
  ModelBuilder builder;
  for (int i = 1; i <= n; ++i) {
    JointProperties p;
    p.coulomb_plus = random.uniform(0, 8);
    p.coulomb_minus = random.uniform(0, 8);
    p.damping = random.uniform(0, 2);
    p.armature = i % 2 * 0.1;
    builder.add_body("body" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     i % 3 == 2 ? JointType::prismatic : JointType::revolute,
                     {random.rotation(), random.vector(0.5)}, random.vector(1), random.inertia(),
                     p);
  }
  return builder.build();
}
VectorXd bias(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  rnea(model, x, std::vector<double>(model.nv), Forces<double>(model).f_ext, w);
  return vector_of(w.tau);
}

}  // namespace

TEST_CASE("friction of chains with joints at rest agrees with enumeration of all 3^n modes") {
  Random random(21);
  int stuck = 0, slipping = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Model<double> model = rubbing_chain(random, 1 + trial % 4);
    const std::size_t n = model.nv;
    State<double> x = random_state(random, model);
    for (double& qd : x.qd)
      if (random.uniform(0, 1) < 0.7) qd = 0;
    Forces<double> forces(model);
    forces.clear();
    for (double& tau : forces.tau) tau = random.uniform(-15, 15);
    const std::vector<double> tau = forces.tau;
    const double h = trial % 2 ? random.uniform(0.01, 0.3) : 0;  // the end of a step, or now

    // M' v' = M' v + h (...) with M' = M + h b, in units of acceleration where h = 0.
    const VectorXd b = vector_of(model.damping), v = vector_of(x.qd);
    MatrixXd M = mass_matrix(model, x);
    M += (h * b).asDiagonal();
    const MatrixXd inverse = inverse_of(M);
    const VectorXd a_free =
        inverse * (vector_of(tau) - bias(model, x) - VectorXd(b.cwiseProduct(v)));
    VectorXd low = -vector_of(model.coulomb_plus), high = vector_of(model.coulomb_minus);
    if (h == 0)
      for (Eigen::Index i = 0; i < v.size(); ++i)
        if (v[i] != 0) (v[i] > 0 ? high : low)[i] = v[i] > 0 ? low[i] : high[i];
    VectorXd a = a_free;
    if (h > 0) a += v / h;
    // The friction of a moving dof does not depend on its acceleration: add it to a.
    std::vector<Eigen::Index> open;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (h > 0 || v[i] == 0)
        open.push_back(i);
      else
        a += inverse.col(i) * low[i];
    const auto f_open =
        friction_by_enumeration(inverse(open, open), a(open), low(open), high(open));
    REQUIRE(f_open);
    VectorXd f = low;
    f(open) = *f_open;
    const VectorXd qdd = a_free + inverse * f;

    ForwardDynamics dynamics(model);
    Workspace<double> w(model);
    using Rule = ForwardDynamics::FrictionRule;
    dynamics(x, forces, w, h > 0 ? Rule::end_of_step : Rule::current, h);
    const double scale = 1 + a_free.lpNorm<Eigen::Infinity>();
    CHECK((vector_of(w.qdd) - qdd).lpNorm<Eigen::Infinity>() < 1e-11 * scale);
    CHECK((vector_of(dynamics.torques().coulomb) - f).lpNorm<Eigen::Infinity>() < 1e-10 * scale);
    CHECK((vector_of(dynamics.torques().damping) + VectorXd(b.cwiseProduct(v + h * qdd)))
              .lpNorm<Eigen::Infinity>() < 1e-10 * scale);
    CHECK(forces.tau == tau);  // restored

    // The accelerations of the bodies are those of the true qdd.
    Workspace<double> plain(model);
    rnea(model, x, w.qdd, forces.f_ext, plain);
    for (std::size_t i = 1; i <= n; ++i) {
      CHECK((to_eigen(w.a[i].w) - to_eigen(plain.a[i].w)).norm() < 1e-11 * scale);
      CHECK((to_eigen(w.a[i].v) - to_eigen(plain.a[i].v)).norm() < 1e-11 * scale);
    }
    for (const Eigen::Index i : open)
      ++(std::abs(a[i] + inverse.row(i) * f) < 1e-9 ? stuck : slipping);

    dynamics.set_friction(false);
    dynamics(x, forces, w);
    const VectorXd frictionless =
        solve_symmetric(mass_matrix(model, x), vector_of(tau) - bias(model, x));
    CHECK((vector_of(w.qdd) - frictionless).lpNorm<Eigen::Infinity>() <
          1e-11 * (scale + frictionless.norm()));
  }
  CHECK(stuck > 100);
  CHECK(slipping > 100);
}

TEST_CASE("box LCP: pivoting satisfies all conditions up to 40 dofs, Gauss-Seidel agrees") {
  Random random(22);
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<std::size_t>(random.integer(1, 40));
    const MatrixXd L =
        MatrixXd::NullaryExpr(index(n), index(n), [&] { return random.uniform(-1, 1); });
    const MatrixXd B = L * L.transpose() + 0.1 * MatrixXd::Identity(index(n), index(n));
    BoxLcp box(n);
    for (std::size_t i = 0; i < n; ++i) {
      box.rows.push_back({random.uniform(-5, 5), -random.uniform(0, 1), random.uniform(0, 1)});
      for (std::size_t j = 0; j < n; ++j) box.B(i, j) = B(index(i), index(j));
    }
    CHECK(box.solve());
    VectorXd f(index(n));
    for (std::size_t i = 0; i < n; ++i) f[index(i)] = box.rows[i].f;
    for (std::size_t i = 0; i < n; ++i) {
      const double v = box.rows[i].a + B.row(index(i)) * f;
      CHECK(box.rows[i].f >= box.rows[i].low);
      CHECK(box.rows[i].f <= box.rows[i].high);
      if (v > 1e-10) CHECK(box.rows[i].f == box.rows[i].low);
      if (v < -1e-10) CHECK(box.rows[i].f == box.rows[i].high);
    }
    for (auto& row : box.rows) row.f = 0;
    box.solve_by_gauss_seidel();
    for (std::size_t i = 0; i < n; ++i) CHECK(std::abs(box.rows[i].f - f[index(i)]) < 1e-9);
  }
}

TEST_CASE("rk4 with events and dopri5 agree on a chain with friction to 1e-9") {
  Random random(23);
  for (int trial = 0; trial < 5; ++trial) {
    const Model<double> model = rubbing_chain(random, 4);
    const State<double> start = random_state(random, model);
    const auto end = [&](Integrator integrator, double h, int steps) {
      Simulation simulation(model, start);
      simulation.set_integrator(integrator, 1e-11);
      for (int n = 0; n < steps; ++n) CHECK(simulation.step(h).ok());
      return simulation.state();
    };
    const State<double> a = end(Integrator::rk4, 2e-4, 5000), b = end(Integrator::dopri5, 1, 1),
                        c = end(Integrator::semi_implicit, 2e-5, 50000);
    for (std::size_t i = 0; i < model.nq; ++i) {
      CHECK(std::abs(a.q[i] - b.q[i]) < 1e-9);
      CHECK(std::abs(c.q[i] - b.q[i]) < 2e-4);
    }
  }
}
