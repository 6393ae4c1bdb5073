// Step matrix of several couplings with different laws (coupling/analysis/step_matrix.h): against
// closed forms, and against simulations, by bisection.
#include <doctest/doctest.h>

#include "coupling/laws/coupling_spec.h"
#include "tests/coupling/analysis/growth.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// A term of a two-link arm's couplings, and the coupling itself.
CoupledTerm part_of(const Model<double>& model, const CouplingSpec& spec) {
  Coupled system(model, {}, {}, spec, State<double>(model));
  const Coupling::JointSpace space = system.coupling->joint_space(system.simulation.kinematics());
  CoupledTerm part{space.K, space.K, space.B, spec.discretization, spec.hold_steps};
  if (spec.printed) {
    part.law = StepLaw::printed;
    part.hold_steps = spec.options.hold_steps;
  } else if (spec.type == CouplingSpec::Type::stable_pd) {
    part.law = StepLaw::stable_pd;
  } else if (spec.type == CouplingSpec::Type::god_object) {
    part.law = StepLaw::god_object;
    part.K = mass_matrix(model, State<double>(model));
  }
  return part;
}

bool both_grow(const Model<double>& model, const CouplingSpec& a, const CouplingSpec& b,
               Integrator integrator, double h) {
  State<double> start(model);
  start.q = {1e-9, -0.7e-9};
  Coupled system(model, {}, {}, a, start, integrator);
  const auto other = make_coupling(b, system.model, system.kvr);
  system.simulation.add(*other);
  double early = 0, late = 0;
  constexpr int steps = 8000;
  for (int n = 0; n < steps; ++n) {
    system.simulation.step(h);
    const auto& q = system.simulation.state().q;
    const double size = std::max(std::abs(q[0]), std::abs(q[1]));
    if (!(size < 1e-3)) return true;
    if (n >= steps / 4 && n < steps / 2) early = std::max(early, size);
    if (n >= 3 * steps / 4) late = std::max(late, size);
    if (size < 1e-15 && n > steps / 2) return false;
  }
  return late > 1.01 * early;
}

}  // namespace

