// Many runs side by side against the same runs one by one: Simulation with its couplings, whose
// errors and energies are computed here from the states alone.
#include "coupling/batch_run.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "solver/batch.h"
#include "solver/energy.h"
#include "solver/rotation_log.h"
#include "tests/coupling/two_link.h"
#include "tests/solver/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Type = CouplingSpec::Type;
struct Law {
  const char* name;
  Type type;
  Measure measure;
};
constexpr std::array<Law, 3> kLaws{{{"world", Type::torsional, Measure::world},
                                    {"joint", Type::torsional, Measure::joint},
                                    {"linear", Type::linear, Measure::world}}};
constexpr std::array kTreatments{Treatment::explicit_, Treatment::semi_implicit,
                                 Treatment::implicit};

// Smooth, in all three joints, and not small.
class WavingHand final : public HandSource {
 public:
  HandSample sample(double t, double) const override {
    HandSample hand;
    for (std::size_t j = 0; j < 3; ++j) {
      const double w = 2.0 + static_cast<double>(j), size = 0.5 - 0.1 * static_cast<double>(j);
      mapping_.set_robot_angle(hand, j, size * std::sin(w * t), size * w * std::cos(w * t));
    }
    return hand;
  }
  double duration() const override { return 1; }
  std::string description() const override { return "waving"; }

 private:
  HandMapping mapping_;
};

// Joints of all kinds that go in lanes, fixed ones too, and damping; the first three are hinges.
Model<double> tree(Random& random) {
  auto bodies = random_bodies(
      random, 6, {JointType::revolute, JointType::prismatic, JointType::screw, JointType::fixed});
  for (TreeBody& body : bodies) {
    const bool driven = &body - bodies.data() < 3;
    if (driven) body.type = JointType::revolute;
    if (&body - bodies.data() == 4) body.type = JointType::fixed;
    body.properties.damping = random.integer(0, 1) * random.uniform(0, 0.5);
    if (random.integer(0, 2) == 0) body.properties.armature = random.uniform(0, 0.1);
  }
  return build(bodies);
}

struct Bench {
  Model<double> model;
  WavingHand hand;
  BatchSetup setup;
  Bench(Model<double> of, const Law& law, Treatment treatment, bool absolute) : model(of) {
    setup.model = &model;
    setup.start = State<double>(model);
    BatchTarget target;
    target.hand = &hand;
    target.joints = {{"joint1", "joint2", "joint3"}, "", 0, 0};
    target.rest = State<double>(model);
    setup.targets = {target};
    for (int body = 1; body < model.body_count(); ++body) {
      const bool fixed = model.joint[static_cast<std::size_t>(body)] == JointType::fixed;
      if (fixed && law.measure == Measure::joint) continue;
      BatchSpring spring;
      spring.type = law.type;
      spring.measure = law.measure;
      spring.treatment = treatment;
      spring.absolute_damper = absolute;
      spring.body = body;
      setup.springs.push_back(spring);
    }
    setup.duration = 0.4;
    for (const int body : {1, 2, 3})
      setup.measured.push_back(model.iq[static_cast<std::size_t>(body)]);
    setup.energy = true;
  }
  Bench(const Bench&) = delete;

  BatchCell random_cell(Random& random) const {
    BatchCell cell;
    cell.h = random.integer(0, 1) == 0 ? 1e-3 : 0.7e-3;
    cell.speed = random.integer(0, 1) == 0 ? 1 : 1.3;
    cell.delay = random.integer(0, 1) == 0 ? 0 : 0.0333;
    for (std::size_t s = 0; s < setup.springs.size(); ++s)
      cell.springs.push_back({random.uniform(100, 900), random.uniform(1, 8),
                              random.integer(0, 1) * Vector3(0.1, 0.2, -0.1)});
    for (int i = 0; i < model.body_count(); ++i) cell.mass_factor.push_back(random.uniform(0.5, 2));
    return cell;
  }
};

