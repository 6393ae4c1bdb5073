// Simulation of a model with force sources and constraints. Data flow of a step:
//
//   kinematics -> sources (targets, contacts, forces) -> ABA (+ implicit terms, joint friction,
//   mimic joints, loops) -> integrator -> report
//
// step() throws for an invalid step size, and for constraints on a robot of too many joints
// (KinematicTrees::kMaxEntries). It allocates until warm, that is while contacts and
// constraints outnumber those before; sources are noexcept: out of memory there ends the program.
// Results are bit-reproducible.
#pragma once

#include <optional>
#include <vector>

#include "solver/forces/force_source.h"
#include "solver/integration/integrator_step.h"
#include "solver/stepping/constrained_step.h"
#include "solver/stepping/event_driven_step.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

struct SimulationOptions {
  bool joint_friction = true;           // false: no damping or Coulomb friction in joints
  bool enable_constraint_work = false;  // compute mechanism().account (constraint_work.h)
  // Constraint forces at this instant (ConstrainedStep::constrain_accelerations).
  bool at_instant = false;
  // Called within event-driven steps, which may be long; true ends the step early
  // (StepReport::interrupted).
  EventStep::Interrupted interrupted = nullptr;
};

class Simulation {
 public:
  // Model and sources must outlive the simulation.
  Simulation(const Model<double>& model, State<double> start,
             const SimulationOptions& options = {});
  // Throws std::invalid_argument if the source is incompatible with the integrator, or needs
  // iterations although there are constraint sources.
  void add(ForceSource& source);
  // Contacts, limits, locks: steps are then those of solver/stepping/constrained_step.h, which
  // require the semi-implicit integrator and force sources without iterations. Throws likewise.
  void add(ConstraintSource& source);
  bool has_constrained_steps() const { return !constrained_.system().sources.empty(); }
  // Event-driven steps (solver/stepping/event_driven_step.h), tolerance 1e-10. Throws
  // std::invalid_argument if a source is implicit in the step or has no events(), or if the
  // integrator is not semi-implicit (also set_integrator() from then on).
  void locate_events();
  // Of the impulses of contacts and limits: ConstraintSystem::set_effort().
  void set_impulse_effort(double accuracy, double budget) {
    constrained_.system().set_effort(accuracy, budget);
  }
  // Islands at rest are put to sleep (island_sleep.h): largest velocity at rest [m/s, rad/s].
  // Throws std::invalid_argument after locate_events().
  void set_sleep(double speed);
  // Replaces the loop closures. Throws InputError with all errors; loops must be closed at the
  // current state (close_loops()). Velocities are projected, as in an impact. From then on
  // set_state() and prescribe() throw if they open a loop.
  void set_loops(std::vector<LoopClosure> loops);
  // `tolerance`: of dopri5, relative and absolute.
  void set_integrator(Integrator integrator, double tolerance = 1e-9);
  // Sets the motion of a prescribed joint, given by its child body.
  void prescribe(int body, MotionFunction motion);
  // Sets state and time; mimic joints are updated. The internal state of sources is unchanged.
  void set_state(State<double> x);

  // Advances by h. Only dopri5 may end early (StepReport::reached, StepReport::h); with
  // `one_substep` it takes one accepted substep of at most h. Throws InputError, without any
  // change, unless h is positive and finite; in the middle of the step as said above.
  StepReport step(double h, bool one_substep = false);
  // All inputs of the next step: state, and internal state of integrator, impulse solver and
  // sources. A simulation that is built equally continues bit-identically. Throws
  // std::runtime_error if it is not, half restored; std::invalid_argument as side_step().
  void serialize(StateArchive& archive);

  const State<double>& state() const { return m_.x; }
  const Kinematics& kinematics() const { return m_.k; }  // of state()
  // Workspace, forces, friction and constraint forces of the last ABA of the last step.
  const IntegrationState& mechanism() const { return m_; }
  const ConstrainedStep& constraints() const { return constrained_; }  // of the last step
  Integrator integrator() const { return integrator_step_.integrator(); }

 private:
  IntegrationState m_;
  IntegratorStep integrator_step_;
  ConstrainedStep constrained_;
  std::optional<EventStep> located_;
  EventStep::Interrupted interrupted_;
};

// Result of a step h without changing the simulation; for samples between steps. Throws as step(),
// and std::invalid_argument for a source that is not Checkpointable. May allocate. Uses and
// restores the sources: not thread-safe. copy: memory for further calls, at first empty.
State<double> side_step(const Simulation& from, double h, StepReport* report = nullptr,
                        std::optional<Simulation>* copy = nullptr);
// `copy` of this simulation's mechanism, at first empty, at state x after one evaluation of all
// forces, without contacts and limits. Sources and exceptions as in side_step(). May allocate.
void evaluate_at(const Simulation& simulation, const State<double>& x,
                 std::optional<IntegrationState>& copy);

}  // namespace twinarm
