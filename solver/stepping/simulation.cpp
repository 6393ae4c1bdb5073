#include "solver/stepping/simulation.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "solver/loops/loop_closure.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// What a simulation is made of: not all integrators, sources of forces and sources of constraints
// go with one another. check_parts() throws std::invalid_argument where they do not.
struct StepParts {
  Integrator integrator;
  bool located;  // steps locate their events
  const std::vector<ForceSource*>& forces;
  const std::vector<ConstraintSource*>& constraints;
};

void check_integrator(const StepParts& parts) {
  const std::string name = integrator_name(parts.integrator);
  if (!parts.constraints.empty() && parts.integrator != Integrator::semi_implicit)
    throw std::invalid_argument("contacts and limits go with the integrator 'semi-implicit' only");
  if (parts.located && parts.integrator != Integrator::semi_implicit)
    throw std::invalid_argument(
        "steps that locate their events go with the integrator 'semi-implicit' only, not with '" +
        name + "'");
  for (const ForceSource* source : parts.forces)
    if (source->needs_semi_implicit() && !facts_of(parts.integrator).implicit_force)
      throw std::invalid_argument(
          "implicit spring-dampers and contacts go with the semi-implicit integrators only, not "
          "with " +
          name);
}

void check_located(const StepParts& parts) {
  for (const ForceSource* source : parts.forces)
    if (source->needs_semi_implicit())
      throw std::invalid_argument(
          "implicit spring-dampers do not go with steps that locate their events");
  for (ConstraintSource* source : parts.constraints)
    if (!source->events())
      throw std::invalid_argument("a source of constraints cannot have its events located");
}

void check_parts(const StepParts& parts) {
  check_integrator(parts);
  if (parts.located) check_located(parts);
  // Its force would be that of the first round: a wrong one, and nobody would say so.
  for (const ForceSource* source : parts.forces)
    if (!parts.constraints.empty() && source->needs_rounds())
      throw std::invalid_argument(
          "a force that is found in rounds (ForceSource::refine) does not go with contacts, limits "
          "and locks: their step has one round; give the contact as a constraint, or leave them "
          "out");
}

// What all sources remember.
std::vector<Checkpointable*> memories(const Simulation& simulation) {
  std::vector<Checkpointable*> memories;
  const auto add_all = [&](const auto& sources, const std::string& what) {
    for (auto* source : sources) {
      memories.push_back(dynamic_cast<Checkpointable*>(source));
      if (!memories.back())
        throw std::invalid_argument("a source of " + what + " does not let a step be taken back");
    }
  };
  add_all(simulation.mechanism().sources, "forces");
  add_all(simulation.constraints().system().sources, "constraints");
  return memories;
}

}  // namespace

Simulation::Simulation(const Model<double>& model, State<double> start,
                       const SimulationOptions& options)
    : m_(model, std::move(start)),
      integrator_step_(m_),
      constrained_(model),
      interrupted_(options.interrupted) {
  m_.dynamics.set_friction(options.joint_friction);
  constrained_.system().friction.set_on(options.joint_friction);
  if (options.enable_constraint_work) m_.account.emplace(model, 0, 0);
  if (options.at_instant) constrained_.constrain_accelerations();
}

void Simulation::add(ForceSource& source) {
  std::vector<ForceSource*> sources = m_.sources;
  sources.push_back(&source);
  check_parts({integrator(), located_.has_value(), sources, constrained_.system().sources});
  m_.sources = std::move(sources);
}

void Simulation::add(ConstraintSource& source) {
  std::vector<ConstraintSource*> sources = constrained_.system().sources;
  sources.push_back(&source);
  check_parts({integrator(), located_.has_value(), m_.sources, sources});
  constrained_.system().sources = std::move(sources);
}

void Simulation::locate_events() {
  check_parts({integrator(), true, m_.sources, constrained_.system().sources});
  located_.emplace(m_.model);
}

void Simulation::set_integrator(Integrator integrator, double tolerance) {
  check_parts({integrator, located_.has_value(), m_.sources, constrained_.system().sources});
  integrator_step_.set_integrator(integrator, tolerance);
}

void Simulation::set_loops(std::vector<LoopClosure> loops) {
  check_loops(m_.model, loops, m_.x);
  m_.set_loops(LoopClosures(m_.model, std::move(loops)));
  constrained_.system().bilateral.forget_loops();
  integrator_step_.forget();
}

void Simulation::prescribe(int body, MotionFunction law) {
  const auto i = static_cast<std::size_t>(body);
  if (body <= 0 || body >= m_.model.body_count() || m_.model.joint[i] != JointType::prescribed)
    throw std::invalid_argument("only the body of a prescribed joint moves by a law");
  const std::vector<IntegrationState::Drive> before = m_.drives;
  std::erase_if(m_.drives, [&](const IntegrationState::Drive& drive) { return drive.body == i; });
  m_.drives.push_back({i, std::move(law)});
  try {
    m_.start(m_.x);
  } catch (...) {
    m_.drives = before;
    throw;
  }
  integrator_step_.forget();
}

void Simulation::set_state(State<double> x) {
  if (x.q.size() != m_.model.nq || x.qd.size() != m_.model.nv || x.prescribed.size() != m_.model.np)
    throw std::invalid_argument("the state is not one of this model");
  m_.start(std::move(x));
  integrator_step_.forget();
}

void Simulation::serialize(StateArchive& memory) {
  const std::vector<Checkpointable*> all = memories(*this);
  State<double> x = m_.x;
  visit_state(memory, m_.model, x);
  if (memory.reads()) m_.resume(std::move(x));
  m_.dynamics.serialize(memory);
  integrator_step_.serialize(memory);
  constrained_.serialize(memory, m_.dynamics.bilateral().loops().rows());
  if (located_) located_->serialize(memory);
  for (Checkpointable* source : all) source->serialize(memory);
}

StepReport Simulation::step(double h, bool one_substep) {
  check_step_size(h);
  StepReport report;
  const double t = m_.x.t;
  if (m_.account) m_.account->start_step();
  if (located_) {
    located_->step(constrained_, m_, h, interrupted_, report);
  } else {
    if (has_constrained_steps()) {
      constrained_.step(m_, h, report);
      m_.x.t = t + h;
    } else {
      integrator_step_.step(m_, h, one_substep, report);
    }
    m_.refresh();
    if (m_.account) m_.account->count_projection();
  }
  report.h = m_.x.t - t;
  report.loop_position_error = m_.loop_position_error;
  report_non_finite(m_, report);
  return report;
}

State<double> side_step(const Simulation& from, double h, StepReport* report) {
  check_step_size(h);
  const SavedSources saved(memories(from));
  Simulation aside(from);
  const StepReport taken = aside.step(h);
  if (report) *report = taken;
  return aside.state();
}

IntegrationState evaluate_at(const Simulation& simulation, const State<double>& x) {
  constexpr double kMoment = 1e-6;  // [s]; tells which side of a corner of a hand's motion is meant
  const SavedSources saved(memories(simulation));
  IntegrationState aside(simulation.mechanism());
  aside.x = x;
  forward_kinematics(aside.model, aside.x, aside.k);
  aside.begin_step(kMoment);
  aside.accelerate();
  return aside;
}

}  // namespace twinarm
