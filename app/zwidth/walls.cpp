// Walls of the device alone: by rate, delay and damping, and over the plane of K and B.
#include <cmath>
#include <limits>

#include "app/zwidth/zwidth.h"

namespace twinarm {
namespace {

WallRow wall_row(const SampledDevice& device, double wall_damping) {
  WallRow row;
  row.device = device;
  row.wall_damping = wall_damping;
  SampledDevice smooth = device;  // the linear device that the other laws are about
  smooth.friction = smooth.resolution = 0;
  row.stable = largest_stable_stiffness(smooth, wall_damping);
  row.stable_law = uncoupled_stiffness(smooth, wall_damping);
  row.passive = largest_passive_stiffness(smooth, 0);
  row.passive_law = colgate_stiffness(smooth, 0);
  row.passive_damping = largest_passive_damping(smooth, 0);
  row.stepped = row.stepped_law = std::numeric_limits<double>::quiet_NaN();
  if (device.resolution > 0 && device.delay == 0) {
    row.stepped = largest_passive_stiffness(device, 0);
    row.stepped_law = abbott_okamura_stiffness(device);
  }
  return row;
}

}  // namespace

std::vector<WallRow> measure_walls(const SampledDevice& device, double wall_damping,
                                   const Tell& tell) {
  std::vector<SampledDevice> devices{device};
  const auto with = [&](auto change) {
    devices.push_back(device);
    change(devices.back());
  };
  for (const int more : {1, 2, 5}) with([&](SampledDevice& d) { d.delay += more; });
  for (const double factor : {0.5, 2.0, 4.0}) with([&](SampledDevice& d) { d.rate *= factor; });
  for (const double factor : {5.0, 20.0, 50.0})
    with([&](SampledDevice& d) { d.damping *= factor; });
  std::vector<WallRow> rows;
  for (const SampledDevice& d : devices) {
    rows.push_back(wall_row(d, wall_damping));
    tell(static_cast<double>(rows.size()) / static_cast<double>(devices.size()));
  }
  return rows;
}

WallPlane measure_plane(const SampledDevice& device, const Tell& tell) {
  WallPlane plane;
  plane.device = device;
  plane.device.friction = plane.device.resolution = 0;
  constexpr int kPoints = 16;
  const double b = device.damping, most = device.mass / device.tick();
  const double least = 0.02 * (b > 0 ? b : 1);
  for (int n = 0; n < kPoints; ++n) {
    const double part = n / (kPoints - 1.0);
    plane.stable_B.push_back(least * std::pow(most / least, part));
    plane.stable_K.push_back(largest_stable_stiffness(plane.device, plane.stable_B.back()));
    if (b > 0 && n % 2 == 0) {
      plane.passive_B.push_back(least * std::pow(0.97 * b / least, part));
      plane.passive_K.push_back(largest_passive_stiffness(plane.device, plane.passive_B.back()));
    }
    tell((n + 1.0) / kPoints);
  }
  return plane;
}

}  // namespace twinarm
