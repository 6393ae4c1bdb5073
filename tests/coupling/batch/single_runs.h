// Cells of a map as single simulations, the oracle for batched runs: Simulation with its couplings;
// errors and energies are computed here from the states only.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "coupling/analysis/tracking.h"
#include "coupling/batch/batch_run.h"
#include "solver/dynamics/energy_momentum.h"
#include "tests/solver/dynamics/random_tree.h"

namespace twinarm::testing {

struct BatchLaw {
  const char* name;
  SpringKind kind;
};
inline constexpr std::array<BatchLaw, 3> kBatchLaws{
    {{"world", SpringKind::world}, {"joint", SpringKind::joint}, {"linear", SpringKind::linear}}};
inline constexpr std::array kBatchTreatments{
    Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit};

// A smooth motion of all three joints, with delay and speed factor.
class WavingHand final : public OperatorMotion {
 public:
  explicit WavingHand(double speed = 1, double delay = 0) : speed_(speed), delay_(delay) {}
  OperatorSample sample(double t, double) const override {
    OperatorSample hand;
    for (std::size_t j = 0; j < 3; ++j) {
      const double n = static_cast<double>(j), w = speed_ * (2 + n), size = 0.5 - 0.1 * n;
      const double begun = t < delay_ ? 0 : 1, phase = begun * w * (t - delay_);
      mapping_.set_robot_angle(hand, j, size * std::sin(phase), begun * size * w * std::cos(phase));
    }
    return hand;
  }
  double duration() const override { return 1; }
  std::string description() const override { return "waving"; }

 private:
  OperatorMapping mapping_;
  double speed_, delay_;
};

// Axes of the three driven revolute joints: random; parallel to an inclined first one; vertical.
enum class Axes { any, in_line, upright };
inline constexpr std::array kAxes{Axes::any, Axes::in_line, Axes::upright};

// Joints of all batchable types, fixed ones and damping; the first three are revolute.
inline Model<double> tree_for_lanes(Random& random, Axes axes) {
  auto bodies = random_bodies(
      random, 6, {JointType::revolute, JointType::prismatic, JointType::screw, JointType::fixed});
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    TreeBody& body = bodies[i];
    if (i < 3) body.type = JointType::revolute;
    if (i < 3 && axes != Axes::any) {
      body.axis = Vector3::UnitZ();
      if (i > 0) body.parent = random.integer(1, static_cast<int>(i));
      if (i > 0 || axes == Axes::upright) body.X_PJ.R = Matrix3::Identity();
    }
    if (i == 4) body.type = JointType::fixed;
    body.properties.damping = random.integer(0, 1) * random.uniform(0, 0.5);
    if (random.integer(0, 2) == 0) body.properties.armature = random.uniform(0, 0.1);
  }
  return build(bodies);
}

struct CellBench {
  Model<double> model;
  WavingHand hand;
  BatchSetup setup;
  CellBench(Model<double> of, const BatchLaw& law, Discretization discretization, bool absolute)
      : model(of) {
    setup.model = &model;
    setup.start = State<double>(model);
    BatchTarget target;
    target.motion = &hand;
    target.joints = {{"joint1", "joint2", "joint3"}, "", 0, 0};
    target.rest = State<double>(model);
    setup.targets = {target};
    for (int body = 1; body < model.body_count(); ++body) {
      const bool fixed = model.joint[static_cast<std::size_t>(body)] == JointType::fixed;
      if (fixed && law.kind == SpringKind::joint) continue;
      BatchSpring spring;
      spring.kind = law.kind;
      spring.discretization = discretization;
      spring.absolute_damper = absolute;
      spring.body = body;
      setup.springs.push_back(spring);
    }
    setup.duration = 0.4;
    for (const int body : {1, 2, 3})
      setup.measured.push_back(model.iq[static_cast<std::size_t>(body)]);
  }
  CellBench(const CellBench&) = delete;

  BatchCell random_cell(Random& random) const {
    BatchCell cell;
    cell.h = random.integer(0, 1) == 0 ? 1e-3 : 0.7e-3;
    cell.speed = random.integer(0, 1) == 0 ? 1 : 1.3;
    cell.delay = random.integer(0, 1) == 0 ? 0 : 0.0333;
    for (std::size_t s = 0; s < setup.springs.size(); ++s)
      cell.springs.push_back({random.uniform(100, 900), random.uniform(1, 8),
                              random.integer(0, 1) * Vector3(0.1, 0.2, -0.1)});
    return cell;
  }
};

