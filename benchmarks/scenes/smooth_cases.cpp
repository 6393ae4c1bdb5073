// Motions without contacts: cases of the list (benchmarks/analytic/), with their own readings,
// references and measures, and the PUMA 560's size falling from rest, whose reference is our dopri5
// to 1e-14, good to about 3e-13.
//
// Those whose bodies have no extent somewhere (point masses, thin rods) are left out: MuJoCo and
// ODE take no such inertia.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/scenes/eigen.h"
#include "benchmarks/scenes/mechanisms.h"
#include "benchmarks/scenes/scene_cases.h"
#include "benchmarks/scenes/scene_model.h"
#include "solver/stepping/simulation.h"

namespace twinarm::bench {
namespace {

Numbers3 numbers(const Vec3<double>& v) {
  return {v.x, v.y, v.z};
}

// In body axes, where the axis of a revolute is z.
Scene scene_of(const std::string& name, const Model<double>& model, const State<double>& start) {
  Scene scene;
  scene.name = name;
  scene.gravity = numbers(model.gravity);
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
    const Eigen::Quaterniond turn(Matrix3(to_eigen(model.Xtree[i].E).transpose()));
    b.position = numbers(model.Xtree[i].r);
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(b.rotation.data()) =
        turn.toRotationMatrix();
    const Inertia<double>& about_joint = model.I[i];
    b.mass = about_joint.m;
    const Vector3 c = to_eigen(about_joint.h) / b.mass;
    b.com = {c.x(), c.y(), c.z()};
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

// Times between two steps of 10 ms are left out: no engine but ours stands there.
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
      return [=](double t, const std::vector<double>& q, const std::vector<double>& v) mutable {
        State<double> x(moving->model);
        x.q = q, x.qd = v, x.t = t;
        const double error =
            motion->measure(motion->observe(moving->model, x), motion->reference(t));
        return worst = worse(worst, error);
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
  result.judge = [model, start, times = result.times] {
    auto exact = std::make_shared<std::vector<State<double>>>();
    double worst = 0;
    return [=](double t, const std::vector<double>& q, const std::vector<double>& v) mutable {
      if (exact->empty()) {
        Simulation fine(*model, start);
        fine.set_integrator(Integrator::dopri5, 1e-14);
        for (const double to : times) {
          while (to - fine.state().t > 1e-12) fine.step(std::min(0.01, to - fine.state().t), true);
          exact->push_back(fine.state());
        }
      }
      const State<double>& there = t < 0.75 ? exact->front() : exact->back();
      for (std::size_t i = 0; i < q.size(); ++i) {
        constexpr double kTurn =
            2 * std::numbers::pi;  // the wrist turns round; ODE counts no turns
        worst = worse(worst, std::abs(std::remainder(q[i] - there.q[i], kTurn)));
        worst = worse(worst, std::abs(v[i] - there.qd[i]));
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
