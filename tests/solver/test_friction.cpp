// Friction in joints: closed forms (docs/cases.md, B5, B6), and every stick or slip case tried.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <numbers>
#include <string>

#include "solver/dynamics.h"
#include "solver/forward_dynamics.h"
#include "solver/model_builder.h"
#include "solver/simulation.h"
#include "tests/solver/friction_oracle.h"
#include "tests/solver/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A mass that slides along an axis.
Model<double> slider(double mass, const Vector3& axis, const JointProperties& properties) {
  ModelBuilder builder;
  builder.add_body("block", 0, "slide", JointType::prismatic, {}, axis,
                   {mass, Vector3::Zero(), Matrix3::Identity()}, properties);
  return builder.build();
}
JointProperties coulomb(double plus, double minus) {
  JointProperties p;
  p.coulomb_plus = plus;
  p.coulomb_minus = minus;
  return p;
}
State<double> at(const Model<double>& model, double q, double qd) {
  State<double> x(model);
  x.q[0] = q;
  x.qd[0] = qd;
  return x;
}

template <class Law>
struct Push final : ForceSource {
  Law law;
  explicit Push(Law l) : law(l) {}
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.tau[0] += law(x);
  }
};

// A chain of hinges and slides, every dof with friction of its own.
Model<double> rubbing_chain(Random& random, int n) {
  ModelBuilder builder;
  for (int i = 1; i <= n; ++i) {
    JointProperties p = coulomb(random.uniform(0, 8), random.uniform(0, 8));
    p.damping = random.uniform(0, 2);
    p.armature = i % 2 * 0.1;
    builder.add_body("body" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     i % 3 == 2 ? JointType::prismatic : JointType::revolute,
                     {random.rotation(), random.vector(0.5)}, random.vector(1), random.inertia(),
                     p);
  }
  return builder.build();
}
template <class T>
VectorXd vector_of(const std::vector<T>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}
MatrixXd mass_matrix(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  crba(model, x, w);
  const auto n = static_cast<Eigen::Index>(model.nv);
  return Eigen::Map<const MatrixXd>(w.M.data(), n, n);
}
VectorXd bias(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  rnea(model, x, std::vector<double>(model.nv), Forces<double>(model).f_ext, w);
  return vector_of(w.tau);
}
constexpr Eigen::Index index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

}  // namespace

TEST_CASE("a block on an incline with a viscous slide meets the closed form to 1e-8 (rk4, 1 ms)") {
  JointProperties p;
  p.damping = 0.8;
  const double tilt = std::numbers::pi / 6;
  const Model<double> model = slider(2, {std::cos(tilt), 0, -std::sin(tilt)}, p);
  Simulation simulation(model, State<double>(model));
  simulation.set_integrator(Integrator::rk4);
  Forces<double> none(model);
  none.clear();
  Workspace<double> w(model);
  ForwardDynamics dynamics(model);
  dynamics(simulation.state(), none, w);
  CHECK(std::abs(w.qdd[0] - 4.905) < 1e-13);
  for (int n = 0; n < 2000; ++n) simulation.step(1e-3);
  CHECK(std::abs(simulation.state().qd[0] - 6.7526035775125702) < 1e-12);
  CHECK(std::abs(simulation.state().q[0] - 7.6434910562185744) < 1e-12);
}

TEST_CASE(
    "viscous friction under the semi-implicit methods: v' (1 + h b/m) = v + h g, at every h") {
  JointProperties p;
  p.damping = 5;
  const Model<double> model = slider(2, {0, 0, -1}, p);
  for (const Integrator integrator : {Integrator::semi_implicit, Integrator::semi_implicit_xv})
    for (const double h : {0.01, 10.0}) {
      Simulation simulation(model, at(model, 0, 3));
      simulation.set_integrator(integrator);
      double v = 3;
      for (int n = 0; n < 50; ++n) {
        simulation.step(h);
        v = (v + h * 9.81) / (1 + h * 5 / 2);
        CHECK(simulation.state().qd[0] == doctest::Approx(v).epsilon(1e-13));
        CHECK(simulation.dynamics().damping_torque()[0] == doctest::Approx(-5 * v).epsilon(1e-12));
      }
    }
}

