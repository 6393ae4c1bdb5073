#include "app/run/stepped_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "solver/dynamics/energy_momentum.h"
#include "solver/stepping/event_driven_step.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr long kCheckpoint = 1000;  // steps between checkpoints, for post-mortems
constexpr long kEnergyEvery = 8;    // steps between checks of the energy, which cost a pass

// The row of this name; a new one is inserted before the last, `numerical`.
EnergyRow& row_like(const EnergyRow& wanted, std::vector<EnergyRow>& rows) {
  const auto found = std::ranges::find(rows, wanted.name, &EnergyRow::name);
  if (found != rows.end()) return *found;
  return *rows.insert(rows.empty() ? rows.end() : rows.end() - 1, {wanted.kind, wanted.name, 0});
}

}  // namespace

StateArchive simulation_memory(const std::string& memory) {
  StateArchive all(memory);
  long steps = 0, unsolved = 0, unlocated = 0;
  double end = 0;
  all.visit(steps, end, unsolved, unlocated);
  return all;
}

SteppedRun::SteppedRun(const SimulateInput& simulated, const RunPlan& plan, const RunWatch& watch,
                       const RunStart* from, OutsideForce* outside)
    : input_(simulated.robot),
      plan_(plan),
      watch_(watch),
      outside_(outside),
      sim_(input_.model, input_.state.x,
           {.enable_constraint_work = true, .interrupted = watch.interrupted}),
      given_(input_),
      limits_(input_, simulated.scene && limits_act(*simulated.scene, plan.integrator),
              result_.warnings),
      poses_(input_.model) {
  add_forces(simulated);
  sim_.set_integrator(plan.integrator, plan.tolerance);
  if (simulated.scene) {
    contacts_.emplace(*simulated.scene, sim_);
    warn(deep_start_warning(*contacts_, simulated.scene->description.contact));
  }
  warn(drift_warning(sim_, plan));
  momentum_.emplace(input_, given_, simulated.couplings.get(), plan.integrator, plan.locates_events,
                    sim_, poses_);
  energy_balance_.emplace(input_, given_, simulated.couplings.get(),
                          plan.locates_events ? Integrator::dopri5 : plan.integrator,
                          momentum_->wants_inner(), poses_);
  bound_ = plan.energy_bound > 0 ? plan.energy_bound
                                 : default_energy_bound(input_.model, input_.state.x, false);
  alarm_.emplace(weight_of(input_.model));
  if (from) go_on_from(*from);
  earlier_ = later_ = memory();
}

void SteppedRun::add_forces(const SimulateInput& simulated) {
  sim_.add(given_);
  if (simulated.scene) {
    for (std::size_t c = 0; c < simulated.couplings->size(); ++c)
      if (ForceSource* source = simulated.couplings->source(c)) sim_.add(*source);
    for (const SceneMotion& motion : simulated.scene->motions)
      sim_.prescribe(motion.body, motion.law);
  }
  if (outside_) sim_.add(*outside_);
}

void SteppedRun::begin() {
  limits_.look(sim_.state().t, sim_.state());
  if (watch_.look) watch_.look(*this);
}

std::vector<EnergyRow> SteppedRun::energy_balance() const {
  std::vector<EnergyRow> all = energy_balance_->rows();
  const auto add = [&](std::vector<EnergyRow> rows) {
    // Before the last row, `numerical`, which is the residual.
    for (const EnergyRow& row : rows) all.back().work -= row.work;
    all.insert(all.end() - 1, std::move_iterator(rows.begin()), std::move_iterator(rows.end()));
  };
  if (contacts_) add(contacts_->rows());
  add(momentum_->energy_rows(sim_, contacts()));
  if (outside_ && outside_->has_acted())
    add({{EnergyRowKind::outside, outside_->name(), outside_->total().work}});
  for (const EnergyRow& row : carried_) row_like(row, all).work += row.work;
  return all;
}

void SteppedRun::continue_balance(const std::vector<EnergyRow>& earlier) {
  carried_.clear();
  std::vector<EnergyRow> carried = earlier;
  for (const EnergyRow& row : energy_balance()) row_like(row, carried).work -= row.work;
  carried_ = std::move(carried);
}

