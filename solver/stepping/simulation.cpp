#include "solver/stepping/simulation.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/loops/loop_checks.h"
#include "solver/model/mimic.h"
#include "solver/model/non_finite.h"
#include "solver/support/step_size.h"

namespace twinarm {
namespace {

void check_located(const ForceSource& source) {
  if (source.needs_semi_implicit())
    throw std::invalid_argument(
        "implicit spring-dampers do not go with steps that locate their events");
}

void check_located(ConstraintSource& source) {
  if (!dynamic_cast<EventSource*>(&source))
    throw std::invalid_argument("a source of constraints cannot have its events located");
}

void check(const ForceSource& source, Integrator integrator) {
  if (source.needs_semi_implicit() && !facts_of(integrator).implicit_force)
    throw std::invalid_argument(
        std::string("implicit spring-dampers and contacts go with the semi-implicit integrators "
                    "only, not with ") +
        integrator_name(integrator));
}

void check_located(Integrator integrator) {
  if (integrator != Integrator::semi_implicit)
    throw std::invalid_argument(
        std::string("steps that locate their events go with the integrator 'semi-implicit' only, "
                    "not with '") +
        integrator_name(integrator) + "'");
}

// Its force would be that of the first round: a wrong one, and nobody would say so.
constexpr const char* kOneRound =
    "a force that is found in rounds (ForceSource::refine) does not go with contacts, limits and "
    "locks: their step has one round; give the contact as a constraint, or leave them out";

// Saves the internal state of sources, and restores it at the end of its scope.
class SavedSources {
 public:
  explicit SavedSources(std::vector<Rewindable*> sources) : sources_(std::move(sources)) {
    for (Rewindable* source : sources_) source->keep();
  }
  SavedSources(const SavedSources&) = delete;
  ~SavedSources() {
    for (Rewindable* source : sources_) source->go_back();
  }

