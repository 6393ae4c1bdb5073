// RaiSim's SimBenchmark (github.com/leggedrobotics/SimBenchmark) as in benchmarks/analytic/
// (engine_tasks.h), in every engine, without correction of overlaps. Published errors: its tables
// at 1 ms, engines of 2018.
//
// The planar chain by which Erez, Tassa and Todorov (ICRA 2015) assess smooth dynamics: without
// gravity its energy and its angular momentum about the fixed hinge are conserved. Their initial
// rates are random and not published; those used here are ours.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "benchmarks/analytic/contact/engine_tasks.h"
#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/scenes/mechanisms.h"
#include "benchmarks/scenes/scene.h"
#include "solver/linear_algebra/nan_max.h"
#include "solver/stepping/simulation.h"

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
    Body b = solid_ball(t.mass, t.half[0]);
    b.push = t.push;
    if (t.is_box) {
      const double m = t.mass, x = t.half[0], y = t.half[1], z = t.half[2];
      b.form = Form::box, b.half = t.half;
      b.inertia = {
          m * (y * y + z * z) / 3, m * (x * x + z * z) / 3, m * (x * x + y * y) / 3, 0, 0, 0};
    }
    add_free_body(scene, b, t.p);
  }
  return scene;
}

constexpr std::array<const char*, 5> kPublished = {"RaiSim", "Bullet", "ODE", "MuJoCo", "DART"};

// `published`: errors in the order of kPublished; NAN: not published.
SceneCase from_task(const Task& task, const std::array<double, 5>& published) {
  SceneCase c{task.name, "engines", task.what, task.unit, scene_of(task)};
  c.duration = task.duration;
  for (std::size_t k = 0; k < published.size(); ++k)
    if (!std::isnan(published[k])) c.published.emplace_back(kPublished[k], published[k]);
  c.judge = [task] {
    return [task, error = MeanError(task)](double t, const Values& q, const Values& v) mutable {
      std::vector<Moving> bodies;
      for (std::size_t i = 0; i < task.bodies.size(); ++i) {
        const double *p = q.data() + 7 * i, *u = v.data() + 6 * i;
        bodies.push_back({{p[0], p[1], p[2]}, {u[3], u[4], u[5]}, {u[0], u[1], u[2]}});
      }
      return error.take(t, bodies);
    };
  };
  return c;
}

constexpr double kRod = 0.2, kRodMass = 1, kRodInertia = kRodMass * kRod * kRod / 12;

struct ChainInvariants {
  double energy = 0, momentum = 0;
};
// Of rods in a row, rotating about z, the first about the origin.
ChainInvariants chain_invariants(const Values& q, const Values& v) {
  ChainInvariants result;
  double angle = 0, w = 0, x = 0, y = 0, vx = 0, vy = 0;  // of a rod and its start
  for (std::size_t i = 0; i < q.size(); ++i) {
    angle += q[i], w += v[i];
    const double cx = kRod / 2 * std::cos(angle), cy = kRod / 2 * std::sin(angle);
    x += cx, y += cy, vx -= w * cy, vy += w * cx;  // at its centre
    result.energy += (kRodMass * (vx * vx + vy * vy) + kRodInertia * w * w) / 2;
    result.momentum += kRodMass * (x * vy - y * vx) + kRodInertia * w;
    x += cx, y += cy, vx -= w * cy, vy += w * cx;  // at its end
  }
  return result;
}

SceneCase planar_chain() {
  SceneCase c{"H2-chain",
              "engines",
              "five rods in a plane without gravity, 10 s: energy, angular momentum",
              "of their values at the start",
              {}};
  c.scene.gravity.setZero();
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
  c.judge = [start = chain_invariants(c.scene.q, c.scene.v)] {
    double worst = 0;
    return [=](double, const Values& q, const Values& v) mutable {
      const ChainInvariants now = chain_invariants(q, v);
      worst = nan_max(worst, std::abs(now.energy / start.energy - 1));
      return worst = nan_max(worst, std::abs(now.momentum / start.momentum - 1));
    };
  };
  return c;
}

}  // namespace

std::vector<SceneCase> engine_cases() {
  return {from_task(rolling(false), {4.127e-7, 4.935e-9, 7.669e-9, 9.220e-3, 0.42589}),
          from_task(rolling(true), {4.137e-7, 5.707e-9, 3.14497, 6.927e-3, 3.14497}),
          from_task(bouncing(), {1.862e-2, 7.525e4, 185, NAN, 7.227e4}),
          from_task(pile(false), {1.353e-4, 0.3825, 1.546e-4, 9.501e-2, 2.824e-4}),
          from_task(pile(true), {8.368, 4.150e4, 112.3, NAN, 3.469e5}),
          planar_chain()};
}

