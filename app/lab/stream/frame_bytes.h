// One frame of the run in bytes, and what plots need of many (docs/lab_protocol.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/page/draw_columns.h"

namespace twinarm {

// Kept from frame to frame: nothing is allocated once it is as large as it gets.
struct FrameColumns {
  std::uint32_t scene = 0, number = 0, flags = 0;
  double time = 0, stamp = 0, age = 0;  // [s]
  std::uint64_t step = 0;
  std::vector<double> channels, works;
  // By body: x y z, and the turn as a quaternion x y z w. Not finite: it has none.
  std::vector<float> link, twin;
  InstanceColumns instances;
  std::vector<std::uint16_t> body;
  LabelColumns labels;
  std::vector<std::uint32_t> text_end;
  std::string text;
  std::vector<std::uint32_t> first{0}, first_label{0};  // by layer
  void clear_entries();
  // Closes a layer: what was added since the one before is in it.
  void end_layer();
  // Left out where a browser could do nothing with it.
  void add(const Instance& instance);
  void add(const Label& label);
};

// Where bodies stand; those without a place (a kinematic robot has but its own) are NaN.
void put_places(const std::vector<Pose>& X_WL, std::size_t first, std::size_t end,
                std::vector<float>& places);

std::string frame_bytes(const FrameColumns& frame);

struct HistoryColumns {
  std::uint32_t scene = 0, channel_count = 0, row_count = 0;
  std::vector<double> time, channels, works;  // frame by frame
};
std::string history_bytes(const HistoryColumns& history);

}  // namespace twinarm
