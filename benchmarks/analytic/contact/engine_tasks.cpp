#include "benchmarks/analytic/contact/engine_tasks.h"

#include <random>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm::engine_tasks {
namespace {

double energy_of(const Task& task, const std::vector<Moving>& bodies) {
  double energy = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Moving& b = bodies[i];
    const double m = task.bodies[i].mass, r = task.bodies[i].half[0];
    energy += m * kGravity * b.p[2] + m / 2 * b.v.squaredNorm() + m * r * r / 5 * b.w.squaredNorm();
  }
  return energy;
}

// Sum of the squared overlaps of balls with each other and with the floor.
double overlap_of(const Task& task, const std::vector<Moving>& bodies) {
  const double r = task.bodies[0].half[0];
  double sum = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vector3 p = bodies[i].p;
    const double below = std::max(0.0, r - p.z());
    sum += below * below;
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const double apart = (bodies[j].p - p).squaredNorm();
      if (apart >= 4 * r * r) continue;
      const double depth = 2 * r - std::sqrt(apart);
      sum += depth * depth;
    }
  }
  return sum;
}

Shape shape_of(const TaskBody& b) {
  if (b.is_box) return Box{2 * b.half};
  return Sphere{b.half[0]};
}
TaskBody ball(double mass, double radius, const Vector3& p) {
  return {false, {radius, radius, radius}, mass, p};
}

// Mean error of a task in twinarm, steps of 1 ms, measured against the values of `truth`.
double error_of(const Task& task, const Task& truth) {
  ContactScene scene;
  const double e = std::sqrt(task.restitution), mu = task.friction;
  // a pair takes the geometric mean of the frictions
  scene.add_floor(surface(mu > 0 ? task.floor_friction * task.floor_friction / mu : 0, e));
  for (const TaskBody& b : task.bodies) scene.add({shape_of(b), surface(mu, e), b.mass, b.p});
  scene.start();
  // Body frames have their origin at the centre.
  scene.apply([&task](const auto&, const Kinematics& k, Forces<double>& forces) {
    for (std::size_t i = 0; i < task.bodies.size(); ++i)
      forces.f_ext[i + 1].f += from_eigen(k.R_WB[i + 1].transpose() * task.bodies[i].push);
  });
  MeanError error(truth);
  std::vector<Moving> bodies(task.bodies.size());
  double mean = NAN;
  for (long n = 1; n <= std::lround(task.duration / kStep); ++n) {
    if (!scene.step(kStep)) return NAN;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const int b = static_cast<int>(i) + 1;
      bodies[i] = {scene.p(b), scene.v(b), scene.w(b)};
    }
    mean = error.take(scene.t(), bodies);
  }
  return mean;
}

// The beginning of a task, for `twinarm compare`; scripts/measure/peers runs all of it.
Task first(double seconds, Task task) {
  task.duration = seconds;
  return task;
}

// Mutants: 0.1 % of mass or restitution, 5 % of the radius.
Task smaller(Task task) {
  for (TaskBody& b : task.bodies) b.half *= 0.95;
  return task;
}
Task heavier(Task task) {
  for (TaskBody& b : task.bodies) b.mass *= 1.001;
  return task;
}
Task less_elastic(Task task) {
  task.restitution *= 0.999;
  return task;
}

using contact_plots::place, contact_plots::Scene, contact_plots::Values;
using Plot = ContactCasePlot;

// ---- plots ----

constexpr const char* kPublished =
    "Only the step of the published figures, 1 ms, is run; other engines: "
    "docs/understand/accuracy_vs_other_engines.md.";
// Of the box, pulled by 150 N, and of the ball in a corner.
double exact_box_and_ball(std::size_t k, double t) {
  const double net = 150 - 0.4 * (10 + 25) * kGravity, ball = net / 10 / (3.5 + 25 / 10.);
  return t * (k == 0 ? (net - 25 * ball) / 10 : ball);
}
// Fall of 4.9 m, e = 1.
double exact_bouncing(std::size_t, double t) {
  const double fall = std::sqrt(2 * 4.9 / kGravity), since = std::remainder(t, 2 * fall);
  return 5 - kGravity * since * since / 2;
}

AnalyticCase task_case(const char* name, double tolerance, const Task& task, const Task& mutant,
                       const Plot& plot) {
  AnalyticCase c(name, tolerance, [=](bool is_mutant) {
    return CaseResult{error_of(is_mutant ? mutant : task, task)};
  });
  c.plot = std::make_shared<const Plot>(plot.without_convergence(kPublished));
  return c;
}

}  // namespace