std::string SteppedRun::memory() {
  StateArchive memory;
  serialize(memory);
  return memory.bytes();
}

SimulateResult SteppedRun::finish() {
  if (!result_.post_mortem && result_.steps < last_step_)  // samples at the end
    for (; next_ < plan_.times.size(); ++next_) watch_.sample(plan_.times[next_], sim_.state());
  warn_of_errors();
  result_.energy_balance = energy_balance();
  if (!result_.post_mortem && std::ranges::any_of(result_.energy_balance, [](const EnergyRow& row) {
        return !std::isfinite(row.work);
      }))
    warn(
        "energies are too large for floating-point numbers (inf or nan, null in JSON): check "
        "gravity, masses and stiffnesses");
  result_.momentum = momentum();
  if (contacts_) result_.contacts = contacts_->contact_count();
  if (result_.post_mortem) result_.checkpoint = std::move(earlier_);
  result_.input_work = energy_balance_->input_work();
  return std::move(result_);
}

void SteppedRun::warn(std::string text) {
  if (text.empty()) return;
  result_.warnings.push_back(std::move(text));
  if (watch_.warn) watch_.warn(result_.warnings.back());
}

void SteppedRun::serialize(StateArchive& memory) {
  memory.visit(result_.steps, result_.end, unsolved_, unlocated_);
  sim_.serialize(memory);
  energy_balance_->serialize(memory);
  momentum_->serialize(memory);
  if (outside_ && (memory.reads() ? !memory.at_end() : outside_->has_acted()))
    outside_->visit_books(memory);
}

void SteppedRun::take_back(const std::string& bytes) {
  StateArchive memory(bytes);
  try {
    serialize(memory);
    if (!memory.at_end()) throw std::runtime_error("it has more data than this scene");
  } catch (const std::runtime_error& error) {
    throw InputError("restart", error.what(),
                     "do not change joints, contacts, couplings or integrator", kOtherMemory);
  }
}

void SteppedRun::go_on_from(const RunStart& start) {
  result_.steps = start.step;
  result_.end = start.time;
  if (!start.anew) take_back(start.memory);
  last_step_ = start.last_step;
  on_grid_ = TimeGrid(plan_.step, plan_.duration).contains(result_.steps, result_.end);
  const double now = result_.end;
  while (next_ < plan_.times.size() && plan_.times[next_] < now) ++next_;
}

bool SteppedRun::advance() {
  if (result_.post_mortem || result_.steps >= last_step_) return false;
  const TimeGrid grid(plan_.step, plan_.duration);
  const bool counts = !plan_.is_adaptive() && on_grid_;
  if (counts ? result_.steps >= grid.steps() : !(result_.end < plan_.duration)) return false;
  if (plan_.is_adaptive())
    return one_step(result_.end, std::min(plan_.step, plan_.duration - result_.end));
  const double t = counts ? grid.time(result_.steps) : result_.end;
  return one_step(t, grid.length(t));
}

double SteppedRun::time_after(double t, double h) const {
  if (!plan_.is_adaptive() && on_grid_)
    return TimeGrid(plan_.step, plan_.duration).time(result_.steps);
  return plan_.duration - t - h <= kSameTime * h ? plan_.duration : t + h;
}

