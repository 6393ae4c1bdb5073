// `twinarm zwidth`: how stiff a wall a hand device can render, what is left of it through a
// coupling, and what a delay between hand and robot does. Each measure is a run; laws stand beside.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "coupling/device/passivity.h"

namespace twinarm {

// A device and its walls. Stiffnesses [N/m], dampings [N s/m].
struct WallRow {
  SampledDevice device;
  double wall_damping = 0;              // B of the first pair
  double stable = 0, stable_law = 0;    // largest K that is stable, nobody holding the device
  double passive = 0, passive_law = 0;  // largest K that gives no energy away, at B = 0
  double passive_damping = 0;           // largest B that gives none away, at K = 0
  double stepped = 0, stepped_law = 0;  // as passive, with friction and steps of the encoder;
                                        // not a number where there is none, or a delay
};
// The plane of K and B of one device.
struct WallPlane {
  SampledDevice device;
  std::vector<double> stable_B, stable_K, passive_B, passive_K;
};
// A wall k_e felt through a coupling k_c, by a link that is pressed against it.
struct SeriesRow {
  double coupling, wall, felt, law;  // [N/m]
};
// A hand that pushes a distant robot against a wall and draws it back.
struct DelayRow {
  std::string name;
  double delay = 0, jitter = 0, loss = 0;  // each way [s], [s], part of the packets
  bool control = false;
  double lowest = 0, end = 0, tick_work = 0;  // energy of the hand's side [J]; one tick's work
  double swing = 0;                           // of the hand in the last second [m]
  double felt = 0;                            // mean force while it is pressed [N]
  bool is_passive() const { return lowest >= -tick_work; }
  std::vector<double> t, energy, place;  // a sample each 10 ms
};
// A robot that follows the hand, all its joints coupled.
struct FollowRow {
  std::string robot, hand, joint;
  bool driven = false, slides = false;  // by the hand; along its axis: errors in metres
  double max = 0, mean = 0;             // [rad, m]
};

struct ZwidthResult {
  std::vector<WallRow> walls;
  WallPlane plane;
  std::vector<SeriesRow> series;
  std::vector<DelayRow> delays;
  std::vector<FollowRow> follows;
};

// Called with the part of the whole that is done; may throw Interrupted.
using Tell = std::function<void(double)>;

std::vector<WallRow> measure_walls(const SampledDevice& device, double wall_damping,
                                   const Tell& tell);
WallPlane measure_plane(const SampledDevice& device, const Tell& tell);
std::vector<SeriesRow> measure_series(const Tell& tell);
std::vector<DelayRow> measure_delays(const SampledDevice& device, unsigned seed, const Tell& tell);
std::vector<FollowRow> measure_follows(const std::filesystem::path& assets, unsigned seed,
                                       const Tell& tell);

std::string zwidth_table(const ZwidthResult& result);
std::string zwidth_json(const ZwidthResult& result);
std::string zwidth_csv(const ZwidthResult& result);
std::string zwidth_svg(const ZwidthResult& result);
std::string zwidth_png(const ZwidthResult& result);

}  // namespace twinarm
