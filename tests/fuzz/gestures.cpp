// The bytes of keyboard, game controller and space mouse, in two portions.
#include "app/device/gesture_device.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void gestures(Bytes bytes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const std::size_t first = bytes.empty() ? 0 : data[0] % bytes.size();
  KeyDecoder keys;
  JoystickDecoder usual, by_codes({bytes.begin(), bytes.begin() + static_cast<long>(first)});
  SpaceMouseDecoder mouse;
  for (GestureDecoder* decoder :
       {static_cast<GestureDecoder*>(&keys), static_cast<GestureDecoder*>(&usual),
        static_cast<GestureDecoder*>(&by_codes), static_cast<GestureDecoder*>(&mouse)}) {
    DesktopInput hand((OmniParameters()));
    decoder->feed(data, first, 0.1, hand);
    decoder->feed(data + first, bytes.size() - first, 0.2, hand);
    decoder->pass(1, hand);
    hand.sample(1, 1.001);
    decoder->forget();
  }
}

}  // namespace twinarm::fuzz