TEST_CASE("couplings with different discretizations, rates or laws diverge at the predicted step") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  const auto springs = arm.springs(600, 9, 200, 2);
  const auto of = [&](std::size_t link, Discretization discretization, int hold_steps = 0) {
    CouplingSpec spec = torsional({springs[link]}, SpringSpace::world);
    spec.discretization = discretization;
    spec.hold_steps = hold_steps;
    return spec;
  };
  const auto law = [&](CouplingSpec::Type type, std::vector<Spring> its, int printed_hold = 0) {
    CouplingSpec spec;
    spec.type = type;
    spec.springs = std::move(its);
    spec.printed = printed_hold > 0;
    spec.options.hold_steps = std::max(1, printed_hold);
    return spec;
  };
  const auto point = [&](std::size_t link, double b) {
    return Spring{"point", springs[link].body, Vector3(0.2, 0, 0), 900, b};
  };
  using Type = CouplingSpec::Type;
  constexpr Discretization explicitly = Discretization::explicit_,
                           implicitly = Discretization::implicit;
  const CouplingSpec explicit_inner = of(0, explicitly), explicit_outer = of(1, explicitly),
                     implicit_outer = of(1, implicitly);
  const CouplingSpec printed = law(Type::linear, {point(1, 6)}, 1),
                     printed_seldom = law(Type::linear, {point(1, 6)}, 3),
                     pd = law(Type::stable_pd, {springs[0]}),
                     lands = law(Type::god_object, god_object_joints(model, 1, 2));
  struct Mix {
    const char* name;
    const CouplingSpec &a, &b;
    Integrator integrator = Integrator::semi_implicit;
  };
  const CouplingSpec held_2 = of(0, explicitly, 2), held_3 = of(1, explicitly, 3),
                     held_4 = of(0, explicitly, 4), held_5 = of(0, explicitly, 5),
                     outer_5 = of(1, explicitly, 5), implicit_inner = of(0, implicitly),
                     damped_outer = of(1, Discretization::semi_implicit);
  const Mix mixes[] = {{"explicit and implicit", explicit_inner, implicit_outer},
                       {"implicit and semi-implicit", implicit_inner, damped_outer},
                       {"held twice and thrice", held_2, held_3},
                       {"held and implicit", held_4, implicit_outer},
                       {"held, Runge-Kutta", held_5, outer_5, Integrator::rk4},
                       {"verlet", explicit_inner, explicit_outer, Integrator::verlet},
                       {"xv", explicit_inner, explicit_outer, Integrator::semi_implicit_xv},
                       {"heun", explicit_inner, explicit_outer, Integrator::heun},
                       {"printed and explicit", explicit_inner, printed},
                       {"printed and implicit", implicit_inner, printed},
                       {"printed every third step and explicit", explicit_inner, printed_seldom},
                       {"printed, explicit Euler", explicit_inner, printed, Integrator::euler},
                       {"printed, xv", explicit_inner, printed, Integrator::semi_implicit_xv},
                       {"held twice and thrice, xv", held_2, held_3, Integrator::semi_implicit_xv},
                       {"printed, Runge-Kutta", explicit_inner, printed, Integrator::rk4},
                       {"stable PD and explicit", pd, explicit_outer},
                       {"stable PD and implicit", pd, implicit_outer},
                       {"god object and explicit", lands, explicit_outer},
                       {"god object and printed", lands, printed}};
  for (const Mix& mix : mixes) {
    CAPTURE(std::string(mix.name));
    const Eigen::MatrixXd M = mass_matrix(model, State<double>(model));
    const double predicted =
        max_stable_step(M, {part_of(model, mix.a), part_of(model, mix.b)}, mix.integrator);
    CAPTURE(predicted);
    REQUIRE(std::isfinite(predicted));
    REQUIRE(predicted > 0);
    const auto stable = [&](double h) {
      return !both_grow(model, mix.a, mix.b, mix.integrator, h);
    };
    CHECK(measured_limit(stable, predicted) == doctest::Approx(predicted).epsilon(0.01));
  }
}

// docs/understand/coupling_laws.md
TEST_CASE("on one hinge the parts of every law have their closed form") {
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const double I = 0.7, k = 40, b = 0.9;
  const auto growth = [&](StepLaw law, Integrator integrator, double alpha, double beta,
                          std::vector<CoupledTerm> others = {}) {
    const double h = 1e-3;
    others.push_back({one(alpha * I / (h * h)), one(alpha * I / (h * h)), one(beta * I / h),
                      Discretization::explicit_, 0, law});
    return spectral_radius(one(I), others, integrator, h);
  };
  // Both sides of the limit in alpha, at three dampings.
  const auto check_edge = [&](double edge, const auto& at) {
    CHECK(at(0.999 * edge) <= 1 + 1e-9);
    CHECK(at(1.001 * edge) > 1 + 1e-6);
  };
  struct Printed {
    Integrator integrator;
    SteppingScheme scheme;
  };
  for (const Printed& row :
       {Printed{Integrator::semi_implicit, SteppingScheme::semi_implicit_difference},
        Printed{Integrator::euler, SteppingScheme::euler_difference},
        Printed{Integrator::semi_implicit_xv, SteppingScheme::semi_implicit_difference},
        Printed{Integrator::verlet, SteppingScheme::hold_difference},
        Printed{Integrator::midpoint, SteppingScheme::hold_difference},
        Printed{Integrator::rk4, SteppingScheme::hold_difference}})
    for (const double beta : {0.1, 0.4, 0.8}) {
      CAPTURE(std::string(integrator_name(row.integrator)));
      double edge = 0;
      while (is_stable(row.scheme, edge + 1e-5, beta)) edge += 1e-5;
      check_edge(edge, [&](double alpha) {
        return growth(StepLaw::printed, row.integrator, alpha, beta);
      });
    }
  for (const double beta : {0.0, 0.4, 3.0})
    check_edge((4 + 2 * beta) / 3, [&](double alpha) {
      return growth(StepLaw::stable_pd, Integrator::semi_implicit, alpha, beta);
    });
  // With a god object, e' = -alpha e - beta (e - e_before): Jury's test gives alpha < 1 - 2 beta.
  const CoupledTerm god{one(I), one(0), one(0), Discretization::explicit_, 0, StepLaw::god_object};
  for (const double beta : {0.0, 0.1, 0.4})
    check_edge(1 - 2 * beta, [&](double alpha) {
      return growth(StepLaw::spring_damper, Integrator::semi_implicit, alpha, beta, {god});
    });
  // Alone it reaches the target after one step of any size.
  CHECK(spectral_radius(one(I), {god}, Integrator::semi_implicit, 0.3) < 1e-6);
  CHECK(max_stable_step(one(I), {god}, Integrator::semi_implicit) == kNoLimit);
  CHECK(max_stable_step(
            one(I), {{one(k), one(k), one(b), Discretization::explicit_, 0, StepLaw::stable_pd}},
            Integrator::semi_implicit) ==
        doctest::Approx((2 * b + std::sqrt(4 * b * b + 48 * k * I)) / (6 * k)).epsilon(1e-7));
}

