// A mechanism as the integrators see it: where it is, what pushes and drives it, and the
// acceleration at any other state. Simulation owns one; the integrators move it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/forces/force_source.h"
#include "solver/integration/constraint_work.h"
#include "solver/loops/constrained_dynamics.h"
#include "solver/loops/loop_projection.h"
#include "solver/model/model.h"
#include "solver/model/workspace.h"
#include "solver/spatial/pose.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// The motion of a link on a prescribed joint, relative to the joint's frame in the parent, and in
// that frame's axes: what one would write down, or measure, standing there.
struct PrescribedMotion {
  Pose X_JL;                               // where the link is
  Vector3 velocity = Vector3::Zero();      // of its origin: dp/dt [m/s]
  Vector3 acceleration = Vector3::Zero();  // d^2p/dt^2 [m/s^2]
  Vector3 angular_velocity = Vector3::Zero();
  Vector3 angular_acceleration = Vector3::Zero();
};
// The motion at a time. Must not throw; whether a step allocates is then the law's affair.
using MotionFunction = std::function<PrescribedMotion(double t)>;

// Writes pose, velocity and acceleration of the prescribed joint of this body.
void store_motion(const Model<double>& model, std::size_t body, const PrescribedMotion& motion,
                  State<double>& x);

// q with the motion of prescribed joints (q_with_prescribed), qd and t, as recordings have them.
// Throws std::runtime_error where what is read is not a state of this model.
void visit_state(StateArchive& memory, const Model<double>& model, State<double>& x);

struct IntegrationState {
  IntegrationState(const Model<double>& model, State<double> start);

  const Model<double>& model;
  State<double> x;      // where the mechanism is
  Kinematics k;         // of x
  State<double> stage;  // where a stage of a step looks
  Kinematics k_stage;
  Workspace<double> w;       // of the last acceleration
  Forces<double> forces;     // likewise
  ForwardDynamics dynamics;  // likewise: friction, followers' and loops' forces
  LoopProjection projection;
  std::optional<ConstraintWork> account;  // where the ledgers ask for it
  double loop_position_error = 0;         // at x: the largest row of g that refresh() left
  std::vector<ForceSource*> sources;
  struct Drive {
    std::size_t body;
    MotionFunction law;
  };
  std::vector<Drive> drives;

  void begin_step(double h) {
    for (ForceSource* source : sources) source->begin_step(k, x.t, h);
  }
  // w.qdd at x, whose k is up to date; Coulomb friction `now` (constrained_dynamics.h).
  void accelerate() {
    accelerate(x, k, Rule::now, 0);
    start_projection();
  }
  // The same over a step of h that changes velocities by h qdd: friction at the end of it.
  void accelerate_over(double h) {
    accelerate(x, k, Rule::end_of_step, h);
    start_projection();
  }
  // At the stage, and at x where a trial of the step ends: friction as chosen by accelerate(). The
  // drives and kinematics are set first.
  void accelerate_stage();
  void accelerate_end(double t);
  // Followers to their leaders, drives to where their laws say at x.t, loops closed; then k.
  void refresh();
  // The same, but loops as they are.
  void place_and_look();
  // At another state. Throws InputError where loops are open there by more than a small rest.
  void start(State<double> from);
  // Where it stood after refresh(), not placed again: no bit changes.
  void resume(State<double> from);
  void set_loops(LoopClosures loops);  // closed where the mechanism stands; their rest goes
  // Loops are projected along the M and J of the last acceleration at x (loop_projection.h). Where
  // none was asked for, prepare_projection() finds them; where the last stage became x,
  // start_projection() takes its.
  void prepare_projection();
  void start_projection() {
    if (has_loops()) projection.start(dynamics.bilateral(), dynamics.at_rest(x), x, k, w);
  }
  bool has_loops() const { return dynamics.bilateral().loops().any(); }

 private:
  using Rule = ForwardDynamics::Rule;
  void accelerate(const State<double>& at, const Kinematics& k_at, Rule rule, double h);
  void place(State<double>& at) const;
  double close(State<double>& at, Kinematics& k_at);
};

}  // namespace twinarm