// The run of a cell, one by one.
class OneByOne {
 public:
  OneByOne(const BatchSetup& setup, const BatchCell& cell)
      : setup_(setup), cell_(cell), model_(scaled()), hand_(hand(), cell.speed, cell.delay) {
    for (std::size_t s = 0; s < setup.springs.size(); ++s) {
      const BatchSpring& spring = setup.springs[s];
      kvrs_.push_back(kvr(spring.absolute_damper ? KvrRates::none : KvrRates::from_hand));
      CouplingSpec spec;
      spec.type = spring.type;
      spec.measure = spring.measure;
      spec.treatment = spring.treatment;
      spec.springs = {
          {"spring", spring.body, cell.springs[s].p_L, cell.springs[s].k, cell.springs[s].b}};
      couplings_.push_back(make_coupling(spec, model_, *kvrs_.back()));
    }
    shown_ = kvr(KvrRates::from_hand);
  }
  OneByOne(const OneByOne&) = delete;

  BatchResult run() {
    Simulation simulation(model_, setup_.start);
    for (const auto& coupling : couplings_) simulation.add(*coupling);
    BatchResult result;
    const auto steps = static_cast<std::size_t>(std::ceil(setup_.duration / cell_.h - 1e-6));
    const auto length = [&](std::size_t n) {
      return std::min(cell_.h, setup_.duration - static_cast<double>(n) * cell_.h);
    };
    TrackingSeries series;
    series.q_K.resize(3), series.q_D.resize(3);
    const double held = held_energy(simulation);
    double work = 0, hand_work = 0;
    Powers power = powers(simulation, 1e-6);
    look(simulation, series);
    for (result.steps = 0; result.steps < steps;) {
      const double h = length(result.steps);
      simulation.step(h);
      ++result.steps;
      if (!look(simulation, series)) return result;
      const Powers before = powers(simulation, -1e-6);
      work += 0.5 * h * (power.counted + before.counted);
      hand_work += 0.5 * h * (power.hand + before.hand);
      result.hand_work_least = std::min(result.hand_work_least, hand_work);
      power = powers(simulation, 1e-6);
    }
    result.finished = true;
    result.max_error = tracking_error(series).max;
    result.mean_error = tracking_error(series).mean;
    result.energy_created = held_energy(simulation) - held - work;
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t n = 0; n <= steps; ++n) {
        std::size_t quarter = 0;
        while (n > (quarter + 1) * steps / 4) ++quarter;
        double& largest = result.window_error[quarter];
        largest = std::max(largest, std::abs(series.q_K[j][n] - series.q_D[j][n]));
      }
    return result;
  }

 private:
  const HandSource& hand() const { return *setup_.targets[0].hand; }
  Model<double> scaled() const {
    Model<double> model = *setup_.model;
    for (std::size_t i = 0; i < cell_.mass_factor.size(); ++i) {
      const double f = cell_.mass_factor[i];
      Inertia<double>& I = model.I[i];
      I = {f * I.m,
           f * I.h,
           {f * I.I.xx, f * I.I.yy, f * I.I.zz, f * I.I.xy, f * I.I.xz, f * I.I.yz}};
    }
    return model;
  }
  std::unique_ptr<KinematicRobot> kvr(KvrRates rates) const {
    auto robot = std::make_unique<KinematicRobot>(*setup_.model, hand_, HandMapping{},
                                                  setup_.targets[0].joints, rates);
    robot->stand_at(setup_.targets[0].rest);
    return robot;
  }
  bool look(const Simulation& simulation, TrackingSeries& series) {
    const State<double>& x = simulation.state();
    series.t.push_back(x.t);
    const KvrSample& target = sample(x.t, -1e-6);
    double error = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto iq = setup_.model->iq[static_cast<std::size_t>(
          setup_.model->find_joint("joint" + std::to_string(j + 1)))];
      series.q_K[j].push_back(target.x.q[iq]);
      series.q_D[j].push_back(x.q[iq]);
      error += std::abs(target.x.q[iq] - x.q[iq]);
    }
    return error < setup_.bound;
  }
  const KvrSample& sample(double t, double toward) {
    shown_->begin_step(t, toward);
    return shown_->start();
  }

  struct Ends {
    Vector3 offset = Vector3::Zero(), v_D = Vector3::Zero(), v_K = Vector3::Zero();
  };
  Ends ends(std::size_t s, const Simulation& simulation, double toward) {
    const State<double>& x = simulation.state();
    const Kinematics& k = simulation.kinematics();
    const KvrSample& K = sample(x.t, toward);
    const BatchSpring& spring = setup_.springs[s];
    const auto i = static_cast<std::size_t>(spring.body);
    Ends e;
    if (spring.type == Type::linear) {
      const Vector3 p_D = k.position(spring.body, cell_.springs[s].p_L);
      const Vector3 p_K = K.k.position(spring.body, cell_.springs[s].p_L);
      return {p_K - p_D, k.velocity(spring.body, p_D), K.k.velocity(spring.body, p_K)};
    }
    if (spring.measure == Measure::world)
      return {twinarm::rotation_vector(Matrix3(K.k.X_WL[i].R * k.X_WL[i].R.transpose())), k.w_WL[i],
              K.k.w_WL[i]};
    const std::size_t iq = model_.iq[i], iv = model_.iv[i];
    e.offset.x() = K.x.q[iq] - x.q[iq];
    e.v_D.x() = x.qd[iv];
    e.v_K.x() = K.x.qd[iv];
    return e;
  }
  struct Powers {
    double counted = 0, hand = 0;
  };
  Powers powers(const Simulation& simulation, double toward) {
    Powers sum;
    for (std::size_t d = 0; d < model_.nv; ++d)
      sum.counted -= model_.damping[d] * std::pow(simulation.state().qd[d], 2);
    for (std::size_t s = 0; s < setup_.springs.size(); ++s) {
      const Ends e = ends(s, simulation, toward);
      const Vector3 seen = setup_.springs[s].absolute_damper ? Vector3(Vector3::Zero()) : e.v_K;
      const Vector3 damper = cell_.springs[s].b * (seen - e.v_D);
      const double on_spring = cell_.springs[s].k * e.offset.dot(e.v_K);
      sum.counted += on_spring + damper.dot(e.v_D);
      sum.hand += on_spring + damper.dot(seen);
    }
    return sum;
  }
  double held_energy(const Simulation& simulation) {
    const State<double>& x = simulation.state();
    double sum = kinetic_energy(model_, x) + potential_energy(model_, x);
    for (std::size_t s = 0; s < setup_.springs.size(); ++s)
      sum += 0.5 * cell_.springs[s].k * ends(s, simulation, 1e-6).offset.squaredNorm();
    return sum;
  }

  const BatchSetup& setup_;
  const BatchCell& cell_;
  Model<double> model_;
  ShiftedHand hand_;
  std::vector<std::unique_ptr<KinematicRobot>> kvrs_;
  std::unique_ptr<KinematicRobot> shown_;
  std::vector<std::unique_ptr<Coupling>> couplings_;
};

