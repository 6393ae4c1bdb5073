#include "app/device/devices.h"

namespace twinarm {

DeviceKind virtual_kind() {
  return {.place = 10,
          .name = "virtual",
          .argument = "[:MOTION]",
          .help = "simulated Phantom Omni, with a scripted operator motion",
          .open =
              [](const std::string& motion, const VirtualOmniSettings& settings) {
                return std::make_unique<VirtualOmni>(
                    scripted_motion(motion.empty() ? "paper" : motion), settings);
              },
          .has_motors = true,
          .stays_inside = true};
}

}  // namespace twinarm
