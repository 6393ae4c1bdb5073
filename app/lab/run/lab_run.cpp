#include "app/lab/run/lab_run.h"

#include <algorithm>
#include <utility>

#include "app/diagnose/post_mortem.h"
#include "app/lab/run/input_override.h"
#include "app/lab/run/lab_inputs.h"
#include "app/record/record_run.h"
#include "app/run/run.h"
#include "solver/dynamics/energy_momentum.h"

namespace twinarm {
namespace {

// A run of the lab stops where its kinetic energy has grown so much, over the largest of 1 J, that
// at the start, and the weight over 1 m: sooner than in `simulate` (RunPlan::kGrowth), for at such
// speeds contacts and limits take a second a step, and somebody waits.
constexpr double kMaxGrowth = 1e3;

}  // namespace

LabRun::LabRun(const LabScene& scene, const std::vector<Change>& changes, LabHand& hand)
    : LabRun(scene.plan(changes), hand, nullptr) {}

LabRun::LabRun(const LabScene& scene, const std::vector<Change>& changes, LabHand& hand,
               const LabFrame& from)
    : LabRun(scene.plan(changes), hand, &from) {}

LabRun::LabRun(std::unique_ptr<LabScene::Plan> plan_of_changes, LabHand& hand, const LabFrame* from)
    : hand_(hand), plan_(std::move(plan_of_changes)) {
  SimulateInput& input = plan_->prepared.input;
  const RunPlan& plan = plan_->prepared.run;
  lead_ = std::make_unique<InputOverride>(input.scene.get(), hand_, plan.step);
  make_couplings();
  const RobotInput& robot = input.robot;
  max_energy_ = kMaxGrowth *
                std::max({1.0, kinetic_energy(robot.model, robot.state.x), weight_of(robot.model)});
  watch_.warn = [this](const std::string& words) { warnings_.push_back(words); };
  watch_.alarm = [this](const Alarm& alarm) {
    warnings_.push_back(alarm_words(alarm, plan_->prepared));
    return warnings_.back();
  };
  start(from);
  if (from && from->hand) lead_->go_on_from(*from->hand);
  warnings_.insert(warnings_.end(), input.robot.warnings.begin(), input.robot.warnings.end());
}

LabRun::~LabRun() = default;

void LabRun::make_couplings() {
  SimulateInput& input = plan_->prepared.input;
  if (!input.scene) return;
  input.couplings = std::make_unique<SceneCouplings>(*input.scene, plan_->prepared.run.step,
                                                     nullptr, lead_->in_place());
  lead_->attach(*input.couplings);
}

void LabRun::start(const LabFrame* from) {
  const SimulatePlan& prepared = plan_->prepared;
  pull_ = std::make_unique<MouseSpring>(prepared.input.robot.model, prepared.run);
  if (!from) {
    run_ = std::make_unique<SteppedRun>(prepared.input, prepared.run, watch_, nullptr, pull_.get());
    run_->begin();
    return;
  }
  try {
    const RunStart start{from->recorded.memory};
    run_ = std::make_unique<SteppedRun>(prepared.input, prepared.run, watch_, &start, pull_.get());
  } catch (const InputError& error) {
    if (error.faults().front().code != kOtherMemory) throw;
    begun_anew_ = error.faults().front().problem;
    begin_anew(*from);
  }
}

// Where the frame stands. What was taken over in part is made again.
void LabRun::begin_anew(const LabFrame& from) {
  SimulatePlan& prepared = plan_->prepared;
  try {
    StateArchive memory = simulation_memory(from.recorded.memory);
    visit_state(memory, prepared.input.robot.model, prepared.input.robot.state.x);
  } catch (const std::runtime_error&) {
    throw InputError({{"", 0, "change", "the scene would have other joints",
                       "begin from the start: reset", "change.joints"}});
  }
  make_couplings();
  pull_ = std::make_unique<MouseSpring>(prepared.input.robot.model, prepared.run);
  RunStart start;
  start.anew = true;
  start.step = from.recorded.step;
  start.time = from.recorded.t;
  run_ = std::make_unique<SteppedRun>(prepared.input, prepared.run, watch_, &start, pull_.get());
}

void LabRun::keep_books(const LabFrame& from, const LabNames& names) {
  std::vector<EnergyRow> told;
  for (std::size_t i = 0; i < from.recorded.rows.size(); ++i)
    told.push_back(
        {EnergyRowKind::earlier, names.rows[from.recorded.rows[i]], from.recorded.works[i]});
  // The springs are as long as they were there: the books hold their energy.
  if (from.hand) lead_->stand_as(*from.hand, from.recorded.t, step_length());
  run_->keep_books(told);
}

bool LabRun::take() {
  pull_->set(input_.pull);
  const bool goes_on = run_->advance();
  lead_->after_step(run_->simulation(), step_length(), goes_on);
  const Simulation& simulation = run_->simulation();
  stopped_ = !goes_on || run_->result().alarm ||
             kinetic_energy(simulation.mechanism().model, simulation.state()) > max_energy_;
  return !stopped_;
}

bool LabRun::step() {
  if (stopped_) return false;
  const State<double>& x = run_->simulation().state();
  input_.step = run_->step() + 1;
  input_.hand = lead_->before_step(x, x.t, step_length());
  input_.pull = mouse_;
  input_.stamp = hand_.stamp();
  return take();
}

bool LabRun::step(const LabInput& again) {
  if (stopped_) return false;
  input_ = again;
  input_.step = run_->step() + 1;
  lead_->take_again(input_.hand);
  return take();
}

bool LabRun::pull(int body, const Vector3& p_L, const Vector3& goal_W, double stamp) {
  if (!goal_W.allFinite()) return false;
  hand_.set_stamp(stamp);
  if (mouse_ && mouse_->body == body && mouse_->p_L == p_L)
    mouse_->goal_W = goal_W;
  else
    mouse_ = pull_->grab(run_->simulation().state(), body, p_L, goal_W);
  return mouse_.has_value();
}

void LabRun::drop() {
  mouse_.reset();
}

LabFrame LabRun::frame(LabNames& names) {
  LabFrame frame;
  frame.recorded = frame_of(*run_, plan_->prepared);
  add_ledgers(*run_, names.rows, names.momentum_rows, frame.recorded);
  frame.hand = hand_frame();
  if (const auto& pull = input_.pull)
    frame.pull = MousePoint{pull->body, pull->p_L, pull->goal_W, pull_->force()};
  if (pull_->has_acted()) {
    StateArchive books;
    pull_->visit_books(books);
    frame.outside_bytes = books.bytes().size();
  }
  frame.input_stamp = input_.stamp;
  return frame;
}

const std::vector<int>& LabRun::driven() const {
  return lead_->driven();
}

const std::vector<double>& LabRun::driven_q() const {
  return lead_->q();
}

std::optional<LabHandFrame> LabRun::hand_frame() const {
  return lead_->frame(run_->time());
}

std::optional<std::pair<int, Vector3>> LabRun::tip() const {
  return lead_->tip();
}

std::vector<std::size_t> LabRun::led() const {
  return lead_->tip() ? lead_->couplings() : std::vector<std::size_t>{};
}

bool LabRun::scene_leads() const {
  return !lead_->leads();
}

// The last state is a good one, but nobody would believe it.
PostMortem LabRun::stopped_by_energy() const {
  const Simulation& simulation = run_->simulation();
  PostMortem found = examine_end({}, simulation, simulation.state(), run_->time(), run_->step());
  found.by_energy = true;
  found.energy_bound = max_energy_;
  found.reason = "it creates energy";
  return found;
}

const PostMortem* LabRun::post_mortem(const std::vector<EnergyRow>& before) {
  if (!stopped_ || post_mortem_) return post_mortem_ ? &*post_mortem_ : nullptr;
  SimulateResult result = run_->finish();
  if (!result.post_mortem) result.post_mortem = stopped_by_energy();
  explain_at_once(plan_->prepared, *run_, before, result);
  post_mortem_ = std::move(result.post_mortem);
  return &*post_mortem_;
}

}  // namespace twinarm
