// The picture of a texture.
#include "app/render/list/image.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void image(Bytes bytes) {
  goes_through([&] {
    const Image read = decode_image("texture", bytes);
    require(read.rgba.size() == 4 * static_cast<std::size_t>(read.width * read.height),
            "a picture has not as many bytes as its size says");
  });
}

}  // namespace twinarm::fuzz
