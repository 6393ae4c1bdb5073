// The file of a hand, trace or log: read, and asked within its time, before it and after it.
#include "coupling/device/device_motion.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void hand_file(Bytes bytes) {
  goes_through([&] {
    const auto hand = read_motion_file(folder().write("hand.csv", bytes));
    const double end = hand->duration();
    for (const double t : {0.0, 0.3 * end, end, -1.0, 2 * end + 1}) hand->sample(t, t + 0.001);
    require(!hand->description().empty(), "a hand has no description");
  });
}

}  // namespace twinarm::fuzz
