#include "app/servo/servo_run.h"

#include <algorithm>

#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr double kRemembered = 2.0;  // of the hand, for couplings that see it late [s]
constexpr double kShortestStep = 1e-6, kLongestStep = 0.1;  // [s]

double step_of(const SceneModel& scene, const LiveOptions& options) {
  const bool is_option = options.step > 0;
  const double h = is_option ? options.step : scene.description.step;
  if (h >= kShortestStep && h <= kLongestStep) return h;
  throw InputError(
      {{is_option ? "" : scene.description.file.string(), 0, is_option ? "--step" : "step",
        "with a hand device the step is from 1e-6 to 0.1 s, and here " + short_number_text(h) +
            " s",
        "give 0.001", "hand.step"}});
}

// A tick takes one semi-implicit step of known work.
void check_steps(const SceneModel& scene, FaultList& faults) {
  const std::string file = scene.description.file.string();
  const Integrator integrator = scene.description.integrator.value_or(Integrator::semi_implicit);
  if (integrator != Integrator::semi_implicit)
    faults.add({file, 0, "integrator",
                std::string("a hand device goes with semi-implicit, not with ") +
                    integrator_name(integrator),
                "leave it out of the scene", "hand.integrator"});
  if (locates_events(scene))
    faults.add({file, 0, "contact", "impacts that are located have no time for a hand device",
                "give contact = \"rigid\"", "hand.contact"});
}

// The couplings that follow the device. All of them are to turn the same joints.
std::vector<std::size_t> find_led(const SceneModel& scene, double h) {
  const std::string file = scene.description.file.string();
  FaultList faults;
  check_steps(scene, faults);
  std::vector<std::size_t> led;
  for (std::size_t c = 0; c < scene.couplings.size(); ++c) {
    const SceneCoupling& coupling = scene.couplings[c];
    if (coupling.target != CouplingTarget::Kind::device) continue;
    led.push_back(c);
    if (!coupling.leads()) continue;
    const std::string where = "coupling '" + coupling.coupling + "'";
    if (coupling.driven.turned != scene.couplings[led.front()].driven.turned)
      faults.add({file, coupling.line, where, "it follows the device with another robot",
                  "one device moves one robot: give it another target", "hand.two-robots"});
    if (coupling.delay > kRemembered - h)
      faults.add({file, coupling.line, where + ", delay", "of a device it is at most 2 s",
                  "give a shorter one", "hand.delay"});
  }
  if (led.empty())
    faults.add({file, 0, "coupling", "none of them follows a hand device",
                "give target = \"device\" to those that should", "hand.no-device"});
  faults.check();
  return led;
}

}  // namespace

LiveRun::LiveRun(const SceneModel& scene, HandDevice& device, const LiveOptions& options)
    : h_(step_of(scene, options)),
      led_(find_led(scene, h_)),
      leader_(led_.front()),
      hand_(std::make_unique<LiveHand>(static_cast<std::size_t>(kRemembered / h_) + 2)),
      couplings_(std::make_unique<SceneCouplings>(scene, h_, hand_.get())),
      simulation_(scene.model, scene.start) {
  loop_ = std::make_unique<HandLoop>(scene, *couplings_, led_, device, options);
  for (std::size_t c = 0; c < couplings_->size(); ++c)
    if (ForceSource* source = couplings_->source(c)) simulation_.add(*source);
  for (const SceneMotion& motion : scene.motions) simulation_.prescribe(motion.body, motion.law);
  contacts_.emplace(scene, simulation_);
  loop_->begin(loop_->target().q, 0);
}

TickView LiveRun::tick() noexcept {
  TickView view;
  const double t = time();
  const HandTarget& target = loop_->before_step(simulation_.state(), t, h_);
  hand_->set(target, t, h_);
  view.hand = hand_->newest();
  const std::vector<double>& q_D = loop_->q_D();
  for (std::size_t j = 0; j < std::min(view.error.size(), q_D.size()); ++j)
    view.error[j] = target.q[j] - q_D[j];
  view.mode = loop_->watch().mode();
  if (!stopped_) stopped_ = !simulation_.step(h_).finite;
  view.finite = !stopped_;
  view.felt = loop_->after_step(simulation_, h_, view.finite).torque;
  return view;
}

}  // namespace twinarm
