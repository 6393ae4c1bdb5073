// One step, in the order that the data flows:
//
//   kinematics -> sources (targets, contacts, forces) -> ABA (+ implicit terms, joint friction,
//   mimics, loops) -> integrate -> report
//
// step() never allocates, and throws for a step size alone. The same inputs give the same bits.
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
  bool joint_friction = true;  // false: no joint has damping or Coulomb friction
  bool enable_constraint_work =
      false;  // mechanism().account: what constraints did in the last step
  // Constraints give the forces of this instant (ConstrainedStep::constrain_accelerations).
  bool at_instant = false;
  // Asked within steps that locate their events, which may be long; true ends the step
  // (StepReport::interrupted), and the state stands before its end.
  EventStep::Interrupted interrupted = nullptr;
};

class Simulation {
 public:
  // The model must outlive the simulation; so must the sources.
  Simulation(const Model<double>& model, State<double> start,
             const SimulationOptions& options = {});
  // Throws std::invalid_argument for a source that cannot go with the integrator, or that needs
  // rounds where there are constraints.
  void add(ForceSource& source);
  // Contacts, limits, locks: from now on a step is one of solver/stepping/constrained_step.h, which
  // goes with the semi-implicit integrator alone and has one round of forces. Throws likewise.
  void add(ConstraintSource& source);
  bool has_constrained_steps() const { return !constrained_.system().sources.empty(); }
  // Constrained steps locate their events in time and are of high order between them
  // (solver/stepping/event_driven_step.h), to 1e-10. Throws std::invalid_argument where a source is
  // implicit in the step, or has no events(), or where the integrator is not semi-implicit; then
  // so does set_integrator() with another one.
  void locate_events();
  // Bilateral constraints, in place of those before. Throws InputError with all faults; loops must
  // be closed where the mechanism stands (close_loops finds such a place).
  // Velocities that they do not allow go to the nearest that they do, as in an impact. From then
  // on set_state and prescribe throw likewise where they would open a loop.
  void set_loops(std::vector<LoopClosure> loops);
  // `tolerance`: of dopri5, relative and absolute.
  void set_integrator(Integrator integrator, double tolerance = 1e-9);
  // The prescribed joint that carries the body moves by this law, from now on.
  void prescribe(int body, MotionFunction law);
  // Elsewhere, at another time; followers go to their leaders. What sources remember is left alone.
  void set_state(State<double> x);

  // By exactly h. Only dopri5 may stand before it, and then says so (StepReport::reached); with
  // `one_substep` it takes one, of the size that its tolerance asks for, at most h. StepReport::h
  // says how far the step went. Throws InputError for an h that is not positive and finite; nothing
  // has changed.
  StepReport step(double h, bool one_substep = false);
  // All that the next step reads: the state, and what integrator, impulses and sources remember.
  // Taken back in a simulation that was built alike, the run goes on with the same bits. Throws
  // std::runtime_error where it was not, std::invalid_argument as side_step().
  void serialize(StateArchive& memory);

  const State<double>& state() const { return m_.x; }
  const Kinematics& kinematics() const { return m_.k; }  // of state()
  // Workspace, forces, friction, followers' and loops' forces: of the last step's last ABA.
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

// Where a step of h would lead; the run is not changed, down to the last bit. For samples between
// the steps. Throws as step(), and std::invalid_argument for a source that is not Rewindable. May
// allocate. It uses the sources, and restores them: not for several threads at once.
State<double> side_step(const Simulation& from, double h, StepReport* report = nullptr);
// A copy that stands at x, after one evaluation of all forces there by no step's rule; contacts and
// limits take no part. Sources, and what it throws, as in side_step(). May allocate.
IntegrationState evaluate_at(const Simulation& simulation, const State<double>& x);

}  // namespace twinarm
