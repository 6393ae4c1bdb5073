#include "app/live/live_run.h"

#include <algorithm>

#include "solver/fault.h"

namespace twinarm {
namespace {

constexpr double kRemembered = 2.0;  // of the hand, for couplings that see it late [s]

bool follows_device(const SceneCoupling& coupling) {
  return coupling.leads() && coupling.target == CouplingTarget::Kind::device;
}

// A tick takes one semi-implicit step of known work.
void check_steps(const SceneModel& scene, FaultList& faults) {
  const std::string file = scene.description.file.string();
  const Integrator integrator = scene.description.integrator.value_or(Integrator::semi_implicit);
  if (integrator != Integrator::semi_implicit)
    faults.add({file, 0, "integrator",
                std::string("a hand device goes with semi-implicit, not with ") +
                    integrator_name(integrator),
                "leave it out of the scene"});
  if (locates_events(scene))
    faults.add({file, 0, "contact", "impacts that are located have no time for a hand device",
                "give contact = \"rigid\""});
}

// The first coupling that follows the device. All of them are to turn the same joints.
std::size_t find_leader(const SceneModel& scene, double h) {
  const std::string file = scene.description.file.string();
  FaultList faults;
  check_steps(scene, faults);
  std::size_t leader = scene.couplings.size();
  for (std::size_t c = 0; c < scene.couplings.size(); ++c) {
    const SceneCoupling& coupling = scene.couplings[c];
    if (!follows_device(coupling)) continue;
    if (leader == scene.couplings.size()) leader = c;
    const std::string where = "coupling '" + coupling.coupling + "'";
    if (coupling.driven.turned != scene.couplings[leader].driven.turned)
      faults.add({file, coupling.line, where, "it follows the device with another robot",
                  "one device moves one robot: give it another target"});
    if (coupling.delay > kRemembered - h)
      faults.add({file, coupling.line, where + ", delay", "of a device it is at most 2 s",
                  "give a shorter one"});
  }
  if (leader == scene.couplings.size())
    faults.add({file, 0, "coupling", "none of them follows a hand device",
                "give target = \"device\" to those that should"});
  faults.check();
  return leader;
}

std::vector<int> bodies_of(const SceneModel& scene, const DrivenJoints& joints) {
  std::vector<int> bodies;
  for (const std::string& name : joints.turned) bodies.push_back(scene.model.find_joint(name));
  return bodies;
}

// The point that follows the stylus: where the outermost spring pulls, else the last driven link's
// origin.
std::pair<int, Vector3> led_point(const SceneModel& scene, const std::vector<int>& turned) {
  std::pair<int, Vector3> point{turned.back(), Vector3::Zero()};
  for (const SceneCoupling& coupling : scene.couplings)
    if (coupling.target == CouplingTarget::Kind::device &&
        coupling.type == CouplingDescription::Type::linear)
      point = {coupling.spring.body, coupling.spring.p_L};
  return point;
}

}  // namespace

LiveRun::LiveRun(const SceneModel& scene, HandDevice& device, const LiveOptions& options)
    : scene_(scene),
      device_(device),
      h_(options.step > 0 ? options.step : scene.description.step),
      leader_(find_leader(scene, h_)),
      turned_(bodies_of(scene, scene.couplings[leader_].driven)),
      hand_(std::make_unique<LiveHand>(static_cast<std::size_t>(kRemembered / h_) + 2)),
      couplings_(std::make_unique<SceneCouplings>(scene, h_, hand_.get())),
      simulation_(scene.model, scene.start),
      reaction_(scene.model, turned_) {
  const auto [body, p_L] = led_point(scene, turned_);
  MappedRobot robot{&scene.model, scene.couplings[leader_].rest, turned_, {}, {}, body, p_L};
  mapping_ = make_mapping(options.mapping, device.figures(), robot);
  force_ = std::make_unique<HandForce>(options.force, device.figures(), *mapping_);
  for (std::size_t c = 0; c < couplings_->size(); ++c) {
    if (ForceSource* source = couplings_->source(c)) simulation_.add(*source);
    if (follows_device(scene.couplings[c]) && !scene.couplings[c].outside)
      reaction_.add(couplings_->law(c), couplings_->coupling(c));
  }
  for (const SceneMotion& motion : scene.motions) simulation_.prescribe(motion.body, motion.law);
  contacts_.emplace(scene, simulation_);
  const State<double>& rest = scene.couplings[leader_].rest;
  for (const int joint : turned_) {
    target_.q.push_back(rest.q[scene.model.iq[static_cast<std::size_t>(joint)]]);
    target_.qd.push_back(0);
    q_D_.push_back(target_.q.back());
  }
  mapping_->begin(device.poll(0), target_.q);
}

TickView LiveRun::tick() noexcept {
  TickView view;
  const double t = time();
  const DeviceState device = device_.poll(t);
  for (std::size_t j = 0; j < turned_.size(); ++j)
    q_D_[j] = simulation_.state().q[scene_.model.iq[static_cast<std::size_t>(turned_[j])]];
  watch_.tick(device, *mapping_, q_D_, h_, target_);
  hand_->set(target_, t, h_);
  view.hand = hand_->newest();
  for (std::size_t j = 0; j < std::min(view.error.size(), q_D_.size()); ++j)
    view.error[j] = target_.q[j] - q_D_[j];
  view.mode = watch_.mode();
  if (!stopped_) stopped_ = !simulation_.step(h_).finite;
  view.finite = !stopped_;
  DeviceForce felt;
  if (view.finite) {
    const std::vector<double>& tau = reaction_.after_step(
        couplings_->kvr(leader_).end(), simulation_.state(), simulation_.kinematics(), h_);
    if (view.mode == HandWatch::Mode::live) felt = force_->tick(device, tau, h_);
  }
  device_.render(felt);
  view.felt = felt.torque;
  return view;
}

}  // namespace twinarm