TEST_CASE("terms of one discretization have the limit of its scheme, implicit integrators none") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  const Eigen::MatrixXd M = mass_matrix(model, State<double>(model));
  CouplingSpec spec = torsional(arm.springs(600, 9, 200, 2), SpringSpace::world);
  const auto limit = [&](Discretization discretization, Integrator integrator) {
    spec.discretization = discretization;
    return max_stable_step(M, {part_of(model, spec)}, integrator);
  };
  const CoupledTerm part = part_of(model, spec);
  const auto of = [&](SteppingScheme scheme) { return max_stable_step(M, part.K, part.B, scheme); };
  const auto same = [](double a, double b) { return a == doctest::Approx(b).epsilon(1e-8); };
  CHECK(same(limit(Discretization::explicit_, Integrator::semi_implicit),
             of(SteppingScheme::semi_implicit)));
  CHECK(same(limit(Discretization::explicit_, Integrator::semi_implicit_xv),
             of(SteppingScheme::semi_implicit)));
  CHECK(same(limit(Discretization::explicit_, Integrator::euler), of(SteppingScheme::euler)));
  CHECK(same(limit(Discretization::explicit_, Integrator::rk4), of(SteppingScheme::rk4)));
  CHECK(same(limit(Discretization::semi_implicit, Integrator::semi_implicit),
             of(SteppingScheme::implicit_damper)));
  CHECK(limit(Discretization::implicit, Integrator::semi_implicit) == kNoLimit);
  for (const auto integrator :
       {Integrator::implicit_euler, Integrator::implicit_midpoint, Integrator::trapezoid})
    CHECK(limit(Discretization::explicit_, integrator) == kNoLimit);
}

TEST_CASE("an implicit point spring off its target has the limit of its geometric stiffness") {
  // R_K > 2 r: h^2 k r R_K = 4 I + 2 r^2 (h^2 k + h b), solved for h.
  const double I = 0.7, r = 0.3, k = 5000, b = 20, R_K = 0.9;
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const CoupledTerm part{one(k * r * R_K), one(k * r * r), one(b * r * r), Discretization::implicit,
                         0};
  const double h = max_stable_step(one(I), {part}, Integrator::semi_implicit);
  REQUIRE(std::isfinite(h));
  CHECK(max_target_radius(I, r, k, b, h) == doctest::Approx(R_K).epsilon(1e-7));
}