void check_equal(const BatchResult& a, const BatchResult& b, double scale) {
  CHECK(a.steps == b.steps);
  REQUIRE(a.finished);
  REQUIRE(b.finished);
  for (std::size_t j = 0; j < 3; ++j) {
    CHECK(std::abs(a.max_error[j] - b.max_error[j]) < 1e-9);
    CHECK(std::abs(a.mean_error[j] - b.mean_error[j]) < 1e-9);
  }
  for (std::size_t q = 0; q < 4; ++q) CHECK(std::abs(a.window_error[q] - b.window_error[q]) < 1e-9);
  CHECK(std::abs(a.energy_created - b.energy_created) < 1e-9 * scale);
  CHECK(std::abs(a.hand_work_least - b.hand_work_least) < 1e-9 * scale);
}

}  // namespace

TEST_CASE("runs side by side are those of the scalar simulation, every coupling and treatment") {
  Random random(81);
  for (const Law& law : kLaws)
    for (const Treatment treatment : kTreatments)
      for (const bool absolute : {false, true}) {
        CAPTURE(law.name);
        CAPTURE(static_cast<int>(treatment));
        CAPTURE(absolute);
        const Bench bench(tree(random), law, treatment, absolute);
        std::vector<BatchCell> cells;
        for (int c = 0; c < 11; ++c) cells.push_back(bench.random_cell(random));
        std::vector<BatchResult> results(cells.size());
        BatchRun batch(bench.setup);
        batch.run(cells, results);
        for (std::size_t c = 0; c < cells.size(); ++c) {
          const BatchResult alone = OneByOne(bench.setup, cells[c]).run();
          check_equal(results[c], alone, 100);
        }
      }
}