// A single run of a cell.
class OneByOne {
 public:
  OneByOne(const BatchSetup& setup, const BatchCell& cell)
      : setup_(setup), cell_(cell), model_(*setup.model), hand_(cell.speed, cell.delay) {
    for (std::size_t s = 0; s < setup.springs.size(); ++s) {
      const BatchSpring& spring = setup.springs[s];
      kvrs_.push_back(kvr(spring.absolute_damper ? TargetRates::none : TargetRates::from_operator));
      CouplingSpec spec;
      if (spring.kind == SpringKind::linear) spec.type = CouplingSpec::Type::linear;
      if (spring.kind == SpringKind::joint) spec.measure = SpringSpace::joint;
      spec.discretization = spring.discretization;
      spec.springs = {
          {"spring", spring.body, cell.springs[s].p_L, cell.springs[s].k, cell.springs[s].b}};
      couplings_.push_back(make_coupling(spec, model_, *kvrs_.back()));
    }
    shown_ = kvr(TargetRates::from_operator);
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
    double work = 0, input_work = 0;
    Powers power = powers(simulation, 1e-6);
    look(simulation, series);
    for (result.steps = 0; result.steps < steps;) {
      const double h = length(result.steps);
      simulation.step(h);
      ++result.steps;
      if (!look(simulation, series)) return result;
      const Powers before = powers(simulation, -1e-6);
      work += 0.5 * h * (power.counted + before.counted);
      input_work += 0.5 * h * (power.hand + before.hand);
      result.input_work_min = std::min(result.input_work_min, input_work);
      power = powers(simulation, 1e-6);
    }
    result.finished = true;
    result.max_error = tracking_error(series).max;
    result.mean_error = tracking_error(series).mean;
    result.energy_created = held_energy(simulation) - held - work;
    for (const auto& q : series.q_K) {
      result.target_lower.push_back(*std::min_element(q.begin(), q.end()));
      result.target_upper.push_back(*std::max_element(q.begin(), q.end()));
    }
    return result;
  }

 private:
  std::unique_ptr<TargetRobot> kvr(TargetRates rates) const {
    auto robot = std::make_unique<TargetRobot>(*setup_.model, hand_, OperatorMapping{},
                                               setup_.targets[0].joints, rates);
    robot->set_pose(setup_.targets[0].rest);
    return robot;
  }
  bool look(const Simulation& simulation, TrackingSeries& series) {
    const State<double>& x = simulation.state();
    series.t.push_back(x.t);
    const TargetSample& target = sample(x.t, -1e-6);
    double error = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto iq = setup_.model->iq[static_cast<std::size_t>(
          setup_.model->find_joint("joint" + std::to_string(j + 1)))];
      series.q_K[j].push_back(target.x.q[iq]);
      series.q_D[j].push_back(x.q[iq]);
      error += std::abs(target.x.q[iq] - x.q[iq]);
    }
    return error < 1e3;
  }
  const TargetSample& sample(double t, double toward) {
    shown_->begin_step(t, toward);
    return shown_->start();
  }

  struct Ends {
    Vector3 offset = Vector3::Zero(), v_D = Vector3::Zero(), v_K = Vector3::Zero();
  };
  Ends ends(std::size_t s, const Simulation& simulation, double toward) {
    const State<double>& x = simulation.state();
    const Kinematics& k = simulation.kinematics();
    const TargetSample& K = sample(x.t, toward);
    const BatchSpring& spring = setup_.springs[s];
    const auto i = static_cast<std::size_t>(spring.body);
    Ends e;
    if (spring.kind == SpringKind::linear) {
      const Vector3 p_D = k.position(spring.body, cell_.springs[s].p_L);
      const Vector3 p_K = K.k.position(spring.body, cell_.springs[s].p_L);
      return {p_K - p_D, k.velocity(spring.body, p_D), K.k.velocity(spring.body, p_K)};
    }
    if (spring.kind == SpringKind::world)
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
  const Model<double>& model_;
  WavingHand hand_;
  std::vector<std::unique_ptr<TargetRobot>> kvrs_;
  std::unique_ptr<TargetRobot> shown_;
  std::vector<std::unique_ptr<Coupling>> couplings_;
};

}  // namespace twinarm::testing
