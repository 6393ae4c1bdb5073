#include "app/lab/run/lab_run.h"

#include "app/diagnose/post_mortem.h"
#include "app/record/record_run.h"

namespace twinarm {
namespace {

// Bound of the kinetic energy over the largest of 1 J, its start value, and the weight times 1 m.
// Lower than in `simulate` (RunPlan::kGrowth): at such speeds contacts and limits take up to a
// second per step.
constexpr double kMaxGrowth = 1e3;

// The last state is finite, but wrong.
PostMortem stopped_by_energy(const SteppedRun& run, double bound) {
  const Simulation& simulation = run.simulation();
  PostMortem found = examine_end({}, simulation, simulation.state(), run.time(), run.step());
  found.by_energy = true;
  found.energy_bound = bound;
  found.reason = "it creates energy";
  return found;
}

}  // namespace

LabRun::LabRun(std::unique_ptr<LabScene::Plan> plan_of_changes, OperatorInput& operator_input,
               const LabFrame* from)
    : operator_(operator_input), plan_(std::move(plan_of_changes)) {
  SimulateInput& input = plan_->prepared.input;
  override_ =
      std::make_unique<InputOverride>(input.scene.get(), operator_, plan_->prepared.run.step);
  const RobotInput& robot = input.robot;
  max_energy_ = kMaxGrowth *
                std::max({1.0, kinetic_energy(robot.model, robot.state.x), weight_of(robot.model)});
  watch_.warn = [this](const std::string& text) { warnings_.push_back(text); };
  watch_.alarm = [this](const Alarm& alarm) {
    warnings_.push_back(alarm_words(alarm, plan_->prepared));
    return warnings_.back();
  };
  if (!from) {
    begin(nullptr);
    run_->begin();
  } else {
    try {
      const RunStart start{from->recorded.memory};
      begin(&start);
    } catch (const InputError& error) {
      if (error.faults().front().code != kOtherMemory) throw;
      restart_reason_ = error.faults().front().problem;
      restart(*from);
    }
    if (from->hand) override_->continue_from(*from->hand);
  }
  warnings_.insert(warnings_.end(), robot.warnings.begin(), robot.warnings.end());
}

void LabRun::begin(const RunStart* start) {
  SimulatePlan& prepared = plan_->prepared;
  SimulateInput& input = prepared.input;
  if (input.scene) {
    input.couplings = std::make_unique<SceneCouplings>(*input.scene, prepared.run.step, nullptr,
                                                       override_->in_place());
    override_->attach(*input.couplings);
  }
  spring_ = std::make_unique<MouseSpring>(prepared.input.robot.model, prepared.run);
  run_ = std::make_unique<SteppedRun>(prepared.input, prepared.run, watch_, start, spring_.get());
}

// From the frame's state. Couplings and spring, restored in part, are made again.
void LabRun::restart(const LabFrame& from) {
  RobotInput& robot = plan_->prepared.input.robot;
  try {
    StateArchive memory = simulation_memory(from.recorded.memory);
    visit_state(memory, robot.model, robot.state.x);
  } catch (const std::runtime_error&) {
    throw InputError("change", "the change gives the scene other joints",
                     "reset the run to its start first", "change.joints");
  }
  RunStart start;
  start.anew = true;
  start.step = from.recorded.step;
  start.time = from.recorded.t;
  begin(&start);
}

void LabRun::carry_over_energy(const LabFrame& from, const LabNames& names) {
  std::vector<EnergyRow> earlier;
  for (std::size_t i = 0; i < from.recorded.rows.size(); ++i)
    earlier.push_back(
        {EnergyRowKind::earlier, names.rows[from.recorded.rows[i]], from.recorded.works[i]});
  // Targets as in the frame: the balance contains the couplings' elastic energy.
  if (from.hand) override_->restore(*from.hand, from.recorded.t, plan_->prepared.run.step);
  run_->continue_balance(earlier);
}

bool LabRun::step(const LabInput* replayed) {
  if (stopped_) return false;
  const Simulation& simulation = run_->simulation();
  const State<double>& x = simulation.state();
  const double h = plan_->prepared.run.step;
  if (replayed) {
    input_ = *replayed;
    if (input_.hand) input_.hand = shifted_to(x.t, h, *input_.hand);
    override_->replay_step(input_.hand);
  } else {
    input_.hand = override_->before_step(x, x.t, h);
    input_.mouse = mouse_;
    input_.stamp = operator_.stamp();
  }
  input_.step = run_->step() + 1;
  input_.t = x.t;
  input_.h = h;
  spring_->set(input_.mouse);
  const bool goes_on = run_->advance();
  override_->after_step(simulation, h, goes_on);
  stopped_ = !goes_on || run_->result().alarm ||
             kinetic_energy(simulation.mechanism().model(), simulation.state()) > max_energy_;
  return !stopped_;
}

bool LabRun::drag(int body, const Vector3& p_L, const Vector3& goal_W) {
  if (!goal_W.allFinite()) return false;
  if (mouse_ && mouse_->body == body && mouse_->p_L == p_L)
    mouse_->goal_W = goal_W;
  else
    mouse_ = spring_->grab(run_->simulation().state(), body, p_L, goal_W);
  return mouse_.has_value();
}

LabFrame LabRun::frame(LabNames& names) {
  LabFrame frame;
  frame.recorded = frame_of(*run_, plan_->prepared);
  add_energy_balances(*run_, names.rows, names.momentum_rows, frame.recorded);
  frame.hand = override_->frame(run_->time());
  if (const auto& mouse = input_.mouse)
    frame.mouse = MouseSpringState{mouse->body, mouse->p_L, mouse->goal_W, spring_->force()};
  if (spring_->has_acted()) {
    StateArchive account;
    spring_->visit_books(account);
    frame.outside_bytes = account.bytes().size();
  }
  frame.input_stamp = input_.stamp;
  const ConstrainedStep& step = run_->simulation().constraints();
  frame.residual = step.report().step.residual;
  frame.asleep = step.bodies_asleep();
  return frame;
}

const PostMortem* LabRun::post_mortem(const std::vector<EnergyRow>& before) {
  if (!stopped_ || post_mortem_) return post_mortem_ ? &*post_mortem_ : nullptr;
  SimulateResult result = run_->finish();
  if (!result.post_mortem) result.post_mortem = stopped_by_energy(*run_, max_energy_);
  explain_at_once(plan_->prepared, *run_, before, result);
  post_mortem_ = std::move(result.post_mortem);
  return &*post_mortem_;
}

}  // namespace twinarm
