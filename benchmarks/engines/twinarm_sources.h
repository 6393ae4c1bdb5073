// Sources of forces and contacts of a scene in twinarm.
#pragma once

#include <algorithm>

#include "benchmarks/engines/engine.h"
#include "benchmarks/scenes/mechanisms.h"
#include "collision/contact/contact_constraints.h"
#include "solver/stepping/simulation.h"

namespace twinarm::bench {

// Constant forces on bodies, or the control torques.
inline ForceLaw pushes_of(const Scene& scene) {
  return ForceLaw([&scene](const State<double>& x, const Kinematics& k, Forces<double>& f) {
    for (std::size_t j = 0; scene.control && j < f.tau.size(); ++j)
      f.tau[j] += scene.control->torque(j, x.q[j], x.qd[j]);
    for (std::size_t i = 0; !scene.control && i < scene.bodies.size(); ++i)
      f.f_ext[i + 1].f += from_eigen(Vector3(k.R_WB[i + 1].transpose() * scene.bodies[i].push));
  });
}
inline bool has_pushes(const Scene& scene) {
  return scene.control ||
         std::ranges::any_of(scene.bodies, [](const Body& b) { return !b.push.isZero(0); });
}

// Contacts with timers around detection and the solver (from add_constraints to read_impulses).
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
  void add_constraints(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override {
    ContactConstraints::add_constraints(frame, problem);
    added_ = now();
  }
  void read_impulses(const ConstraintFrame& frame, const ImpulseProblem& problem,
                     std::size_t first) noexcept override {
    solver += now() - added_;
    ContactConstraints::read_impulses(frame, problem, first);
  }

 private:
  double now() const { return watched ? thread_seconds() : 0; }
  double added_ = 0;
};

}  // namespace twinarm::bench