TEST_CASE(
    "a spring against Coulomb friction turns at (-1)^n (0.097 - 0.01 n) and sticks at n = 10") {
  const Model<double> model = slider(1, Vector3::UnitX(), coulomb(0.5, 0.5));
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Push spring([](const State<double>& x) { return -100 * x.q[0]; });
    const bool crude =
        facts.integrator == Integrator::euler || facts.integrator == Integrator::implicit_euler;
    const long steps = facts.integrator == Integrator::dopri5 ? 1 : crude ? 31400 : 314;
    const double tolerance = crude ? 1e-4 : facts.order > 2 ? 1e-10 : 1e-6;
    const double h = std::numbers::pi / 10 / static_cast<double>(steps);  // 1 ms
    Simulation simulation(model, at(model, 0.097, 0));
    simulation.add(spring);
    simulation.set_integrator(facts.integrator);
    simulation.set_tolerance(1e-12);
    int failed = 0;
    for (int n = 1; n <= 10; ++n) {
      for (long s = 0; s < steps; ++s) failed += !simulation.step(h).ok();
      const double turning = (n % 2 ? -1 : 1) * (0.097 - 0.01 * n);
      CHECK(std::abs(simulation.state().q[0] - turning) < tolerance);
    }
    CHECK(failed == 0);
    for (int n = 0; n < 3; ++n) simulation.step(h);
    CHECK(simulation.state().qd[0] == 0);
    const double rest = simulation.state().q[0];
    for (int n = 0; n < 1000; ++n) simulation.step(h);
    CHECK(simulation.state().q[0] == rest);
    CHECK(std::abs(rest + 0.003) < tolerance);
  }
}

TEST_CASE("friction of chains, some joints at rest, is what trying all 3^n cases of M gives") {
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
    const MatrixXd inverse = M.inverse();
    const VectorXd a_free =
        inverse * (vector_of(tau) - bias(model, x) - VectorXd(b.cwiseProduct(v)));
    VectorXd low = -vector_of(model.coulomb_plus), high = vector_of(model.coulomb_minus);
    if (h == 0)
      for (Eigen::Index i = 0; i < v.size(); ++i)
        if (v[i] != 0) (v[i] > 0 ? high : low)[i] = v[i] > 0 ? low[i] : high[i];
    VectorXd a = a_free;
    if (h > 0) a += v / h;
    // A dof that moves now has one friction, whatever its acceleration: put it into a.
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
    h > 0 ? dynamics.over_step(x, h, forces, w) : dynamics(x, forces, w);
    const double scale = 1 + a_free.lpNorm<Eigen::Infinity>();
    CHECK((vector_of(w.qdd) - qdd).lpNorm<Eigen::Infinity>() < 1e-11 * scale);
    CHECK((vector_of(dynamics.coulomb_torque()) - f).lpNorm<Eigen::Infinity>() < 1e-10 * scale);
    CHECK((vector_of(dynamics.damping_torque()) + VectorXd(b.cwiseProduct(v + h * qdd)))
              .lpNorm<Eigen::Infinity>() < 1e-10 * scale);
    CHECK(forces.tau == tau);  // lent, and given back

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
        mass_matrix(model, x).ldlt().solve(vector_of(tau) - bias(model, x));
    CHECK((vector_of(w.qdd) - frictionless).lpNorm<Eigen::Infinity>() <
          1e-11 * (scale + frictionless.norm()));
  }
  CHECK(stuck > 100);
  CHECK(slipping > 100);
}

