// Hunt-Crossley contact of carriages with known motion: rest, impact, sliding, sticking.
#include "collision/contact/contact_force.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/dynamics/model_builder.h"
#include "solver/impulses/joint_limits.h"
#include "solver/stepping/simulation.h"
#include "tests/collision/contact/hunt_crossley.h"

using namespace twinarm;

namespace {

constexpr double kMass = 2, kGravity = 9.81, kStep = 1e-3, kHalf = 0.1;

// A block with sides of 0.2 m on slides along x and z (or z only) above a fixed floor.
struct Block {
  Model<double> model;
  ContactForce contact;
  Simulation simulation;

  Block(bool slides_sideways, bool half_space, const ContactLaw& law, double height, double vx,
        double vz)
      : model(carriage(slides_sideways)),
        contact(model, law),
        simulation(model, start(height, vx, vz)) {
    const int block = model.find_body("block");
    contact.add(block, {}, "block", Box{Vector3::Constant(2 * kHalf)});
    if (half_space)
      contact.add(0, {}, "floor", HalfSpace{});
    else
      contact.add(0, {Matrix3::Identity(), {0, 0, -0.5}}, "floor", Box{{20, 4, 1}});
    simulation.add(contact);
  }
  Block(const Block&) = delete;

  static Model<double> carriage(bool slides_sideways) {
    ModelBuilder builder;
    int parent = 0;
    const BodyInertia light{1e-6, Vector3::Zero(), 1e-9 * Matrix3::Identity()};
    if (slides_sideways)
      parent = builder.add_body("rail", 0, "x", JointType::prismatic, {}, Vector3::UnitX(), light);
    builder.add_body("block", parent, "z", JointType::prismatic, {}, Vector3::UnitZ(),
                     {kMass, Vector3::Zero(), 0.01 * Matrix3::Identity()});
    return builder.build();
  }
  State<double> start(double height, double vx, double vz) const {
    State<double> x(model);
    x.q.back() = kHalf + height;
    x.qd.back() = vz;
    if (x.qd.size() > 1) x.qd.front() = vx;
    return x;
  }
  double z() const { return simulation.state().q.back() - kHalf; }  // of the lower face
  double vz() const { return simulation.state().qd.back(); }
  double vx() const { return simulation.state().qd.front(); }
  double normal_force() const {
    double sum = 0;
    for (const ContactReading& reading : contact.readings()) sum += reading.normal_force;
    return sum;
  }
  std::size_t pressing() const {
    return static_cast<std::size_t>(
        std::count_if(contact.readings().begin(), contact.readings().end(),
                      [](const ContactReading& reading) { return reading.normal_force > 0; }));
  }
};

}  // namespace

TEST_CASE(
    "a block at rest has the normal force m g and depth m g / (k points), k from 1e5 to 1e9") {
  for (const bool half_space : {true, false})
    for (const double k : {1e5, 1e6, 1e7, 1e8, 1e9}) {
      CAPTURE(half_space);
      CAPTURE(k);
      Block block(false, half_space, {k, 1, 0.3, 1e-3}, 0, 0, 0);
      for (int n = 0; n < 3000; ++n) REQUIRE_UNARY(block.simulation.step(kStep).finite);
      const auto points = static_cast<double>(block.pressing());
      CHECK(points >= 3);
      CHECK(block.normal_force() == doctest::Approx(kMass * kGravity).epsilon(1e-9));
      // Within the rounding of a depth between faces 0.1 m from the origin.
      CHECK(std::abs(-block.z() - kMass * kGravity / (k * points)) < 1e-15 + 1e-9 * -block.z());
      CHECK(std::abs(block.vz()) < 1e-9);
      for (const ContactReading& reading : block.contact.readings()) {
        CHECK((reading.normal_W - Vector3::UnitZ()).norm() < 1e-9);
        CHECK(reading.body == block.model.find_body("block"));
      }
    }
}

TEST_CASE("a block dropped at 3 m/s penetrates less than 0.5 mm at k = 1e8 and gains no energy") {
  for (const bool half_space : {true, false})
    for (const double dissipation : {0.0, 0.3, 1.0, 3.0})
      for (const double height : {0.0, 1e-4, 0.0017, 0.003, 0.01}) {
        CAPTURE(half_space);
        CAPTURE(dissipation);
        CAPTURE(height);
        Block block(false, half_space, {1e8, dissipation, 0, 1e-3}, height, 0, -3);
        const auto energy = [&] {
          return 0.5 * kMass * block.vz() * block.vz() + kMass * kGravity * block.z();
        };
        const double start = energy();
        double deepest = 0, most = 0;
        for (int n = 0; n < 1500; ++n) {
          const StepReport report = block.simulation.step(kStep);
          REQUIRE_UNARY(report.finite);
          CHECK_UNARY(report.force_iterations <= ForceSource::kMaxIterations);
          deepest = std::max(deepest, -block.z());
          most = std::max(most, energy());
        }
        CHECK(deepest < 5e-4);
        CHECK(most < start + 1e-9);
        CHECK(block.z() > -1e-4);
      }
}

