#include "app/device/devices.h"

namespace twinarm {

DeviceKind virtual_kind() {
  return {.place = 10,
          .name = "virtual",
          .argument = "[:HAND]",
          .help = "a Phantom Omni in software, moved by a scripted hand",
          .open =
              [](const std::string& hand, const VirtualOmniSettings& settings) {
                return std::make_unique<VirtualOmni>(scripted_hand(hand.empty() ? "paper" : hand),
                                                     settings);
              },
          .has_motors = true,
          .stays_inside = true};
}

}  // namespace twinarm