TEST_CASE("the box problem: pivoting meets all conditions up to 40 dofs, Gauss-Seidel agrees") {
  Random random(22);
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<std::size_t>(random.integer(1, 40));
    const MatrixXd L =
        MatrixXd::NullaryExpr(index(n), index(n), [&] { return random.uniform(-1, 1); });
    const MatrixXd B = L * L.transpose() + 0.1 * MatrixXd::Identity(index(n), index(n));
    BoxProblem box(n);
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

TEST_CASE("a block that friction can hold comes to rest on its incline and stays, to the bit") {
  const double tilt = 0.5, friction = 1.2 * 9.81 * std::sin(tilt);
  const Model<double> model =
      slider(1, {std::cos(tilt), 0, -std::sin(tilt)}, coulomb(friction, 0.1));
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation simulation(model, at(model, 0, 0.7));
    simulation.set_integrator(facts.integrator);
    const double slows = 0.2 * 9.81 * std::sin(tilt), stops = 0.7 / slows;
    while (simulation.state().t < stops + 0.01) CHECK(simulation.step(0.01).ok());
    const double rest = simulation.state().q[0];
    CHECK(std::abs(rest - 0.7 * 0.7 / 2 / slows) < (facts.order > 1 ? 1e-12 : 0.7 * 0.01));
    CHECK(simulation.state().qd[0] == 0);
    for (int n = 0; n < 1000; ++n) simulation.step(0.01);
    CHECK(simulation.state().q[0] == rest);
    CHECK(simulation.state().qd[0] == 0);
    CHECK(simulation.dynamics().coulomb_torque()[0] ==
          doctest::Approx(-9.81 * std::sin(tilt)).epsilon(1e-13));
  }
}

TEST_CASE("a block breaks loose when the push passes the limit of its direction, and not before") {
  const Model<double> model = slider(1, Vector3::UnitX(), coulomb(0.5, 0.25));
  for (const double sign : {1.0, -1.0})
    for (const IntegratorFacts& facts : all_integrators) {
      CAPTURE(std::string(facts.name));
      Push ramp([sign](const State<double>& x) { return sign * x.t; });
      Simulation simulation(model, State<double>(model));
      simulation.add(ramp);
      simulation.set_integrator(facts.integrator);
      const double limit = sign > 0 ? 0.5 : 0.25, h = 0.02 / 3;
      while (simulation.state().t < limit - h) {
        CHECK(simulation.step(h).ok());
        CHECK(simulation.state().q[0] == 0);
      }
      while (simulation.state().t < limit + 1) simulation.step(h);
      const double t = simulation.state().t - limit;
      const double tolerance = facts.order > 2 ? 1e-9 : facts.order == 2 ? 2e-5 : 1e-2;
      CHECK(std::abs(simulation.state().qd[0] - sign * t * t / 2) < tolerance);
      CHECK(std::abs(simulation.state().q[0] - sign * t * t * t / 6) < tolerance);
    }
}

TEST_CASE("a joint that sticks is a fixed joint to the rest of the arm") {
  const auto arm = [](JointType outer, double friction) {
    ModelBuilder builder;
    const BodyInertia rod{1, {0, 0, -0.5}, Vector3(1.0 / 12, 1.0 / 12, 0.01).asDiagonal()};
    builder.add_body("upper", 0, "first", JointType::revolute, {}, Vector3::UnitY(), rod);
    builder.add_body("lower", 1, "second", outer, {Matrix3::Identity(), {0.3, 0, -1}},
                     Vector3::UnitY(), rod, coulomb(friction, friction));
    return builder.build();
  };
  const Model<double> rubs = arm(JointType::revolute, 100), fixed = arm(JointType::fixed, 0);
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation a(rubs, at(rubs, 1, 0)), b(fixed, at(fixed, 1, 0));
    a.set_integrator(facts.integrator);
    b.set_integrator(facts.integrator);
    for (int n = 0; n < 300; ++n) {
      CHECK(a.step(0.005).ok());
      CHECK(b.step(0.005).ok());
    }
    CHECK(a.state().q[1] == 0);
    CHECK(a.state().qd[1] == 0);
    CHECK(std::abs(a.state().q[0] - b.state().q[0]) < 1e-8);
  }
}

TEST_CASE("rk4 with events and dopri5 agree on a rubbing chain to 1e-9") {
  Random random(23);
  for (int trial = 0; trial < 5; ++trial) {
    const Model<double> model = rubbing_chain(random, 4);
    const State<double> start = random_state(random, model);
    const auto end = [&](Integrator integrator, double h, int steps) {
      Simulation simulation(model, start);
      simulation.set_integrator(integrator);
      simulation.set_tolerance(1e-11);
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
