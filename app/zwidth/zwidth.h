// `twinarm zwidth`: stiffness of virtual walls that a device renders, alone and through a coupling,
// and the effect of a delay between device and robot. Each value is measured in runs and predicted.
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
  double stable = 0, stable_law = 0;    // largest stable K, free device
  double passive = 0, passive_law = 0;  // largest passive K, at B = 0
  double passive_damping = 0;           // largest passive B, at K = 0
  // Passive K with friction and encoder quantisation; NaN without them, or with a delay.
  double quantized = 0, quantized_law = 0;
};
// Limits in the plane of K and B of one device.
struct WallPlane {
  SampledDevice device;
  std::vector<double> stable_B, stable_K, passive_B, passive_K;
};
// Stiffness of a wall k_e rendered through a coupling k_c by a link in contact.
struct SeriesRow {
  double coupling, wall, rendered, law;  // [N/m]
};
// An operator pushes a remote robot against a wall and back.
struct DelayRow {
  std::string name;
  double delay = 0, jitter = 0, loss = 0;     // each way [s], [s], share of the packets
  bool control = false;                       // with the passivity controller
  double lowest = 0, end = 0, tick_work = 0;  // energy put in by the operator [J]; work of one tick
  double amplitude = 0;                       // peak to peak, of the device in the last second [m]
  double force = 0;                           // mean while pressed [N]
  bool is_passive() const { return lowest >= -tick_work; }
  std::vector<double> t{}, energy{}, position{};  // every 10 ms
};
// Tracking error of a joint, all joints of the robot coupled.
struct TrackingRow {
  std::string robot, motion, joint;
  bool driven = false, slides = false;  // by the operator; prismatic: errors in metres
  double max = 0, mean = 0;             // [rad, m]
};

struct ZwidthResult {
  std::vector<WallRow> walls;
  WallPlane plane;
  std::vector<SeriesRow> series;
  std::vector<DelayRow> delays;
  std::vector<TrackingRow> follows;
};

// Called with the finished share; may throw Interrupted.
using Tell = std::function<void(double)>;

std::vector<WallRow> measure_walls(const SampledDevice& device, double wall_damping,
                                   const Tell& tell);
WallPlane measure_plane(const SampledDevice& device, const Tell& tell);
std::vector<SeriesRow> measure_series(const Tell& tell);
std::vector<DelayRow> measure_delays(const SampledDevice& device, unsigned seed, const Tell& tell);
std::vector<TrackingRow> measure_follows(const std::filesystem::path& assets, unsigned seed,
                                         const Tell& tell);

std::string zwidth_table(const ZwidthResult& result);
std::string zwidth_json(const ZwidthResult& result);
std::string zwidth_csv(const ZwidthResult& result);
std::string zwidth_svg(const ZwidthResult& result);
std::string zwidth_png(const ZwidthResult& result);

}  // namespace twinarm