bool SteppedRun::one_step(double t, double h_max) {
  const bool has_sample_within =
      next_ < plan_.times.size() && plan_.times[next_] < t + h_max * (1 - kSameTime);
  if (has_sample_within || !energy_balance_->inner_nodes().empty()) before_ = sim_;
  const StepReport report = sim_.step(h_max, plan_.is_adaptive());
  if (report.interrupted) return stop_for_interrupt(t);
  ++result_.steps;
  if (contacts_ && contacts_->contacts() && !plan_.locates_events)
    impact_normals_.look(*contacts_->contacts(), report.h);
  const bool by_limits = contacts_ && contacts_->only_limits_were_passed();
  if (!report.finite || !report.reached) {
    // Of the samples of this step only those at its start are valid.
    for (; has_sample_within && next_ < plan_.times.size() &&
           plan_.times[next_] - t <= kSameTime * h_max;
         ++next_)
      watch_.sample(plan_.times[next_], before_->state());
    result_.post_mortem = examine_end(report, sim_, energy_balance_->now(), t, result_.steps);
    return false;
  }
  const double t_next = time_after(t, report.h);
  if (has_sample_within) sample_up_to(t_next - kSameTime * report.h, t, *before_);
  book(report, t, by_limits);
  result_.end = t_next;
  limits_.look(t_next, sim_.state());
  if (watch_.look) watch_.look(*this);
  if (watch_.tick) watch_.tick(t_next);
  if (result_.steps % kCheckpoint == 0) {
    earlier_ = std::move(later_);
    later_ = memory();
  }
  const double bound = bound_;  // an alarm lowers it for the steps after it
  if (watch_.alarm && result_.steps % EnergyAlarm::kWindow == 0) check_energy_balance();
  return result_.steps % kEnergyEvery != 0 || stays_bounded(report, bound);
}

// Accounts for the step from t in the energy and momentum balances.
void SteppedRun::book(const StepReport& report, double t, bool by_limits) {
  unsolved_ += report.converged ? 0 : 1;
  if (sim_.has_constrained_steps())
    result_.residual = std::max(result_.residual, sim_.constraints().report().step.residual);
  if (contacts_) result_.penetration = std::max(result_.penetration, contacts_->penetration());
  unlocated_ += report.located ? 0 : 1;
  inner_.clear();
  for (const double part : energy_balance_->inner_nodes())
    inner_.push_back(step_aside(*before_, part * report.h, t));
  if (outside_)
    outside_->book(report.h, energy_balance_->weights(), energy_balance_->now(), inner_,
                   sim_.state());
  energy_balance_->add_step(report.h, inner_, sim_.state());
  momentum_->add_step(report.h, energy_balance_->weights(), inner_, sim_, by_limits);
}

void SteppedRun::check_energy_balance() {
  const double kinetic = kinetic_energy(input_.model, sim_.state());
  auto found = alarm_->look(result_.end, kinetic, energy_balance());
  if (!found) return;
  result_.alarm_words = watch_.alarm(*found);
  result_.alarm = std::move(found);
  if (plan_.energy_bound <= 0) bound_ = default_energy_bound(input_.model, input_.state.x, true);
}

bool SteppedRun::stays_bounded(const StepReport& report, double bound) {
  const double energy = kinetic_energy(input_.model, sim_.state());
  if (energy <= bound) return true;
  PostMortem found = examine_end(report, sim_, sim_.state(), result_.end, result_.steps);
  found.by_energy = true;
  found.energy_bound = bound;
  found.field = "qd";
  found.reason = fmt::format("the kinetic energy of {} J exceeds its bound of {} J",
                             short_number_text(energy), short_number_text(bound));
  result_.post_mortem = std::move(found);
  return false;
}

void SteppedRun::sample_up_to(double t_end, double t, const Simulation& from) {
  for (; next_ < plan_.times.size() && plan_.times[next_] < t_end; ++next_) {
    const double at = plan_.times[next_];
    const bool same = at - t <= kSameTime * (t_end - t);
    watch_.sample(at, same ? from.state() : step_aside(from, at - t, t));
  }
}

State<double> SteppedRun::step_aside(const Simulation& from, double h, double t) {
  StepReport report;
  State<double> x = side_step(from, h, &report, &copy_);
  if (report.interrupted) stop_for_interrupt(t);
  return x;
}

bool SteppedRun::stop_for_interrupt(double t) const {
  if (watch_.tick) watch_.tick(t);  // throws
  return false;
}

SimulateResult run_plan(const SimulateInput& input, const RunPlan& plan, const RunWatch& watch,
                        const RunStart* from) {
  SteppedRun run(input, plan, watch, from);
  run.begin();
  while (run.advance()) {
  }
  return run.finish();
}

}  // namespace twinarm