Task rolling(bool diagonal) {
  constexpr double m = 1, M = 10, n = 25, F = 150, mu = 0.4, r = 0.5;
  Task task{diagonal ? "H1-rolling-xy" : "H1-rolling-y",
            "a box with 25 balls on it is pulled over the floor for 4 s",
            "(m/s)^2, box and a ball, mean"};
  task.floor_friction = mu, task.friction = 0.8, task.duration = 4;
  task.measure = Measure::velocity;
  const Vector3 along = diagonal ? Vector3(0.5, std::sqrt(0.75), 0) : Vector3::UnitY();
  const double f1 = mu * (M + n * m) * kGravity, f2 = (F - f1) / M / (3.5 / m + n / M);
  task.bodies.push_back({true, {10, 10, 0.5}, M, {0, 0, 0.5}, F * along});
  task.box_rate = (F - f1 - n * f2) / M * along;
  task.ball_rate = f2 / m * along;
  for (int i = 0; i < 25; ++i)
    task.bodies.push_back(ball(m, r, {2.0 * (i % 5 - 2), 2.0 * (i / 5 - 2), 1 + r}));
  return task;
}

Task bouncing() {
  Task task{"H1-bouncing", "49 balls fall from 5 m, e = 1, for 20 s", "J^2, mean"};
  task.restitution = 1, task.duration = 20;
  for (int i = 0; i < 49; ++i)
    task.bodies.push_back(ball(10, 0.1, {2.0 * (i % 7), 2.0 * (i / 7), 5}));
  task.energy = 49 * 10 * kGravity * 5;
  return task;
}

Task pile(bool elastic) {
  Task task{elastic ? "H1-666-elastic" : "H1-666",
            elastic ? "216 balls fall from 1.101 m, e = 1, for 10 s"
                    : "216 balls fall from 1.101 m, e = 0, for 15 s",
            elastic ? "J^2, mean" : "m^2 of overlaps, mean"};
  task.restitution = elastic ? 1 : 0, task.duration = elastic ? 10 : 15;
  task.measure = elastic ? Measure::energy : Measure::overlap;
  std::mt19937 random(42);
  const auto shift = [&random] { return 1e-3 * static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) {
        const double x = 0.21 * i + shift(), y = 0.21 * j + shift();
        task.bodies.push_back(ball(10, 0.1, {x, y, 1.101 + 0.21 * k + shift()}));
      }
  for (const TaskBody& b : task.bodies) task.energy += b.mass * kGravity * b.p[2];
  return task;
}

double MeanError::take(double t, const std::vector<Moving>& bodies) {
  sum_ += now(t, bodies), ++count_;
  return sum_ / static_cast<double>(count_);
}

double MeanError::now(double t, const std::vector<Moving>& bodies) const {
  switch (task_.measure) {
    case Measure::velocity:
      return (bodies[0].v - t * task_.box_rate).squaredNorm() +
             (bodies[1].v - t * task_.ball_rate).squaredNorm();
    case Measure::overlap:
      return overlap_of(task_, bodies);
    case Measure::energy:
      break;
  }
  return std::pow(energy_of(task_, bodies) - task_.energy, 2);
}

}  // namespace twinarm::engine_tasks

namespace twinarm {

CaseFamily engine_tasks_cases() {
  using namespace engine_tasks;
  const auto read_speeds = [](Scene s) { return Values{s.v(1).norm(), s.v(2).norm()}; };
  const auto read_heights = [](Scene s) { return Values{s.p(1).z(), s.p(216).z()}; };
  const Plot speeds{{"box [m/s]", "ball [m/s]"}, read_speeds, exact_box_and_ball};
  const Plot heights{{"first ball [m]", "last ball [m]"}, read_heights};
  const Task part = first(0.55, pile(false)), elastic = first(2, pile(true));
  return {380,
          {task_case("H1-rolling-y", 1e-6, rolling(false), heavier(rolling(false)), speeds),
           task_case("H1-rolling-xy", 1e-6, rolling(true), heavier(rolling(true)), speeds),
           task_case("H1-bouncing", 0.1, bouncing(), less_elastic(bouncing()),
                     Plot{{"height [m]"}, place<1, 2>, exact_bouncing}.with(&Plot::until, 8)),
           task_case("H1-666", 1e-3, part, smaller(part), heights),
           task_case("H1-666-elastic", 50, elastic, less_elastic(elastic), heights)}};
}

}  // namespace twinarm
