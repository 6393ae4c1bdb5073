#include "solver/stepping/simulation.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "solver/loops/loop_closure.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

struct StepParts {
  Integrator integrator;
  bool located;  // event-driven steps
  const std::vector<ForceSource*>& forces;
  const std::vector<ConstraintSource*>& constraints;
};

// Throws std::invalid_argument for incompatible parts.
void check_parts(const StepParts& parts) {
  const std::string name = integrator_name(parts.integrator);
  if (!parts.constraints.empty() && parts.integrator != Integrator::semi_implicit)
    throw std::invalid_argument(
        "contacts and limits require the integrator 'semi-implicit', not '" + name + "'");
  if (parts.located && parts.integrator != Integrator::semi_implicit)
    throw std::invalid_argument("event-driven steps require the integrator 'semi-implicit', not '" +
                                name + "'");
  for (const ForceSource* source : parts.forces)
    if (source->needs_semi_implicit() && !facts_of(parts.integrator).implicit_force)
      throw std::invalid_argument(
          "implicit spring-dampers and contacts require a semi-implicit integrator, not '" + name +
          "'");
  if (!parts.located) return;
  for (const ForceSource* source : parts.forces)
    if (source->needs_semi_implicit())
      throw std::invalid_argument(
          "implicit spring-dampers cannot be combined with event-driven steps");
  for (ConstraintSource* source : parts.constraints)
    if (!source->events())
      throw std::invalid_argument(
          "event-driven steps require constraint sources with events (ConstraintSource::events)");
}

std::vector<Checkpointable*> checkpointable_sources(const Simulation& simulation) {
  std::vector<Checkpointable*> all;
  const auto add_all = [&](const auto& sources, const std::string& kind) {
    for (auto* source : sources) {
      all.push_back(dynamic_cast<Checkpointable*>(source));
      if (!all.back())
        throw std::invalid_argument(kind + " source does not implement Checkpointable");
    }
  };
  add_all(simulation.mechanism().sources, "force");
  add_all(simulation.constraints().system().sources, "constraint");
  return all;
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
  const std::vector<ForceSource*> added{&source};
  check_parts({integrator(), located_.has_value(), added, constrained_.system().sources});
  m_.sources.push_back(&source);
}

void Simulation::add(ConstraintSource& source) {
  const std::vector<ConstraintSource*> added{&source};
  check_parts({integrator(), located_.has_value(), m_.sources, added});
  constrained_.system().sources.push_back(&source);
}

void Simulation::locate_events() {
  check_parts({integrator(), true, m_.sources, constrained_.system().sources});
  located_.emplace();
}

void Simulation::set_sleep(double speed) {
  if (located_ && speed > 0) throw std::invalid_argument("event-driven steps put nothing to sleep");
  constrained_.sleep().set_speed(speed);
}

void Simulation::set_integrator(Integrator integrator, double tolerance) {
  check_parts({integrator, located_.has_value(), m_.sources, constrained_.system().sources});
  integrator_step_.set_integrator(integrator, tolerance);
}

void Simulation::set_loops(std::vector<LoopClosure> loops) {
  check_loops(m_.model(), loops, m_.x);
  m_.set_loops(LoopClosures(m_.model(), std::move(loops)));
  constrained_.system().bilateral.clear_loop_guesses();
  integrator_step_.reset_step_size();
}

void Simulation::prescribe(int body, MotionFunction motion) {
  const auto i = static_cast<std::size_t>(body);
  if (body <= 0 || body >= m_.model().body_count() || m_.model().joint[i] != JointType::prescribed)
    throw std::invalid_argument("body " + std::to_string(body) +
                                " is not the child of a prescribed joint");
  const auto before = m_.prescribed_joints;
  std::erase_if(m_.prescribed_joints, [&](const auto& joint) { return joint.body == i; });
  m_.prescribed_joints.push_back({i, std::move(motion)});
  try {
    m_.start(m_.x);
  } catch (...) {
    m_.prescribed_joints = before;
    throw;
  }
  integrator_step_.reset_step_size();
}

void Simulation::set_state(State<double> x) {
  if (x.q.size() != m_.model().nq || x.qd.size() != m_.model().nv ||
      x.prescribed.size() != m_.model().np)
    throw std::invalid_argument("state size mismatch: q, qd have " + std::to_string(x.q.size()) +
                                ", " + std::to_string(x.qd.size()) + " entries, the model " +
                                std::to_string(m_.model().nq) + ", " +
                                std::to_string(m_.model().nv));
  m_.start(std::move(x));
  integrator_step_.reset_step_size();
}

void Simulation::serialize(StateArchive& archive) {
  const std::vector<Checkpointable*> all = checkpointable_sources(*this);
  State<double> x = m_.x;
  visit_state(archive, m_.model(), x);
  if (archive.reads()) m_.resume(std::move(x));
  m_.dynamics.serialize(archive);
  integrator_step_.serialize(archive);
  constrained_.serialize(archive, m_.dynamics.bilateral().loops().rows());
  if (located_) located_->serialize(archive);
  for (Checkpointable* source : all) source->serialize(archive);
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
    m_.project_and_update();
    if (m_.account) m_.account->add_projection();
  }
  report.h = m_.x.t - t;
  report.loop_position_error = m_.loop_position_error;
  report_non_finite(m_, report);
  return report;
}

State<double> side_step(const Simulation& from, double h, StepReport* report,
                        std::optional<Simulation>* copy) {
  check_step_size(h);
  const SavedSources saved(checkpointable_sources(from));
  std::optional<Simulation> of_this_call;
  std::optional<Simulation>& aside = copy ? *copy : of_this_call;
  aside = from;
  const StepReport taken = aside->step(h);
  if (report) *report = taken;
  return aside->state();
}

void evaluate_at(const Simulation& simulation, const State<double>& x,
                 std::optional<IntegrationState>& copy) {
  constexpr double kInstant = 1e-6;  // [s]; > 0: right-sided limit at velocity discontinuities
  const SavedSources saved(checkpointable_sources(simulation));
  if (!copy) copy.emplace(simulation.mechanism());
  copy->resume(x);
  copy->begin_step(kInstant);
  copy->accelerate();
}

}  // namespace twinarm