 private:
  std::vector<Rewindable*> sources_;
};

}  // namespace

Simulation::Simulation(const Model<double>& model, State<double> start)
    : m_(model, std::move(start)),
      shift_(model.nv),
      rk_(model.nv),
      dopri5_(m_),
      events_(m_),
      constrained_(model) {}

void Simulation::add(ForceSource& source) {
  check(source, integrator_);
  if (located_) check_located(source);
  if (constrained_.any() && source.needs_rounds()) throw std::invalid_argument(kOneRound);
  m_.sources.push_back(&source);
}

void Simulation::add(ConstraintSource& source) {
  if (integrator_ != Integrator::semi_implicit)
    throw std::invalid_argument("contacts and limits go with the integrator 'semi-implicit' only");
  if (located_) check_located(source);
  for (const ForceSource* force : m_.sources)
    if (force->needs_rounds()) throw std::invalid_argument(kOneRound);
  constrained_.add(source);
}

void Simulation::locate_events() {
  check_located(integrator_);
  for (const ForceSource* source : m_.sources) check_located(*source);
  for (ConstraintSource* source : constrained_.sources()) check_located(*source);
  located_.emplace(model());
}

void Simulation::set_loops(std::vector<LoopClosure> loops) {
  check_loops(model(), loops, m_.x);
  m_.set_loops(LoopClosures(model(), std::move(loops)));
  constrained_.forget_loops();
  dopri5_.forget();
}

void Simulation::set_integrator(Integrator integrator) {
  if (constrained_.any() && integrator != Integrator::semi_implicit)
    throw std::invalid_argument("contacts and limits go with the integrator 'semi-implicit' only");
  if (located_) check_located(integrator);
  for (const ForceSource* source : m_.sources) check(*source, integrator);
  integrator_ = integrator;
  dopri5_.forget();
  if (facts_of(integrator).solves && !implicit_) implicit_.emplace(model().nv);
}

void Simulation::set_tolerance(double tolerance) {
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    throw std::invalid_argument("a tolerance is a positive number");
  dopri5_.set_tolerance(tolerance);
  dopri5_.forget();
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
  dopri5_.forget();
}

void Simulation::set_state(State<double> x) {
  if (x.q.size() != model().nq || x.qd.size() != model().nv)
    throw std::invalid_argument("the state is not one of this model");
  m_.start(std::move(x));
  dopri5_.forget();
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
  for (ConstraintSource* source : constrained_.sources()) {
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
  dopri5_.visit_memory(memory);
  constrained_.visit_memory(memory, m_.dynamics.bilateral().loops().rows());
  if (located_) located_->visit_memory(memory);
  for (Rewindable* source : all) source->visit_memory(memory);
}

StepReport Simulation::advance(double h, bool one_substep) {
  StepReport report;
  const double t = m_.x.t;
  if (m_.account) m_.account->start_step();
  if (integrator_ == Integrator::semi_implicit_xv) {  // its sources act at the new coordinates
    m_.prepare_projection();
    drift(m_, shift_, h);
    m_.x.t = t + h;
    m_.refresh();
    if (m_.account) m_.account->count_projection();
  }
  if (constrained_.any() || located_) {
    if (located_) {
      located_->step(constrained_, m_, h, interrupted_, report);
    } else {
      constrained_.step(m_, h, report);
      m_.x.t = t + h;
      m_.refresh();
      if (m_.account) m_.account->count_projection();
    }
    report.h = m_.x.t - t;
    report.loops_open = m_.loops_open;
    look_for_bad_numbers(report);
    return report;
  }
  m_.begin_step(h);
  if (facts_of(integrator_).implicit_force) {
    solve_sources(h, report);
    kick(m_, h);
    m_.dynamics.settle(m_.x);
    apply_mimics(model(), m_.x);
    if (integrator_ == Integrator::semi_implicit) drift(m_, shift_, h);
  } else if (integrator_ == Integrator::dopri5) {
    dopri5_.step(m_, h, one_substep, report);
  } else if (m_.dynamics.has_coulomb()) {
    report.events = events_.advance(m_, h, [&](double s) { move(s, report); });
  } else {
    move(h, report);
  }
  if (integrator_ != Integrator::dopri5) m_.x.t = t + h;
  m_.refresh();
  if (m_.account) m_.account->count_projection();
  report.h = m_.x.t - t;
  report.loops_open = m_.loops_open;
  look_for_bad_numbers(report);
  return report;
}

void Simulation::move(double h, StepReport& report) {
  if (facts_of(integrator_).solves)
    implicit_->step(m_, integrator_, h, report);
  else if (integrator_ == Integrator::verlet)
    step_verlet(m_, shift_, h);
  else
    rk_.step(m_, tableau_of(integrator_), h);
}

void Simulation::solve_sources(double h, StepReport& report) {
  bool again = true;
  for (report.rounds = 0; again && report.rounds < ForceSource::kMaxRounds; ++report.rounds) {
    m_.accelerate_over(h);
    again = false;
    for (ForceSource* source : m_.sources) again = source->refine(m_.k, m_.w) || again;
  }
  report.converged = !again;
}

void Simulation::look_for_bad_numbers(StepReport& report) const {
  double sum = 0;  // one non-finite number makes the sum non-finite
  for (double q : m_.x.q) sum += q * 0;
  for (double qd : m_.x.qd) sum += qd * 0;
  if (sum == 0) return;

  report.finite = false;
  const BadQuantity bad = first_bad_quantity(model(), m_.forces, m_.w);
  if (bad.body != 0) {
    report.bad_field = bad.name;
    report.bad_body = static_cast<int>(bad.body);
    return;
  }
  for (std::size_t i = 1; i < model().parent.size() && !report.bad_field; ++i)
    visit_joint(model(), i, [&](auto joint) {
      for (std::size_t c = model().iq[i]; c < model().iq[i] + joint.nq; ++c)
        if (!std::isfinite(m_.x.q[c])) {
          report.bad_field = "q";
          report.bad_body = static_cast<int>(i);
        }
    });
}

}  // namespace twinarm
