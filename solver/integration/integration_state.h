// State that the integrators advance, with its force sources, prescribed motions and accelerations.
// Owned by Simulation.
#pragma once

#include <functional>
#include <optional>
#include <utility>
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

// Motion of a link on a prescribed joint, relative to the joint frame J in the parent, axes of J.
struct PrescribedMotion {
  Pose X_JL;                                       // pose of the link
  Vector3 velocity = Vector3::Zero();              // of its origin: dp/dt [m/s]
  Vector3 acceleration = Vector3::Zero();          // d^2p/dt^2 [m/s^2]
  Vector3 angular_velocity = Vector3::Zero();      // [rad/s]
  Vector3 angular_acceleration = Vector3::Zero();  // [rad/s^2]
};
// Must not throw. If it allocates, so do steps.
using MotionFunction = std::function<PrescribedMotion(double t)>;

// Writes pose, velocity and acceleration of the prescribed joint of `body` to x.
void store_motion(const Model<double>& model, std::size_t body, const PrescribedMotion& motion,
                  State<double>& x);

// Serializes q with the motion of prescribed joints (q_with_prescribed), qd and t, the layout of
// recordings. Throws std::runtime_error if the sizes do not match the model.
void visit_state(StateArchive& archive, const Model<double>& model, State<double>& x);

struct IntegrationState {
  IntegrationState(const Model<double>& model, State<double> start);

  const Model<double>& model() const { return *model_; }
  State<double> x;
  Kinematics k;         // of x
  State<double> stage;  // stage of the integrator
  Kinematics k_stage;
  Workspace<double> w;       // of the last acceleration
  Forces<double> forces;     // of the last acceleration
  ForwardDynamics dynamics;  // of the last acceleration: forces of friction, mimic joints, loops
  LoopProjection projection;
  std::optional<ConstraintWork> account;  // if enabled
  double loop_position_error = 0;         // max |g| at x after project_and_update()
  std::vector<ForceSource*> sources;
  struct PrescribedJointMotion {
    std::size_t body;
    MotionFunction motion;
  };
  std::vector<PrescribedJointMotion> prescribed_joints;

  void begin_step(double h) {
    for (ForceSource* source : sources) source->begin_step(k, x.t, h);
  }
  // w.qdd at x, with k up to date; FrictionRule::current (constrained_dynamics.h).
  void accelerate() {
    accelerate(x, k, FrictionRule::current, 0);
    start_projection();
  }
  // The same for a step v' = v + h qdd, FrictionRule::end_of_step.
  void accelerate_over(double h) {
    accelerate(x, k, FrictionRule::end_of_step, h);
    start_projection();
  }
  // w.qdd at the stage, and at x at the end of a trial step; frozen modes of the last accelerate().
  // Both set prescribed joints and kinematics first.
  void accelerate_stage();
  void accelerate_end(double t);
  // Sets mimic joints and prescribed joints at x.t, projects loops, updates k.
  void project_and_update() {
    update_kinematics();
    loop_position_error = project_loops(x, k);
  }
  void update_kinematics();  // the same without projection of loops
  // Sets the state. Throws InputError if loops are open by more than kMaxInitialError.
  void start(State<double> from);
  // Restores a state of project_and_update() bit-exactly, without projection.
  void resume(State<double> from) {
    x = std::move(from);
    forward_kinematics(*model_, x, k);
  }
  void set_loops(LoopClosures loops);  // closed at x up to kMaxInitialError
  // Loops are projected with M and J of the last acceleration at x (loop_projection.h).
  // prepare_projection() computes them if there was none; start_projection() uses those of the last
  // stage if this became x.
  void prepare_projection();
  void start_projection() {
    if (has_loops()) projection.start(dynamics.bilateral(), dynamics.sticking_dofs(x), x, k, w);
  }
  bool has_loops() const { return dynamics.bilateral().loops().any(); }

 private:
  using FrictionRule = ForwardDynamics::FrictionRule;
  void accelerate(const State<double>& at, const Kinematics& k_at, FrictionRule rule, double h);
  void set_prescribed_joints(State<double>& at) const {
    for (const PrescribedJointMotion& joint : prescribed_joints)
      store_motion(*model_, joint.body, joint.motion(at.t), at);
  }
  double project_loops(State<double>& at, Kinematics& k_at);

  const Model<double>* model_;
};

}  // namespace twinarm
