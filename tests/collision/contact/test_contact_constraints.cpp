// Rigid contact: properties of every run, and closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"
#include "tests/collision/contact/contact_scene.h"
#include "tests/collision/shapes/step_mesh.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

Shape random_shape(Random& random) {
  const double r = random.uniform(0.05, 0.15);
  switch (random.integer(0, 3)) {
    case 0:
      return Sphere{r};
    case 1:
      return Box{{r, random.uniform(0.1, 0.3), random.uniform(0.1, 0.3)}};
    case 2:
      return Capsule{r, random.uniform(0.1, 0.3)};
    default:
      return Cylinder{r, random.uniform(0.1, 0.3)};
  }
}

// Bodies with random velocities, without gravity if `floating`, else above a floor.
ContactScene thrown_together(unsigned seed, bool floating) {
  Random random(seed);
  ContactScene scene;
  if (floating) scene.set_gravity(Vector3::Zero());
  const double e = random.uniform(0, 1), mu = random.uniform(0, 1);
  const int bodies = random.integer(2, 5);
  for (int i = 0; i < bodies; ++i) {
    const Vector3 p(0.45 * (i % 2) - 0.2, 0.45 * (i / 2) - 0.2, 0.4 + 0.1 * i);
    const Vector3 to_middle = floating ? Vector3(-2 * p + Vector3(0, 0, 0.8)) : Vector3(0, 0, -1);
    scene.body(random_shape(random), std::pow(100.0, random.uniform(0, 1)),
               rough_surface(mu, std::sqrt(e)),
               {p, to_middle + random.vector(0.3), random.vector(3), random.rotation()});
  }
  if (!floating) scene.floor(rough_surface(mu, std::sqrt(e)));
  scene.begin();
  return scene;
}

Force<double> momentum_of(const Simulation& simulation) {
  Workspace<double> w(simulation.mechanism().model());
  kinematics(simulation.mechanism().model(), simulation.state(), w);
  return momentum(simulation.mechanism().model(), w);
}

}  // namespace

// Four points of one face have gaps that differ by tenths of a nanometre under a load by spin; the
// point that opens determines the load of the others.
constexpr unsigned hard_seed = 527;

TEST_CASE("a face with one point that opens at less than 1 um/s obeys the contact laws") {
  ContactScene scene = thrown_together(hard_seed, hard_seed % 2 == 0);
  double worst_residual = 0;
  for (int n = 0; n < 150; ++n) {
    scene.run(2e-3, 1);
    worst_residual = std::max(worst_residual, scene.report().step.residual);
  }
  CHECK(worst_residual <= 1e-8);
}

TEST_CASE("1000 random runs: friction cones are obeyed, and no contact does positive work") {
  double worst_residual = 0, max_work = 0;
  int unsolved = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    ContactScene scene = thrown_together(seed, seed % 2 == 0);
    const double energy = std::abs(scene.energy()) + 1;
    for (int n = 0; n < 150; ++n) {
      scene.run(2e-3, 1);
      const ConstraintReport& report = scene.report();
      unsolved += !report.step.converged || !report.impact.converged;
      worst_residual = std::max({worst_residual, report.step.residual, report.impact.residual});
      // Kinetic energy changes by p . (u without p + u)/2 = p . u - 1/2 p G p <= p . u.
      double work = 0;
      for (const ContactPoint& p : scene.contacts().points())
        work += 2e-3 * p.force_W.dot(p.velocity_W);
      max_work = std::max({max_work, work / energy, -report.impact_loss / energy});
    }
    for (const double q : scene.simulation().state().q) REQUIRE(std::isfinite(q));
  }
  CHECK(unsolved == 0);
  CHECK(worst_residual <= 1e-8);
  CHECK(max_work < 1e-9);
}

