#include "coupling/target/synthetic_operator.h"

#include "coupling/target/scripted_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace twinarm {
namespace {

// Ranges of the targets, inside the Phantom Omni's joint limits [rad].
constexpr std::array<double, 6> kLow{-0.75, 0.4, -0.4, -1.2, -0.3, -1.2};
constexpr std::array<double, 6> kHigh{0.75, 1.3, 0.8, 1.2, 1.2, 1.2};

// Uniform numbers, portable unlike the standard's distributions.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

SyntheticOperator::SyntheticOperator(unsigned seed, double duration, const SyntheticRanges& ranges)
    : seed_(seed), duration_(duration) {
  Draw draw(seed);
  std::array<double, 6> at{};
  for (std::size_t j = 0; j < 6; ++j) at[j] = 0.5 * (kLow[j] + kHigh[j]);
  bool button = false;
  for (double t = draw(0.2, 0.5); t < duration;) {
    Reach reach{t, 0, at, at, button};
    double distance = 0;
    for (std::size_t j = 0; j < 6; ++j) {
      reach.to[j] = draw(kLow[j], kHigh[j]);
      distance = std::max(distance, std::abs(reach.to[j] - at[j]));
    }
    const double peak_speed = draw(ranges.peak_speed[0], ranges.peak_speed[1]);
    reach.end = t + std::max(0.25, 15.0 / 8.0 * distance / peak_speed);
    if (draw(0, 1) < 0.2) button = !button;
    reach.button = button;
    reaches_.push_back(reach);
    at = reach.to;
    t = reach.end + draw(0.05, 0.4);
  }
  double tremor = ranges.tremor[0];
  if (ranges.tremor[1] > tremor) tremor *= std::pow(ranges.tremor[1] / tremor, draw(0, 1));
  for (auto& lines : tremor_)
    for (Tremor& line : lines)
      line = {tremor * draw(0.5, 1.0), 2 * std::numbers::pi * draw(8, 12),
              draw(0, 2 * std::numbers::pi)};
}

OperatorSample SyntheticOperator::sample(double t, double /*toward*/) const {
  OperatorSample sampled;
  const auto after = std::ranges::upper_bound(reaches_, t, {}, &Reach::start);
  if (after != reaches_.begin()) {
    const Reach& reach = *std::prev(after);
    const double T = reach.end - reach.start;
    add_minimum_jerk(reach.from, reach.to, std::min((t - reach.start) / T, 1.0), T, sampled);
    sampled.button = reach.button;
  } else if (!reaches_.empty()) {
    sampled.theta = reaches_.front().from;
  }
  for (std::size_t j = 0; j < 6; ++j)
    for (const Tremor& line : tremor_[j]) {
      sampled.theta[j] += line.amplitude * std::sin(line.omega * t + line.phase);
      sampled.theta_dot[j] += line.amplitude * line.omega * std::cos(line.omega * t + line.phase);
    }
  return sampled;
}

}  // namespace twinarm
