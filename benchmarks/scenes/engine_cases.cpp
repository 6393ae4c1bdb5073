// RaiSim's SimBenchmark (github.com/leggedrobotics/SimBenchmark) as benchmarks/analytic/ has it
// (engine_tasks.h), in every engine; overlaps are not corrected, as there. The published errors are
// those of its tables at 1 ms, by engines of 2018.
//
// And the planar chain by which Erez, Tassa and Todorov (ICRA 2015) judge the smooth part of
// engines: without gravity its energy and its angular momentum about the fixed hinge stay. Their
// numbers are of rates that were drawn and are not published: the rates here are ours.
#include "benchmarks/analytic/contact/engine_tasks.h"

#include <cmath>
#include <memory>

#include "benchmarks/scenes/scene_cases.h"
#include "solver/linear_algebra/nan_max.h"

namespace twinarm::bench {
namespace {

using namespace engine_tasks;
using Values = std::vector<double>;

Scene scene_of(const Task& task) {
  Scene scene;
  scene.floor = scene.uncorrected = true;
  scene.floor_friction = task.floor_friction, scene.friction = task.friction;
  scene.restitution = task.restitution;
  for (const TaskBody& t : task.bodies) {
    Body b;
    b.mass = t.mass, b.half = t.half, b.push = t.push;
    const double m = t.mass, x = t.half[0], y = t.half[1], z = t.half[2];
    if (t.is_box) {
      b.form = Form::box;
      b.inertia = {
          m * (y * y + z * z) / 3, m * (x * x + z * z) / 3, m * (x * x + y * y) / 3, 0, 0, 0};
    } else {
      b.form = Form::sphere;
      b.inertia = {0.4 * m * x * x, 0.4 * m * x * x, 0.4 * m * x * x, 0, 0, 0};
    }
    scene.bodies.push_back(b);
    scene.q.insert(scene.q.end(), {t.p[0], t.p[1], t.p[2], 1, 0, 0, 0});
    scene.v.insert(scene.v.end(), 6, 0.0);
  }
  return scene;
}

SceneCase from_task(const Task& task, std::vector<std::pair<std::string, double>> published) {
  SceneCase c{task.name, "engines", task.what, task.unit, scene_of(task)};
  c.duration = task.duration;
  c.published = std::move(published);
  c.judge = [task] {
    auto error = std::make_shared<MeanError>(task);
    return [task, error](double t, const Values& q, const Values& v) {
      std::vector<Moving> bodies;
      for (std::size_t i = 0; i < task.bodies.size(); ++i) {
        const double *p = q.data() + 7 * i, *u = v.data() + 6 * i;
        bodies.push_back({{p[0], p[1], p[2]}, {u[3], u[4], u[5]}, {u[0], u[1], u[2]}});
      }
      return error->take(t, bodies);
    };
  };
  return c;
}

constexpr double kRod = 0.2, kRodMass = 1, kRodInertia = kRodMass * kRod * kRod / 12;

struct Kept {
  double energy = 0, momentum = 0;
};
// Of rods in a row that turn about z, the first about the origin.
Kept kept_of(const Values& q, const Values& v) {
  Kept kept;
  double angle = 0, w = 0, x = 0, y = 0, vx = 0, vy = 0;  // of a rod, of where it begins
  for (std::size_t i = 0; i < q.size(); ++i) {
    angle += q[i], w += v[i];
    const double cx = kRod / 2 * std::cos(angle), cy = kRod / 2 * std::sin(angle);
    x += cx, y += cy, vx -= w * cy, vy += w * cx;  // to its centre
    kept.energy += (kRodMass * (vx * vx + vy * vy) + kRodInertia * w * w) / 2;
    kept.momentum += kRodMass * (x * vy - y * vx) + kRodInertia * w;
    x += cx, y += cy, vx -= w * cy, vy += w * cx;  // and to its end
  }
  return kept;
}

SceneCase planar_chain() {
  SceneCase c{"H2-chain",
              "engines",
              "five rods in a plane without gravity, 10 s: energy, angular momentum",
              "of their values at the start",
              {}};
  c.scene.gravity = {};
  for (int i = 0; i < 5; ++i) {
    Body rod;
    rod.parent = i - 1, rod.joint = Joint::revolute;
    rod.position = {i > 0 ? kRod : 0, 0, 0};
    rod.mass = kRodMass, rod.com = {kRod / 2, 0, 0};
    rod.inertia = {1e-2 * kRodInertia, kRodInertia, kRodInertia, 0, 0, 0};
    c.scene.bodies.push_back(rod);
  }
  c.scene.q = {0.3, -0.8, 0.5, 1.1, -0.4};
  c.scene.v = {1.3, -2.1, 3.2, 0.7, -1.6};
  c.duration = 10;
  c.judge = [start = kept_of(c.scene.q, c.scene.v)] {
    double worst = 0;
    return [=](double, const Values& q, const Values& v) mutable {
      const Kept now = kept_of(q, v);
      worst = worse(worst, std::abs(now.energy / start.energy - 1));
      return worst = worse(worst, std::abs(now.momentum / start.momentum - 1));
    };
  };
  return c;
}

}  // namespace

std::vector<SceneCase> engine_cases() {
  return {from_task(rolling(false), {{"RaiSim", 4.127e-7},
                                     {"Bullet", 4.935e-9},
                                     {"ODE", 7.669e-9},
                                     {"MuJoCo", 9.220e-3},
                                     {"DART", 0.42589}}),
          from_task(rolling(true), {{"RaiSim", 4.137e-7},
                                    {"Bullet", 5.707e-9},
                                    {"ODE", 3.14497},
                                    {"MuJoCo", 6.927e-3},
                                    {"DART", 3.14497}}),
          from_task(bouncing(),
                    {{"RaiSim", 1.862e-2}, {"Bullet", 7.525e4}, {"ODE", 185}, {"DART", 7.227e4}}),
          from_task(pile(false), {{"RaiSim", 1.353e-4},
                                  {"Bullet", 0.3825},
                                  {"ODE", 1.546e-4},
                                  {"MuJoCo", 9.501e-2},
                                  {"DART", 2.824e-4}}),
          from_task(pile(true),
                    {{"RaiSim", 8.368}, {"Bullet", 4.150e4}, {"ODE", 112.3}, {"DART", 3.469e5}}),
          planar_chain()};
}

}  // namespace twinarm::bench
