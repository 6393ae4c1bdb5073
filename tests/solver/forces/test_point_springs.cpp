// Springs between two points: length, rate and force laws.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "solver/dynamics/model_builder.h"
#include "solver/expressions/expression_parser.h"
#include "solver/forces/point_springs.h"

namespace twinarm {
namespace {

constexpr double kMassA = 2, kMassB = 3;

// Two free bodies without gravity, a hinged rod as third.
Model<double> two_bodies() {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  const Matrix3 unit = Matrix3::Identity();
  builder.add_body("a", 0, "free_a", JointType::free, {}, Vector3::UnitZ(),
                   {kMassA, {0.1, 0, 0}, 0.1 * unit});
  builder.add_body("b", 0, "free_b", JointType::free, {}, Vector3::UnitZ(),
                   {kMassB, Vector3::Zero(), 0.2 * unit});
  builder.add_body("rod", 0, "hinge", JointType::revolute, {}, Vector3::UnitY(),
                   {1, {0, 0, -0.5}, 0.1 * unit});
  return builder.build();
}

// Mass centre of A in the origin, B on the x axis.
State<double> apart(const Model<double>& model, double distance) {
  State<double> x(model);
  const std::size_t a = model.iq[1], b = model.iq[2];
  // The order of a free joint's coordinates: from the kinematics.
  for (std::size_t k = 0; k < 7; ++k) {
    State<double> moved = x;
    moved.q[a + k] += 1;
    const Kinematics at = kinematics_at(model, moved);
    if ((at.X_WL[1].p - Vector3::UnitX()).norm() < 1e-12) {
      x.q[a + k] = -0.1;
      x.q[b + k] = distance;
      return x;
    }
  }
  return x;
}

ExpressionTape law_of(const std::string& text) {
  ExpressionGraph graph;
  const std::vector<ExpressionSymbol> symbols = {{"l", {}}, {"v", {}}, {"t", {}}};
  const ExpressionGraph::Id f = parse_expression(graph, text, symbols);
  const std::array inputs{graph.symbol("l"), graph.symbol("v"), graph.symbol("t")};
  return {graph, inputs, std::array{f}};
}

}  // namespace

TEST_CASE("a spring's rate is that of its length, and a law adds its tension") {
  const Model<double> model = two_bodies();
  State<double> x = apart(model, 1);
  for (std::size_t i = 0; i < x.qd.size(); ++i) x.qd[i] = 0.1 * (1 + double(i % 5));
  x.t = 0.3;
  PointSprings springs({{"damped", {1, {0.2, 0.1, 0}}, {2, {0, 0.3, 0.1}}, 50, 4, 0.7},
                        {"law",
                         {0, {0, 0, 0.4}},
                         {3, {0, 0, -0.7}},
                         10,
                         1,
                         0.2,
                         law_of("2 * l^3 + 5 * v + sin(t)")}});
  const Kinematics k = kinematics_at(model, x);
  for (std::size_t i : {0, 1}) {
    const auto now = springs.reading(i, x, k);
    const PointSpring& spring = springs.springs()[i];
    // Length after 1e-6 s and before it.
    const auto length_at = [&](double dt) {
      const Vector3 p_A = now.p_A + dt * k.velocity(spring.a.body, now.p_A);
      const Vector3 p_B = now.p_B + dt * k.velocity(spring.b.body, now.p_B);
      return (p_B - p_A).norm();
    };
    CHECK(now.rate == doctest::Approx((length_at(1e-6) - length_at(-1e-6)) / 2e-6).epsilon(1e-7));
    const double linear =
        spring.stiffness * (now.length - spring.rest_length) + spring.damping * now.rate;
    const double law = i == 1 ? 2 * std::pow(now.length, 3) + 5 * now.rate + std::sin(0.3) : 0;
    CHECK(now.tension() == doctest::Approx(linear + law));
    CHECK(now.law == doctest::Approx(law));
  }
}

TEST_CASE("a spring between coinciding points exerts no force") {
  const Model<double> model = two_bodies();
  PointSprings springs({{"s", {1, {0.1, 0, 0}}, {2, {}}, 50, 1, 0.8}});
  const State<double> x = apart(model, 0);
  const Kinematics k = kinematics_at(model, x);
  Forces<double> forces(model);
  springs.add_forces(x, k, forces);
  for (const Force<double>& f : forces.f_ext) {
    CHECK(to_eigen(f.n).norm() == 0);
    CHECK(to_eigen(f.f).norm() == 0);
  }
}

}  // namespace twinarm
