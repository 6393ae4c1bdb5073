#include "solver/stepping/simulation.h"

#include <stdexcept>
#include <utility>

#include "solver/loops/loop_closure.h"
#include "solver/stepping/step_checks.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

Simulation::Simulation(const Model<double>& model, State<double> start)
    : m_(model, std::move(start)), integrator_step_(m_), constrained_(model) {}

void Simulation::add(ForceSource& source) {
  std::vector<ForceSource*> sources = m_.sources;
  sources.push_back(&source);
  check_parts(
      {integrator(), has_constrained_steps(), located_.has_value(), sources, constraint_sources()});
  m_.sources = std::move(sources);
}

void Simulation::add(ConstraintSource& source) {
  std::vector<ConstraintSource*> sources = constraint_sources();
  sources.push_back(&source);
  check_parts({integrator(), true, located_.has_value(), m_.sources, sources});
  constrained_.system().sources = std::move(sources);
}

void Simulation::set_constrained_steps(bool on) {
  check_parts({integrator(), on || has_constrained_steps(), located_.has_value(), m_.sources,
               constraint_sources()});
  always_constrained_ = on;
}

void Simulation::locate_events() {
  check_parts({integrator(), has_constrained_steps(), true, m_.sources, constraint_sources()});
  located_.emplace(model());
}

void Simulation::set_integrator(Integrator integrator) {
  check_parts({integrator, has_constrained_steps(), located_.has_value(), m_.sources,
               constraint_sources()});
  integrator_step_.set_integrator(integrator);
}

void Simulation::set_loops(std::vector<LoopClosure> loops) {
  check_loops(model(), loops, m_.x);
  m_.set_loops(LoopClosures(model(), std::move(loops)));
  constrained_.system().bilateral.forget_loops();
  integrator_step_.forget();
}

void Simulation::prescribe(int body, MotionLaw law) {
  const auto i = static_cast<std::size_t>(body);
  if (body <= 0 || body >= model().body_count() || model().joint[i] != JointType::prescribed)
    throw std::invalid_argument("only the body of a prescribed joint moves by a law");
  const std::vector<Mechanism::Drive> before = m_.drives;
  std::erase_if(m_.drives, [&](const Mechanism::Drive& drive) { return drive.body == i; });
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
  if (x.q.size() != model().nq || x.qd.size() != model().nv)
    throw std::invalid_argument("the state is not one of this model");
  m_.start(std::move(x));
  integrator_step_.forget();
}

StepReport Simulation::step(double h) {
  check_step_size(h);
  return advance(h, false);
}

StepReport Simulation::substep(double h) {
  check_step_size(h);
  return advance(h, true);
}

State<double> Simulation::side_step(double h, StepReport* report) const {
  check_step_size(h);
  const SavedSources saved(memories());
  Simulation aside(*this);
  const StepReport taken = aside.step(h);
  if (report) *report = taken;
  return aside.state();
}

void Simulation::evaluate_at(const State<double>& x,
                             const std::function<void(const Simulation&)>& see) const {
  constexpr double kMoment = 1e-6;  // [s]; tells which side of a corner of a hand's motion is meant
  const SavedSources saved(memories());
  Simulation aside(*this);
  aside.m_.x = x;
  forward_kinematics(model(), aside.m_.x, aside.m_.k);
  aside.m_.begin_step(kMoment);
  aside.m_.accelerate();
  see(aside);
}

std::vector<Rewindable*> Simulation::memories() const {
  std::vector<Rewindable*> memories;
  for (ForceSource* source : m_.sources) {
    memories.push_back(dynamic_cast<Rewindable*>(source));
    if (!memories.back())
      throw std::invalid_argument("a source of forces does not let a step be taken back");
  }
  for (ConstraintSource* source : constraint_sources()) {
    memories.push_back(dynamic_cast<Rewindable*>(source));
    if (!memories.back())
      throw std::invalid_argument("a source of constraints does not let a step be taken back");
  }
  return memories;
}

void Simulation::visit_memory(Memory& memory) {
  const std::vector<Rewindable*> all = memories();
  State<double> x = m_.x;
  memory.visit(x.q);
  memory.visit(x.qd);
  memory.visit(x.t);
  if (x.q.size() != model().nq || x.qd.size() != model().nv)
    throw std::runtime_error("the state is not one of this model");
  if (memory.reads()) m_.resume(std::move(x));
  m_.dynamics.visit_memory(memory);
  integrator_step_.visit_memory(memory);
  constrained_.visit_memory(memory, m_.dynamics.bilateral().loops().rows());
  if (located_) located_->visit_memory(memory);
  for (Rewindable* source : all) source->visit_memory(memory);
  if (always_constrained_) {  // recordings keep their layout: here stood limits, of which none held
    std::vector<char> none;
    memory.visit(none);
  }
}

StepReport Simulation::advance(double h, bool one_substep) {
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
  report.loops_open = m_.loops_open;
  report_non_finite(m_, report);
  return report;
}

}  // namespace twinarm
