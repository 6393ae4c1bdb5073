// One axis of a map: a number of the scene, and the values that it takes.
#pragma once

#include <optional>
#include <string>

#include "solver/support/diagnostics.h"

namespace twinarm {

struct MapAxis {
  std::string path;  // of the number in the scene file (app/scene/read/parameter_path.h)
  double from = 0, to = 0;
  int count = 0;  // cells, both ends included
  bool log = false;

  // At a cell, or between two of them: u in [0, count - 1]. The ends are `from` and `to` to the
  // bit.
  double at(double u) const;
  // Where a value lies between the cells.
  double place_of(double value) const;
  std::string text() const;  // PATH:FROM:TO:N[:log], each number in the fewest digits
};

// PATH:FROM:TO:N[:log]; adds all its faults, which name the option, and returns nothing then.
std::optional<MapAxis> parse_axis(const std::string& option, const std::string& text,
                                  FaultList& faults);

}  // namespace twinarm
