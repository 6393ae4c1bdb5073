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

class Simulation {
 public:
  // The model must outlive the simulation; so must the sources.
  Simulation(const Model<double>& model, State<double> start);
  // Throws std::invalid_argument for a source that cannot go with the integrator, or that needs
  // rounds where there are constraints.
  void add(ForceSource& source);
  // Contacts, limits, locks: from now on a step is one of solver/stepping/constrained_step.h, which
  // goes with the semi-implicit integrator alone and has one round of forces. Throws likewise.
  void add(ConstraintSource& source);
  // Such steps without any source too: they keep the energy and the angular momentum of free bodies
  // in flight.
  void set_constrained_steps(bool on);
  bool has_constrained_steps() const {
    return always_constrained_ || !constraint_sources().empty();
  }
  // Constrained steps locate their events in time and are of high order between them
  // (solver/stepping/event_driven_step.h), to 1e-10. Throws std::invalid_argument where a source is
  // implicit in the step, or is no EventSource, or where the integrator is not semi-implicit; then
  // so does set_integrator() with another one.
  void locate_events();
  // Asked within steps that locate their events, which may be long; true ends the step
  // (StepReport::interrupted), and the state stands before its end.
  void set_interrupted(EventStep::Interrupted ask) { interrupted_ = ask; }
  // Bilateral constraints, in place of those before. Throws InputError with all faults; loops must
  // be closed where the mechanism stands (close_loops finds such a place).
  // Velocities that they do not allow go to the nearest that they do, as in an impact. From then
  // on set_state and prescribe throw likewise where they would open a loop.
  void set_loops(std::vector<LoopClosure> loops);
  void set_integrator(Integrator integrator);
  // Of dopri5, relative and absolute.
  void set_tolerance(double tolerance) { integrator_step_.set_tolerance(tolerance); }
  // The prescribed joint that carries the body moves by this law, from now on.
  void prescribe(int body, MotionLaw law);
  // From now on account() says what constraints did in the last step. After set_loops().
  void keep_account() {
    const LoopClosures& loops = m_.dynamics.bilateral().loops();
    m_.account.emplace(m_.model, loops.loops().size(), loops.rows());
  }
  const StepAccount& account() const { return *m_.account; }
  // Off: as if no joint had damping or Coulomb friction.
  void set_joint_friction(bool on) {
    m_.dynamics.set_friction(on);
    constrained_.system().friction.set_on(on);
  }
  // Elsewhere, at another time; followers go to their leaders. What sources remember is left alone.
  void set_state(State<double> x);

  // By exactly h. Only dopri5 may stand before it, and then says so (StepReport::reached). This and
  // the two below throw InputError for an h that is not positive and finite; nothing has changed.
  StepReport step(double h);
  // By one substep of dopri5, of the size that its tolerance asks for, at most h; other integrators
  // take the whole of h. StepReport::h says how far it went.
  StepReport substep(double h);
  // Where a step of h would lead; the run is not changed, down to the last bit. For samples between
  // the steps. Throws std::invalid_argument for a source that is not Rewindable. May allocate. It
  // uses the sources, and restores them: not for several threads at once.
  State<double> side_step(double h, StepReport* report = nullptr) const;
  // `see` gets a copy that stands at x, after one evaluation of all forces there by no step's rule;
  // contacts and limits take no part. Throws as side_step(), and what `see` throws. May allocate.
  // Sources as in side_step().
  void evaluate_at(const State<double>& x, const std::function<void(const Simulation&)>& see) const;
  // All that the next step reads: the state, and what integrator, impulses and sources remember.
  // Taken back in a simulation that was built alike, the run goes on with the same bits. Throws
  // std::runtime_error where it was not, std::invalid_argument as side_step().
  void visit_memory(Memory& memory);

  const Model<double>& model() const { return m_.model; }
  const State<double>& state() const { return m_.x; }
  const Kinematics& kinematics() const { return m_.k; }        // of state()
  const Workspace<double>& workspace() const { return m_.w; }  // of the last step's last ABA
  const Forces<double>& forces() const { return m_.forces; }   // likewise
  // Friction, followers' and loops' forces, likewise.
  const ForwardDynamics& dynamics() const { return m_.dynamics; }
  // Where there are constraints: of the last step.
  void constrain_accelerations() { constrained_.constrain_accelerations(); }
  const ConstrainedStep& constraints() const { return constrained_; }
  Integrator integrator() const { return integrator_step_.integrator(); }

 private:
  StepReport advance(double h, bool one_substep);
  std::vector<Rewindable*> memories() const;
  const std::vector<ConstraintSource*>& constraint_sources() const {
    return constrained_.system().sources;
  }

  Mechanism m_;
  IntegratorStep integrator_step_;
  ConstrainedStep constrained_;
  bool always_constrained_ = false;
  std::optional<EventStep> located_;
  EventStep::Interrupted interrupted_ = nullptr;
};

}  // namespace twinarm
