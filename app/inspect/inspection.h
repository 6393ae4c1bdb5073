// One state of one mechanism under named forces, and what aba() leaves of it.
//
// The acceleration is found once, by the aba() that all runs use, with FullTrace. Whoever pushes
// stands in a list by name; what the passes are given is the sum of the list.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/loops/loop_closure.h"
#include "solver/model/trace.h"
#include "solver/model/workspace.h"

namespace twinarm {

// One thing that pushes: a wrench, an actuator, a coupling, a contact point, a constraint. The
// implicit parts act against the acceleration that is found: f - impedance a, tau - armature qdd.
struct Actor {
  struct OnBody {
    std::size_t body;
    Force<double> f;  // body axes, about the body's origin
    ArticulatedInertia<double> impedance;
  };
  struct OnJoint {
    std::size_t dof;  // velocity index
    double tau = 0, armature = 0;
  };
  std::string source;  // as in the ledger: "wrench/0", "coupling/NAME", "joint/NAME/damping"
  std::vector<OnBody> bodies;
  std::vector<OnJoint> joints;
  // Where it acts, if at a point; and the normal of a contact. World axes.
  std::optional<Vector3> point_W{}, normal_W{};
  bool is_tie = false;  // a coupling, contact, constraint or wrench; else it acts within a joint
};

// An actor of what a source of forces added to forces that were zero.
Actor actor_of(std::string source, const Forces<double>& added);

struct Inspection {
  const Model<double>& model;
  State<double> x;
  std::vector<Actor> actors;
  std::vector<LoopClosure> loops;  // that `actors` keep closed; for a check
  Forces<double> forces;           // their sum
  Kinematics k;
  Workspace<double> w;
  FullTrace<double> trace;

  // The model must outlive it.
  Inspection(const Model<double>& model, State<double> x, std::vector<Actor> actors,
             std::vector<LoopClosure> loops = {});

  std::size_t body_count() const { return model.parent.size(); }
  std::size_t parent(std::size_t i) const { return static_cast<std::size_t>(model.parent[i]); }
  std::vector<std::size_t> children(std::size_t i) const;
  // What acts, at the acceleration that was found.
  Force<double> force_of(const Actor::OnBody& on) const {
    return on.f - on.impedance * w.a[on.body];
  }
  double torque_of(const Actor::OnJoint& on) const { return on.tau - on.armature * w.qdd[on.dof]; }
};

}  // namespace twinarm
