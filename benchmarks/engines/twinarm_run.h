// A scene in twinarm with every integrator; contacts by the rigid response, with fixed steps and
// with located impacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "benchmarks/engines/engine.h"
#include "benchmarks/scenes/mechanisms.h"
#include "collision/contact/contact_constraints.h"
#include "solver/stepping/simulation.h"

namespace twinarm::bench {

inline constexpr const char* kLocated = "located";  // the scheme that locates contact events

inline std::vector<Scheme> twinarm_schemes(const Scene& scene) {
  constexpr std::size_t kMaxLocated = 50;  // bodies; larger piles have too many impacts to locate
  if (scene.has_contacts() && scene.bodies.size() > kMaxLocated) return {{"semi-implicit"}};
  if (scene.has_contacts()) return {{"semi-implicit"}, {kLocated}};
  std::vector<Scheme> all{{"semi-implicit"}};
  for (const IntegratorFacts& facts : all_integrators)
    if (facts.integrator != Integrator::semi_implicit)
      all.push_back({facts.name, facts.integrator == Integrator::dopri5});
  return all;
}

// Constant forces on bodies, and the control torques.
class ScenePushes final : public ForceSource {
 public:
  explicit ScenePushes(const Scene& scene) : scene_(scene) {}
  bool is_needed() const {
    return scene_.control || std::any_of(scene_.bodies.begin(), scene_.bodies.end(),
                                         [](const Body& b) { return b.push != Numbers3{}; });
  }
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& f) noexcept override {
    if (scene_.control) {
      for (std::size_t j = 0; j < f.tau.size(); ++j)
        f.tau[j] += scene_.control->torque(j, x.q[j], x.qd[j]);
      return;
    }
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const Vector3 F_B = k.R_WB[i + 1].transpose() * vector3(scene_.bodies[i].push);
      f.f_ext[i + 1].f += from_eigen(F_B);
    }
  }

 private:
  const Scene& scene_;
};

// Contacts with timers around detection and around the solver's part between add and take.
class WatchedContacts final : public ContactConstraints {
 public:
  using ContactConstraints::ContactConstraints;
  bool watched = false;
  double detection = 0, solver = 0;  // since last reset [s]

  void begin_step(const Kinematics& k, const State<double>& x, double h) noexcept override {
    const double start = now();
    ContactConstraints::begin_step(k, x, h);
    detection += now() - start;
  }
  void add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override {
    ContactConstraints::add(frame, problem);
    added_ = now();
  }
  void take(const ConstraintFrame& frame, const ImpulseProblem& problem,
            std::size_t first) noexcept override {
    solver += now() - added_;
    ContactConstraints::take(frame, problem, first);
  }

 private:
  double now() const { return watched ? thread_seconds() : 0; }
  double added_ = 0;
};

struct TwinarmRun {
  TwinarmRun(const Scene& s, const Scheme& scheme, double h)
      : scene(s), model(model_of(s)), simulation(model, start()), pushes(scene) {
    if (scene.has_contacts()) {
      contacts.emplace(model, ContactResponse::rigid);
      add_shapes();
      simulation.add(*contacts);
      if (scheme.name == kLocated) simulation.locate_events();
    } else {
      simulation.set_integrator(find_integrator(scheme.name).value(), h);
    }
    if (pushes.is_needed()) simulation.add(pushes);
  }
  State<double> start() const {
    State<double> x(model);
    x.q = scene.q, x.qd = scene.v;
    return x;
  }
  // Friction of a pair is the geometric mean, restitution the product.
  void add_shapes() {
    ContactSurface body, fixed;
    body.friction = fixed.friction = scene.friction;
    if (scene.floor && scene.floor_friction != scene.friction)
      fixed.friction = scene.floor_friction * scene.floor_friction / scene.friction;
    body.restitution = fixed.restitution = std::sqrt(scene.restitution);
    if (scene.floor) contacts->bodies().add({"floor", 0, {}, HalfSpace{}, fixed});
    if (scene.obstacle)
      contacts->bodies().add({"obstacle",
                              0,
                              {Matrix3::Identity(), vector3(scene.obstacle->centre)},
                              Box{2 * vector3(scene.obstacle->half)},
                              fixed});
    int number = 0;
    for (const Body& b : scene.bodies) {
      ++number;
      const Pose X_LG{Matrix3::Identity(), vector3(b.form_at)};
      if (b.form == Form::sphere)
        contacts->bodies().add({"body", number, X_LG, Sphere{b.half[0]}, body});
      if (b.form == Form::box)
        contacts->bodies().add({"body", number, X_LG, Box{2 * vector3(b.half)}, body});
    }
  }

  Scene scene;
  Model<double> model;
  Simulation simulation;
  ScenePushes pushes;
  std::optional<WatchedContacts> contacts;
};

}  // namespace twinarm::bench
