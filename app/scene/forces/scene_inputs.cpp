#include "app/scene/forces/scene_couplings.h"

#include "app/support/text.h"
#include "coupling/device/device_motion.h"

namespace twinarm {
namespace {

// Holds the driven joints at their rest positions: without a device, or until an input takes over.
std::unique_ptr<OperatorMotion> rest_position(const Model<double>& model,
                                              const SceneCoupling& coupling) {
  MappedTarget target;
  for (const std::string& joint : coupling.driven.turned) {
    const auto body = static_cast<std::size_t>(model.find_joint(joint));
    target.q.push_back(coupling.rest.q[model.iq[body]]);
    target.qd.push_back(0);
  }
  auto motion = std::make_unique<DeviceMotion>(1);
  motion->set(target, 0, 1);
  return motion;
}

std::unique_ptr<OperatorMotion> motion_of_target(const SceneModel& scene,
                                                 const SceneCoupling& coupling,
                                                 const OperatorMotion* device,
                                                 DiagnosticList& faults) {
  switch (coupling.target.kind) {
    case CouplingTarget::Kind::paper:
      return std::make_unique<AutomaticMotion>(OperatorMapping{});
    case CouplingTarget::Kind::trace:
      if (auto motion = attempt(faults, [&] { return read_motion_file(coupling.target.trace); }))
        return std::move(*motion);
      break;
    case CouplingTarget::Kind::synthetic:
      return std::make_unique<SyntheticOperator>(coupling.target.seed, coupling.target.duration,
                                                 coupling.target.ranges);
    case CouplingTarget::Kind::device:
      return std::make_unique<OverridableMotion>(rest_position(scene.model, coupling),
                                                 [device](double, double) { return device; });
    case CouplingTarget::Kind::start:
    case CouplingTarget::Kind::state:
      break;
  }
  return rest_position(scene.model, coupling);
}

}  // namespace

std::unique_ptr<OperatorMotion> make_operator_motion(const SceneModel& scene, std::size_t index,
                                                     const OperatorMotion* device,
                                                     const MotionReplacement& in_place,
                                                     DiagnosticList& faults) {
  const SceneCoupling& coupling = scene.couplings[index];
  auto motion = motion_of_target(scene, coupling, device, faults);
  if (in_place) motion = in_place(index, std::move(motion));
  if (coupling.delay == 0 && coupling.speed == 1) return motion;
  return std::make_unique<DelayedMotion>(std::move(motion), coupling.delay, coupling.speed);
}

}  // namespace twinarm
