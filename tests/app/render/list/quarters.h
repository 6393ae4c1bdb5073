// A picture with four different quarters.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "app/render/list/image.h"

namespace twinarm {

// Red and green above, blue and white below.
inline Image quarters(int side) {
  Image image;
  image.width = image.height = side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const bool right = x >= side / 2, low = y >= side / 2;
      const auto on = [](bool yes) { return static_cast<std::uint8_t>(yes ? 255 : 0); };
      for (const std::uint8_t c : {on(!right && !low), on(right && !low), on(!right && low)})
        image.rgba.push_back(right && low ? 255 : c);
      image.rgba.push_back(255);
    }
  return image;
}

// Dominant colour 'r', 'g', 'b', or 'w', at an offset right and down of the centre.
inline char color_at(const Image& image, int right, int down) {
  const std::uint8_t* p = image.pixel(image.width / 2 + right, image.height / 2 + down);
  const auto most = std::max_element(p, p + 3), least = std::min_element(p, p + 3);
  return *most - *least < 40 ? 'w' : "rgb"[most - p];
}

inline std::string quarters_of(const Image& image) {
  return {color_at(image, -10, -10), color_at(image, 10, -10), color_at(image, -10, 10),
          color_at(image, 10, 10)};
}

}  // namespace twinarm
