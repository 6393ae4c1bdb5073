// What a VRPN server says, in portions of any size.
#include <algorithm>
#include <cmath>

#include "app/device/vrpn_stream.h"
#include "coupling/device/omni.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void vrpn(Bytes bytes) {
  VrpnStream stream("Phantom0");
  for (std::size_t at = 0, size = 1; at < bytes.size(); at += size) {
    size = std::min(bytes.size() - at, 1 + static_cast<unsigned char>(bytes[at]) * std::size_t{3});
    const auto* part = reinterpret_cast<const std::uint8_t*>(bytes.data() + at);
    if (stream.feed(part, size) != VrpnStream::Error::none) break;
  }
  stream.devices();
  if (const auto theta = omni_inverse(OmniParameters(), stream.pose()))
    for (const double angle : *theta)
      require(std::isfinite(angle), "a pose that was taken gives an angle that is not finite");
}

}  // namespace twinarm::fuzz
