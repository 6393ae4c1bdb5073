// A map is cut into blocks of 16 x 16 cells (fewer at its far edges), numbered row by row. A block
// is what is kept when a map is interrupted.
#pragma once

#include <algorithm>
#include <cstddef>

namespace twinarm {

struct MapBlocks {
  static constexpr int kSide = 16;
  int nx = 0, ny = 0;  // cells of the map

  struct Block {
    int x0, x1, y0, y1;  // cells, the ends not included
    std::size_t cells() const { return static_cast<std::size_t>((x1 - x0) * (y1 - y0)); }
  };
  int columns() const { return (nx + kSide - 1) / kSide; }
  int count() const { return columns() * ((ny + kSide - 1) / kSide); }
  Block operator[](int b) const {
    const int x0 = b % columns() * kSide, y0 = b / columns() * kSide;
    return {x0, std::min(x0 + kSide, nx), y0, std::min(y0 + kSide, ny)};
  }
};

}  // namespace twinarm