// Motions without contacts: analytic cases (benchmarks/analytic/) with their readings, references
// and measures, and an arm of the size of a PUMA 560 released from rest, with dopri5 at 1e-14 as
// reference (accurate to about 3e-13).
//
// Cases with point masses or thin rods are omitted: MuJoCo and ODE reject such inertias.
namespace {

// Body axes, with z along the axis of a revolute.
Scene scene_of(const std::string& name, const Model<double>& model, const State<double>& start) {
  Scene scene;
  scene.gravity = to_eigen(model.gravity);
  scene.q = start.q, scene.v = start.qd;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    Body b;
    b.parent = model.parent[i] - 1;
    const JointType type = model.joint[i];
    if (type != JointType::revolute && type != JointType::spherical && type != JointType::free)
      throw std::logic_error(name + ": a joint that the engines do not share");
    b.joint = type == JointType::revolute    ? Joint::revolute
              : type == JointType::spherical ? Joint::spherical
                                             : Joint::free;
    b.position = to_eigen(model.Xtree[i].r);
    b.rotation = Eigen::Quaterniond(Matrix3(to_eigen(model.Xtree[i].E).transpose()));
    const Inertia<double>& about_joint = model.I[i];
    b.mass = about_joint.m;
    const Vector3 c = to_eigen(about_joint.h) / b.mass;
    b.com = c;
    const Sym3<double>& I = about_joint.I;
    const Matrix3 shift = b.mass * (c.dot(c) * Matrix3::Identity() - c * c.transpose());
    b.inertia = {I.xx - shift(0, 0), I.yy - shift(1, 1), I.zz - shift(2, 2),
                 I.xy - shift(0, 1), I.xz - shift(0, 2), I.yz - shift(1, 2)};
    const double largest = std::max({b.inertia[0], b.inertia[1], b.inertia[2]});
    for (std::size_t k = 0; k < 3; ++k)
      if (b.inertia[k] < 1e-9 * largest) b.inertia[k] = 1e-3 * largest;
    scene.bodies.push_back(b);
  }
  return scene;
}

// Times that are not multiples of 10 ms are omitted: only our engine can stop there.
SceneCase from_list(const std::string& name, const std::string& what, const std::string& unit,
                    bool work_precision = false) {
  for (const AnalyticCase& c : analytic_cases()) {
    if (c.name != name) continue;
    const auto motion = c.trajectory;
    const auto moving = std::make_shared<const CaseScene>(motion->scene());
    SceneCase result{name, "smooth", what, unit, scene_of(name, moving->model, moving->start)};
    for (const double t : motion->times)
      if (std::abs(t - 0.01 * std::round(100 * t)) < 1e-12) result.times.push_back(t);
    result.duration = result.times.back();
    result.judge = [motion, moving] {
      double worst = 0;
      return [=](double t, const Values& q, const Values& v) mutable {
        State<double> x(moving->model);
        x.q = q, x.qd = v, x.t = t;
        const double error =
            motion->measure(motion->observe(moving->model, x), motion->reference(t));
        return worst = nan_max(worst, error);
      };
    };
    result.work_precision = work_precision;
    return result;
  }
  throw std::logic_error("there is no case " + name);
}

SceneCase falling_puma() {
  const auto model = std::make_shared<const Model<double>>(model_of(mechanism("puma6")));
  State<double> start(*model);
  start.q = {0.3, -0.6, 0.8, 0.4, -0.5, 0.2};
  SceneCase result{"PUMA", "smooth", "an arm of the size of a PUMA 560 falls from rest, 1 s",
                   "rad, rad/s", scene_of("PUMA", *model, start)};
  result.times = {0.5, 1}, result.duration = 1;
  result.judge = [model, start] {
    const auto reference = std::make_shared<Simulation>(*model, start);
    reference->set_integrator(Integrator::dopri5, 1e-14);
    double worst = 0;
    return [=](double t, const Values& q, const Values& v) mutable {
      const State<double>& exact = reference->state();
      while (t - exact.t > 1e-12) reference->step(std::min(0.01, t - exact.t), true);
      for (std::size_t i = 0; i < model->nq; ++i) {  // the wrist exceeds a turn; ODE counts none
        const double turns = 2 * std::numbers::pi;
        worst = nan_max(worst, std::abs(std::remainder(q[i] - exact.q[i], turns)));
        worst = nan_max(worst, std::abs(v[i] - exact.qd[i]));
      }
      return worst;
    };
  };
  result.work_precision = true;
  return result;
}

}  // namespace

std::vector<SceneCase> smooth_cases() {
  return {from_list("A1", "symmetric body, free, 10 s", "rad, rad/s"),
          from_list("A2", "asymmetric body, free, 10 s", "rad, rad/s"),
          from_list("A3", "spin about the middle axis, 30 s", "rad, rad/s"),
          from_list("A4", "heavy top, its axis, 1 s", "of 1", true),
          from_list("B3", "rod from 60 degrees, 2 s", "rad, rad/s"),
          from_list("C2", "double pendulum of rods, 2 s", "rad, rad/s", true),
          falling_puma()};
}

}  // namespace twinarm::bench
