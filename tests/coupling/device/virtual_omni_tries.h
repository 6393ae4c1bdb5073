// A virtual Omni under test: a motion at rest, settings with closed forms, a host that applies
// forces.
#pragma once

#include <cstring>
#include <functional>
#include <memory>

#include "coupling/device/virtual_omni.h"
#include "coupling/target/scripted_motion.h"

namespace twinarm::testing {

inline constexpr double kTick = 1e-3;
inline constexpr DeviceAngles kPosture{0.2, 0.7, 0.15, 0.1, 0.6, -0.2};

inline std::shared_ptr<const OperatorMotion> resting_hand() {
  return std::make_shared<StepMotion>(kPosture, kPosture, 0, 1);
}
// No friction, no quantisation: closed forms.
inline VirtualOmniSettings closed_form() {
  VirtualOmniSettings s;
  s.parameters.friction = 0;
  s.parameters.resolution = 0;
  return s;
}
inline VirtualOmniSettings not_held(VirtualOmniSettings s) {
  s.arm = {0, 0, 0};
  return s;
}
// Motor torques of a force at the stylus' point, J^T F.
inline std::array<double, 3> omni_torque(const OmniParameters& omni, const OmniAngles& theta,
                                         const Vector3& force) {
  const Vector3 tau = omni_jacobian(omni, theta).transpose() * force;
  return {tau.x(), tau.y(), tau.z()};
}
// A host that applies a force at the measured stylus pose.
inline void push_stylus(VirtualOmni& omni, const DeviceState& seen, const Vector3& force) {
  omni.render({omni_torque(omni.parameters(), seen.theta, force)});
}
// Tick by tick; `force` from the tick and the measured state.
inline void run_ticks(VirtualOmni& omni, int from, int to,
                      const std::function<Vector3(int, const DeviceState&)>& force) {
  for (int n = from; n < to; ++n) {
    const DeviceState seen = omni.poll(n * kTick);
    push_stylus(omni, seen, force(n, seen));
  }
  omni.poll(to * kTick);
}
inline bool same_bits(const DeviceState& a, const DeviceState& b) {
  return std::memcmp(a.theta.data(), b.theta.data(), sizeof a.theta) == 0 &&
         std::memcmp(a.stylus.p.data(), b.stylus.p.data(), 3 * sizeof(double)) == 0 &&
         std::memcmp(a.stylus.R.data(), b.stylus.R.data(), 9 * sizeof(double)) == 0 &&
         a.buttons == b.buttons && a.alive == b.alive;
}

}  // namespace twinarm::testing