TEST_CASE("the restitution of an impact agrees with Hunt and Crossley's law to 2e-3") {
  for (const double v : {0.1, 0.5, 1.0, 3.0}) {  // c = 1 s/m
    CAPTURE(v);
    Block block(false, true, {1e13, 1, 0, 1e-3}, 0, 0, -v);  // so short that gravity is negligible
    for (int n = 0; n < 60000 && (block.vz() < 0 || block.normal_force() > 0); ++n)
      REQUIRE_UNARY(block.simulation.step(1e-10).finite);
    CHECK(block.normal_force() == 0);
    CHECK(std::abs(block.vz() / v - testing::hunt_crossley_restitution(v)) < 2e-3);
  }
}

TEST_CASE("a sliding block decelerates with mu g, to 1 percent, and then stays at rest") {
  for (const double mu : {0.1, 0.3, 0.8}) {
    CAPTURE(mu);
    Block block(true, false, {1e7, 1, mu, 1e-3}, 0, 2, 0);
    for (int n = 0; n < 50; ++n) block.simulation.step(kStep);  // until it is at rest
    const double v0 = block.vx();
    for (int n = 0; n < 100; ++n) block.simulation.step(kStep);
    const double slowed = (v0 - block.vx()) / 0.1;
    CHECK(slowed == doctest::Approx(mu * kGravity * kMass / (kMass + 1e-6)).epsilon(0.01));
    for (int n = 0; n < 4000; ++n) block.simulation.step(kStep);
    CHECK(std::abs(block.vx()) < 1e-9);
    const double stopped = block.simulation.state().q.front();
    CHECK(stopped > 0);
    CHECK(stopped < 2 * 2 / (2 * mu * kGravity) * 1.2);
  }
}

namespace {

struct Push final : ForceSource {
  double force;
  explicit Push(double f) : force(f) {}
  void add_forces(const State<double>&, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.tau[0] += force;
  }
};

}  // namespace

TEST_CASE("a block pushed inside the friction cone creeps as predicted, outside it accelerates") {
  const double mu = 0.5, N = kMass * kGravity, v_s = 1e-3;
  for (const double part : {0.3, 0.9, 1.2}) {
    CAPTURE(part);
    Block block(true, true, {1e7, 1, mu, v_s}, 0, 0, 0);
    Push push(part * mu * N);
    block.simulation.add(push);
    for (int n = 0; n < 2000; ++n) block.simulation.step(kStep);
    if (part < 1) {  // mu N v / sqrt(v^2 + v_s^2) = push
      CHECK(block.vx() == doctest::Approx(v_s * part / std::sqrt(1 - part * part)).epsilon(1e-6));
    } else {
      CHECK(block.vx() == doctest::Approx((part - 1) * mu * kGravity * 2).epsilon(0.02));
    }
  }
}

TEST_CASE("a block without contact falls freely") {
  Block block(true, false, {1e8, 1, 0.3, 1e-3}, 5, 1, 0);
  for (int n = 0; n < 500; ++n) {
    block.simulation.step(kStep);
    CHECK_UNARY(block.normal_force() == 0);
  }
  CHECK(block.contact.deepest(block.simulation.kinematics()) == 0);
  CHECK(block.vx() == 1);
  CHECK(block.vz() == doctest::Approx(-kGravity * 0.5).epsilon(1e-12));
  CHECK(block.contact.needs_semi_implicit());
}

TEST_CASE("a block that moves away from the floor has no contact force") {
  Block block(false, true, {1e8, 1, 0.3, 1e-3}, -1e-6, 0, 3);  // small penetration, separating
  block.simulation.step(kStep);
  CHECK(block.vz() == doctest::Approx(3 - kGravity * kStep).epsilon(1e-9));
}

TEST_CASE("an iterated force and a constraint exclude each other, in any order") {
  const ContactLaw law;
  Block block(false, true, law, 0.05, 0, 0);
  JointLimits limits(block.model);
  limits.add(block.model.find_body("block"), -1, 1);
  CHECK_THROWS_WITH_AS(block.simulation.add(limits), doctest::Contains("iterated force source"),
                       std::invalid_argument);
  // The rejected source was not added.
  int most = 0;
  for (int n = 0; n < 400; ++n)
    most = std::max(most, block.simulation.step(kStep).force_iterations);
  CHECK(most > 1);
  CHECK(block.normal_force() == doctest::Approx(kMass * kGravity).epsilon(1e-6));

  Simulation limited(block.model, State<double>(block.model));
  limited.add(limits);
  CHECK_THROWS_WITH_AS(limited.add(block.contact), doctest::Contains("iterated force source"),
                       std::invalid_argument);
  CHECK(limited.step(kStep).ok());
}
