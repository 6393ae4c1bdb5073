// What is told of a live run: punctuality, tracking, forces. As a table, as JSON, as a picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/servo/servo_loop.h"

namespace twinarm {

// Gathered from the ticks by the thread that drains the ring.
struct LiveSummary {
  std::string scene, device, mapping, felt;  // in words
  std::vector<std::string> joints;
  double step = 0, duration = 0;           // [s]; the time that the run has reached
  long ticks = 0, held = 0, released = 0;  // ticks of each mode of silence
  long silences = 0;
  std::array<double, 3> largest_torque{};        // felt [N m]
  std::vector<double> largest_error, sum_error;  // |q_K - q_D| by joint [rad]
  std::string log, recording, picture;           // files; empty where there is none
  bool same_bits = false;                        // the run made again ended in the same state
  ServoResult servo;
  bool real_time = true;
};

std::string live_table(const LiveSummary& summary);
std::string live_json(const LiveSummary& summary);
// Two histograms, lateness and processor time of a tick; beside an empty loop's where there is one.
// SVG or PNG by the name. Throws InputError without gnuplot.
void draw_timing(const LiveSummary& summary, const std::filesystem::path& file);

}  // namespace twinarm
