#include "app/scene/forces/scene_couplings.h"

#include <limits>
#include <utility>

#include "coupling/device/device_motion.h"
#include "coupling/target/operator_motion.h"
#include "coupling/target/synthetic_operator.h"

namespace twinarm {
namespace {

// Of a target that stands still: no joint is turned by it.
class RestingHand final : public OperatorMotion {
 public:
  HandSample sample(double, double) const override { return {}; }
  double duration() const override { return std::numeric_limits<double>::infinity(); }
  std::string description() const override { return "at rest"; }
};

// Somebody else's hand.
class LentHand final : public OperatorMotion {
 public:
  explicit LentHand(const OperatorMotion& hand) : hand_(hand) {}
  HandSample sample(double t, double toward) const override { return hand_.sample(t, toward); }
  double duration() const override { return hand_.duration(); }
  std::string description() const override { return hand_.description(); }

 private:
  const OperatorMotion& hand_;
};

// Of a device that is not there, and of a target that stands still though a hand may take it: it
// holds the driven joints where they stand.
std::unique_ptr<OperatorMotion> hand_at_rest(const Model<double>& model,
                                             const SceneCoupling& coupling) {
  HandTarget target;
  for (const std::string& joint : coupling.driven.turned) {
    const auto body = static_cast<std::size_t>(model.find_joint(joint));
    target.q.push_back(coupling.rest.q[model.iq[body]]);
    target.qd.push_back(0);
  }
  auto hand = std::make_unique<DeviceMotion>(1);
  hand->set(target, 0, 1);
  return hand;
}

std::unique_ptr<OperatorMotion> hand_of_target(const SceneModel& scene,
                                               const SceneCoupling& coupling,
                                               const OperatorMotion* device,
                                               DiagnosticList& faults) {
  switch (coupling.target) {
    case CouplingTarget::Kind::paper:
      return std::make_unique<AutomaticMotion>(HandMapping{});
    case CouplingTarget::Kind::trace:
      try {
        return read_hand_file(coupling.trace);
      } catch (const InputError& error) {
        faults.add(error.faults());
      }
      break;
    case CouplingTarget::Kind::synthetic:
      return std::make_unique<SyntheticOperator>(coupling.seed, coupling.duration);
    case CouplingTarget::Kind::device:
      if (device) return std::make_unique<LentHand>(*device);
      return hand_at_rest(scene.model, coupling);
    case CouplingTarget::Kind::start:
    case CouplingTarget::Kind::state:
      if (!coupling.driven.turned.empty()) return hand_at_rest(scene.model, coupling);
      break;
  }
  return std::make_unique<RestingHand>();
}

}  // namespace

std::unique_ptr<OperatorMotion> make_hand(const SceneModel& scene, std::size_t pull,
                                          const OperatorMotion* device, const HandInPlace& in_place,
                                          DiagnosticList& faults) {
  const SceneCoupling& coupling = scene.couplings[pull];
  auto hand = hand_of_target(scene, coupling, device, faults);
  if (in_place) hand = in_place(pull, std::move(hand));
  if (coupling.delay == 0 && coupling.speed == 1) return hand;
  return std::make_unique<DelayedMotion>(std::move(hand), coupling.delay, coupling.speed);
}

}  // namespace twinarm