TEST_CASE("momentum is conserved in collisions of free bodies") {
  double worst = 0;
  for (unsigned seed = 0; seed < 200; seed += 2) {
    ContactScene scene = thrown_together(seed, true);
    const Force<double> before = momentum_of(scene.simulation());
    double size = 0;  // scale: exchanged momenta
    for (std::size_t i = 1; i < scene.simulation().mechanism().model().parent.size(); ++i)
      size += scene.simulation().mechanism().model().I[i].m *
              scene.velocity(static_cast<int>(i)).norm();
    scene.run(1e-3, 400);
    const Force<double> after = momentum_of(scene.simulation());
    worst = std::max(worst, to_eigen(after.f - before.f).norm() / size);
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("a sphere of 10 mm at 50 m/s does not tunnel through a plate of 5 mm") {
  for (const double offset : {0.0, 0.0031, 0.0497}) {
    ContactScene scene;
    scene.set_gravity(Vector3::Zero());
    scene.obstacle(Box{{1, 1, 0.005}}, rough_surface(0.3, 0));
    const int ball = scene.body(Sphere{0.005}, 0.004, rough_surface(0.3, 0),
                                {{0.01, 0.02, 0.5 + offset}, {0, 0, -50}});
    scene.begin();
    scene.run(1e-3, 100);
    CHECK(scene.position(ball).z() == doctest::Approx(0.0075).epsilon(1e-6));
  }
}

TEST_CASE("deeply penetrating bodies separate slowly, and are then at rest") {
  ContactScene scene;
  scene.floor(rough_surface(0.5, 0));
  const int box = scene.body(Box{{0.2, 0.2, 0.2}}, 1, rough_surface(0.5, 0), {{0, 0, 0.04}});
  scene.begin();
  double fastest = 0;
  for (int n = 0; n < 2000; ++n) {
    scene.run(1e-3, 1);
    fastest = std::max(fastest, scene.velocity(box).norm());
  }
  CHECK(fastest < 1e-6);  // position correction only
  CHECK(scene.position(box).z() == doctest::Approx(0.1).epsilon(1e-4));
}

TEST_CASE("a box on a belt is accelerated by friction up to mu m g") {
  ContactScene scene;  // the belt: a floor with a surface velocity
  scene.set_gravity({9.81 * std::sin(0.2), 0, -9.81 * std::cos(0.2)});
  scene.floor(rough_surface(0.1, 0));
  const int box = scene.body(Box{{0.2, 0.2, 0.2}}, 2, rough_surface(0.1, 0), {{0, 0, 0.1}});
  scene.begin();
  scene.run(1e-3, 1000);
  const double a = 9.81 * (std::sin(0.2) - 0.1 * std::cos(0.2));
  CHECK(scene.velocity(box).x() == doctest::Approx(a).epsilon(1e-9));
  Vector3 force = Vector3::Zero();
  for (const ContactPoint& p : scene.contacts().points()) force += p.force_W;
  CHECK(std::abs(force.x()) == doctest::Approx(0.1 * 2 * 9.81 * std::cos(0.2)).epsilon(1e-8));
}

TEST_CASE(
    "torsional friction stops a spinning box after w I / (mu_t m g), rolling friction a sphere") {
  ContactSurface rough = rough_surface(0.5, 0);
  rough.torsional_friction = 0.02;
  ContactScene top;
  top.floor(rough_surface(0, 0));
  top.body(Sphere{0.1}, 1, rough, {{0, 0, 0.1}, {0, 0, 0}, {0, 0, 10}});
  top.begin();
  top.run(1e-3, 100);
  const double alpha = 0.02 * 9.81 / (0.4 * 0.01);
  CHECK(top.simulation().kinematics().w_WL[1].z() ==
        doctest::Approx(10 - 0.1 * alpha).epsilon(1e-6));

  ContactSurface soft = rough_surface(0.5, 0);
  soft.rolling_friction = 0.002;
  ContactScene ball;
  ball.floor(soft);
  const int id = ball.body(Sphere{0.1}, 1, soft, {{0, 0, 0.1}, {1, 0, 0}, {0, 10, 0}});
  ball.begin();
  ball.run(1e-3, 500);
  // m a = F, I alpha = -F R - c N: a = -c g / (R (1 + 2/5))
  CHECK(ball.velocity(id).x() ==
        doctest::Approx(1 - 0.5 * 0.002 * 9.81 / (0.1 * 1.4)).epsilon(1e-5));
}

TEST_CASE("the same scene gives bit-identical results; a warm step does not allocate") {
  ContactScene a = thrown_together(17, false), b = thrown_together(17, false);
  a.run(1e-3, 700), b.run(1e-3, 700);
  CHECK(a.simulation().state().q == b.simulation().state().q);
  ContactScene boxes;
  boxes.floor(rough_surface(0.5, 0));
  for (int i = 0; i < 5; ++i)
    boxes.body(Box{{0.1, 0.1, 0.1}}, 1, rough_surface(0.5, 0), {{0, 0, 0.05 + 0.101 * i}});
  boxes.begin();
  boxes.run(1e-3, 200);
  CHECK(allocations_in([&] { boxes.run(1e-3, 100); }) == 0);
}

TEST_CASE("a side step does not change the run") {
  ContactScene a = thrown_together(5, false), b = thrown_together(5, false);
  a.run(1e-3, 300), b.run(1e-3, 300);
  (void)side_step(b.simulation(), 4e-4);
  a.run(1e-3, 100), b.run(1e-3, 100);
  CHECK(a.simulation().state().q == b.simulation().state().q);
}

TEST_CASE("all errors of a surface are reported at once") {
  const Model<double> empty = [] {
    ModelBuilder builder;
    builder.add_body("b", 0, "j", JointType::free, {}, Vector3::UnitZ(),
                     {1, Vector3::Zero(), Matrix3::Identity()});
    return builder.build();
  }();
  ContactConstraints contacts(empty, ContactResponse::rigid);
  ContactGeometry bad{"bad", 7, {}, Sphere{0.1}, rough_surface(-1, 2), 0};
  try {
    contacts.bodies().add(bad);
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(error.faults().size() == 3);
  }
  bad.body = 0;
  bad.surface = rough_surface(-1e-9, -1e-9);
  bad.surface.stiffness = bad.surface.dissipation = -1e-9;
  try {
    contacts.bodies().add(bad);
    FAIL("accepted");
  } catch (const InputError& error) {  // with the digits of small numbers
    CHECK(error.faults().size() == 4);
    for (const Diagnostic& fault : error.faults())
      CHECK(fault.problem.find("-1e-09") != std::string::npos);
  }
}

TEST_CASE(
    "a box between the tread of a mesh and a post rests there, also with a small initial "
    "penetration") {
  for (const double deep : {1e-8, 1e-7, 1e-6}) {
    CAPTURE(deep);
    ContactScene scene;
    scene.set_gravity({0, 0, -9.81});
    ContactSurface rough;
    rough.friction = 0.5;
    scene.obstacle(MeshShape{test::step_mesh()}, rough);
    scene.obstacle(Box{{0.1, 0.04, 0.12}}, rough, {Matrix3::Identity(), {-0.1, 0.28, 0.06}});
    const Vector3 start(-0.1, 0.2, 0.17 - deep);  // its middle is beyond the edge, at y = 0.15
    const int box = scene.body(Box{{0.08, 0.2, 0.1}}, 2, rough, {start});
    scene.begin();
    for (int n = 0; n < 200; ++n) {
      scene.simulation().step(1e-3);
      Vector3 force = Vector3::Zero();
      for (const ContactPoint& point : scene.contacts().points()) {
        force += point.force_W;
        CHECK(point.contact.depth < 1.1e-6);
      }
      if (n > 1) CHECK((force - 2 * 9.81 * Vector3::UnitZ()).norm() < 1e-6);
    }
    CHECK((scene.position(box) - start).norm() < 2e-6);
    CHECK(scene.velocity(box).norm() < 1e-8);
  }
}
