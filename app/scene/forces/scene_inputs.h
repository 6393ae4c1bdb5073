// What moves the kinematic sides of a scene's couplings.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "app/scene/model/scene_model.h"
#include "coupling/target/operator_motion.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// What moves the kinematic side of a pull in place of the hand that the scene gives it, which is
// handed over to be asked. Pulls with one kinematic robot between them are asked for once.
using HandInPlace =
    std::function<std::unique_ptr<HandSource>(std::size_t pull, std::unique_ptr<HandSource> own)>;

// As the scene says of the pull; `device` is what couplings with target = "device" follow, nullptr
// where none is connected. Adds a fault for a trace that cannot be read.
std::unique_ptr<HandSource> make_hand(const SceneModel& scene, std::size_t pull,
                                      const HandSource* device, const HandInPlace& in_place,
                                      FaultList& faults);

}  // namespace twinarm