TEST_CASE("a run that leaves all bounds stops as it does alone, and its neighbours never notice") {
  Random random(82);
  const Bench bench(tree(random), kLaws[2], Treatment::explicit_, false);
  std::vector<BatchCell> cells;
  for (int c = 0; c < 24; ++c) {
    cells.push_back(bench.random_cell(random));
    cells.back().h = 1e-3, cells.back().speed = 1, cells.back().delay = 0;
    for (auto& gains : cells.back().springs) gains.p_L = {0.1, 0, 0};
    if (c % 3 == 0)
      for (auto& gains : cells.back().springs) gains.b = 1e5;
  }
  std::vector<BatchResult> together(cells.size()), alone(cells.size());
  BatchRun batch(bench.setup);
  batch.run(cells, together);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    batch.run({&cells[c], 1}, {&alone[c], 1});
    const BatchResult scalar = OneByOne(bench.setup, cells[c]).run();
    CHECK(together[c].finished == (c % 3 != 0));
    CHECK(together[c].finished == scalar.finished);
    CHECK(together[c].steps == scalar.steps);
    CHECK(together[c].steps == alone[c].steps);
    CHECK(together[c].max_error == alone[c].max_error);
    CHECK(together[c].mean_error == alone[c].mean_error);
    CHECK(together[c].window_error == alone[c].window_error);
    CHECK(together[c].energy_created == alone[c].energy_created);
  }
}

TEST_CASE("cells are computed alike in any order") {
  Random random(83);
  const Bench bench(tree(random), kLaws[0], Treatment::implicit, false);
  std::vector<BatchCell> cells;
  for (int c = 0; c < 19; ++c) cells.push_back(bench.random_cell(random));
  std::vector<BatchResult> results(cells.size()), reversed(cells.size());
  BatchRun(bench.setup).run(cells, results);
  std::reverse(cells.begin(), cells.end());
  BatchRun(bench.setup).run(cells, reversed);
  std::reverse(reversed.begin(), reversed.end());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    CHECK(results[c].max_error == reversed[c].max_error);
    CHECK(results[c].energy_created == reversed[c].energy_created);
  }
}

TEST_CASE("the rotation vector of lanes is that of the rotations they are made from, to 1e-14") {
  Random random(84);
  using S = Batch<4>;
  for (int n = 0; n < 4000; ++n) {
    Mat3<S> R;
    std::array<Vector3, 4> phi;
    for (int lane = 0; lane < 4; ++lane) {
      const double size = n % 4 == 0   ? std::pow(10, random.uniform(-12, 0))
                          : n % 4 == 1 ? 3.14159265 - std::pow(10, random.uniform(-7, 0))
                                       : random.uniform(0, 3.14);
      phi[static_cast<std::size_t>(lane)] = size * random.vector(1).normalized();
      const Vector3& v = phi[static_cast<std::size_t>(lane)];
      const Matrix3 M = Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
      int row = 0;
      for (Vec3<S>* r : {&R.r0, &R.r1, &R.r2}) {
        r->x.set(lane, M(row, 0)), r->y.set(lane, M(row, 1)), r->z.set(lane, M(row, 2));
        ++row;
      }
    }
    const Vec3<S> found = twinarm::rotation_vector(R);
    for (int lane = 0; lane < 4; ++lane)
      CHECK((Vector3(found.x[lane], found.y[lane], found.z[lane]) -
             phi[static_cast<std::size_t>(lane)])
                .norm() < 1e-14);
  }
}

TEST_CASE("what cannot run side by side is refused, all reasons at once") {
  Random random(85);
  auto bodies = random_bodies(random, 4, {JointType::revolute});
  bodies[1].type = JointType::universal;
  bodies[2].properties.coulomb_plus = 1;
  const Model<double> model = build(bodies);
  const WavingHand hand;
  BatchSetup setup;
  setup.model = &model;
  setup.start = State<double>(model);
  setup.targets = {{&hand, {}, {{"joint1", "elbow"}, "", 0, 0}, setup.start}};
  setup.springs = {{Type::matched, Measure::world, Treatment::explicit_, false, 3, 0}};
  try {
    const BatchRun run(setup);
    FAIL("not refused");
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* fault : {"universal", "Coulomb", "elbow", "torsional and linear",
                              "no target 3", "no link that moves", "duration"}) {
      CAPTURE(fault);
      CHECK(text.find(fault) != std::string::npos);
    }
  }
}
