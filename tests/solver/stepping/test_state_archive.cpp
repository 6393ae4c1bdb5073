// Serialization of a run (solver/support/state_archive.h): a restored run continues
// bit-identically.
#include "solver/support/state_archive.h"

#include <doctest/doctest.h>

#include <cmath>
#include <deque>

#include "solver/constraints/joint_limits.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// A force that grows with every begin_step().
struct Growing final : ForceSource, Checkpointable {
  long steps = 0;
  void begin_step(const Kinematics&, double, double) noexcept override { ++steps; }
  void add_forces(const State<double>&, const Kinematics&, Forces<double>& f) noexcept override {
    f.tau.back() += 0.01 * static_cast<double>(steps);
  }
  void serialize(StateArchive& memory) override { memory.visit(steps); }
};

Model<double> rubbing_chain() {
  Random random(61);
  std::vector<TreeBody> bodies = random_bodies(random, 4, {JointType::revolute});
  for (TreeBody& body : bodies) {
    body.properties.damping = 0.1;
    body.properties.coulomb_plus = body.properties.coulomb_minus = 0.2;
  }
  return build(bodies);
}

// A simulation with internal state: a source, limits with impacts, events, an integrator.
struct Run {
  Run(const Model<double>& model, Integrator integrator, bool limited, bool located)
      : limits(model), simulation(model, State<double>(model)) {
    simulation.set_integrator(integrator, 1e-13);
    simulation.add(source);
    if (limited) {
      for (int body = 1; body < model.body_count(); ++body) limits.add(body, -0.3, 0.3);
      simulation.add(limits);
    }
    if (located) simulation.locate_events();
  }
  Run(const Run&) = delete;
  void steps(int count) {
    for (int n = 0; n < count; ++n) REQUIRE(simulation.step(4e-3).ok());
  }
  std::string remembered() {
    StateArchive memory;
    simulation.serialize(memory);
    return memory.bytes();
  }
  void take_back(const std::string& bytes) {
    StateArchive memory(bytes);
    simulation.serialize(memory);
    CHECK(memory.at_end());
  }
  Growing source;
  JointLimits limits;
  Simulation simulation;
};

struct Kind {
  Integrator integrator;
  bool limited, located;
};
std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds{{Integrator::semi_implicit, true, false},
                          {Integrator::semi_implicit, true, true}};
  for (const IntegratorFacts& facts : all_integrators)
    kinds.push_back({facts.integrator, false, false});
  return kinds;
}

}  // namespace

// After each of a hundred steps: state matters when joints stick, limits open or a substep is
// rejected.
TEST_CASE("archive: a restored run continues bit-identically") {
  const Model<double> model = rubbing_chain();
  for (const Kind& kind : all_kinds()) {
    CAPTURE(std::string(facts_of(kind.integrator).name));
    CAPTURE(kind.limited);
    CAPTURE(kind.located);
    const auto works = [](const Run& run) {
      std::vector<double> each;
      for (const JointLimits::Limit& limit : run.limits.limits()) each.push_back(limit.work);
      return each;
    };
    Run one(model, kind.integrator, kind.limited, kind.located);
    std::deque<Run> others;  // restored after each of the last five steps
    for (int n = 0; n < 100; ++n) {
      others.emplace_back(model, kind.integrator, kind.limited, kind.located);
      others.back().take_back(one.remembered());
      one.steps(1);
      for (Run& other : others) other.steps(1);
      CHECK(others.front().simulation.state().q == one.simulation.state().q);
      CHECK(others.front().simulation.state().qd == one.simulation.state().qd);
      CHECK(others.front().remembered() == one.remembered());
      CHECK(works(others.front()) == works(one));
      if (others.size() == 5) others.pop_front();
    }
    double total = 0;
    for (const double work : works(one)) total += std::abs(work);
    CHECK((total > 0) == kind.limited);
  }
}

TEST_CASE("archive: truncated data and data of another model are rejected") {
  const Model<double> model = rubbing_chain();
  for (const Kind& kind : all_kinds()) {
    Run one(model, kind.integrator, kind.limited, kind.located);
    one.steps(60);
    const std::string bytes = one.remembered();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      StateArchive memory(bytes.substr(0, size));
      CHECK_THROWS_AS(one.simulation.serialize(memory), std::runtime_error);
    }
  }
  Random random(62);
  const Model<double> longer = build(random_bodies(random, 5, {JointType::revolute}));
  Run one(model, Integrator::rk4, false, false), other(longer, Integrator::rk4, false, false);
  StateArchive memory(one.remembered());
  CHECK_THROWS_AS(other.simulation.serialize(memory), std::runtime_error);
}

TEST_CASE("archive: an unknown friction mode is rejected") {
  const Model<double> model = rubbing_chain();
  ForwardDynamics dynamics(model);
  StateArchive written;
  dynamics.serialize(written);
  for (const char mode : {'\x01', '\xff', '\x02', '\x39', '\x80'}) {
    std::string bytes = written.bytes();
    bytes.back() = mode;
    StateArchive read(bytes);
    if (mode == '\x01' || mode == '\xff')
      CHECK_NOTHROW(dynamics.serialize(read));
    else
      CHECK_THROWS_AS(dynamics.serialize(read), std::runtime_error);
  }
}

TEST_CASE("archive: values round-trip, impossible sizes are rejected") {
  const auto visit = [](StateArchive& memory, auto&... values) { (memory.visit(values), ...); };
  std::string text = "a\0b";
  bool yes = true;
  Vector3 v(1, -2, 3e300);
  std::vector<double> numbers{1, 2, 3}, none;
  StateArchive written;
  visit(written, text, yes, v, numbers, none);
  CHECK_FALSE(written.reads());
  std::string text_back;
  bool yes_back = false;
  Vector3 v_back = Vector3::Zero();
  std::vector<double> numbers_back, none_back{7};
  StateArchive read(written.bytes());
  visit(read, text_back, yes_back, v_back, numbers_back, none_back);
  CHECK(read.at_end());
  CHECK(text_back == text);
  CHECK(yes_back);
  CHECK(v_back == v);
  CHECK(numbers_back == numbers);
  CHECK(none_back.empty());

  const std::string huge(8, '\xff');  // a size of 2^64 - 1
  StateArchive first(huge), second(huge);
  CHECK_THROWS_AS(first.visit(numbers_back), std::runtime_error);
  CHECK_THROWS_AS(second.visit(text_back), std::runtime_error);
  StateArchive three;
  three.visit(numbers);
  std::vector<double> two(2);
  StateArchive to_two(three.bytes());
  CHECK_THROWS_AS(to_two.visit_fixed(two), std::runtime_error);
  for (int index : {-1, 3, 4}) {
    StateArchive place;
    place.visit(index);
    StateArchive back(place.bytes());
    CHECK_THROWS_AS(back.visit_index(index, 3), std::runtime_error);
  }
}
