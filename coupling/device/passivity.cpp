#include "coupling/device/passivity.h"

#include <array>
#include <numbers>
#include <vector>

namespace twinarm {
void PassivityControl::set_position(const Vector3& x) noexcept {
  if (placed_ && x != x_) {
    d_ = x - x_;
    E_ -= held_.dot(d_);
    lowest_ = std::min(lowest_, E_);
  }
  x_ = x;
  placed_ = true;
}

Vector3 PassivityControl::passive_force(const Vector3& wanted) const noexcept {
  const double square = d_.squaredNorm();
  if (!(square > 0)) return wanted;
  const double work = wanted.dot(d_);
  if (E_ < 0) return -std::min(-2 * E_ / square, max_damping_) * d_;
  return work > E_ ? Vector3(wanted - (work - E_) / square * d_) : wanted;
}

double PassivityControl::force_fraction() const noexcept {
  constexpr double kMinFraction = 1e-9;  // also at the lowest energy, to allow recovery
  return max_ > 0 ? std::clamp(kMinFraction + (E_ - lowest_) / max_, kMinFraction, 1.0) : 1.0;
}

Vector3 PassivityControl::tick(const Vector3& x, const Vector3& wanted, double peak) noexcept {
  set_position(x);
  Vector3 force = passive_force(wanted);
  const double max_force = peak * force_fraction(), size = force.norm();
  if (size > max_force) force *= max_force / size;
  set_held_force(force);
  return force;
}

namespace {

// State transition over a tick with constant force, exact for m x'' + b x' = F.
struct HeldTick {
  double x_v, x_F, v_v, v_F;
  explicit HeldTick(const SampledDevice& d) {
    const double T = d.tick(), r = d.damping * T / d.mass;
    v_v = std::exp(-r);
    if (r < 1e-8) {  // b = 0 to rounding
      x_v = T;
      v_F = T / d.mass;
      x_F = 0.5 * T * T / d.mass;
      return;
    }
    const double left = -std::expm1(-r);
    x_v = d.mass / d.damping * left;
    v_F = left / d.damping;
    x_F = (T - x_v) / d.damping;
  }
};

// Bisection for the largest value from 0 on at which is_true; 0 if there is none.
template <class Predicate>
double bisect(Predicate&& is_true) {
  double low = 0, high = 1e-3;
  while (is_true(high)) {
    low = high;
    high *= 2;
    if (high > 1e9) return high;
  }
  if (low == 0 && !is_true(1e-6)) return 0;
  while (high - low > 1e-5 * high) {
    const double middle = 0.5 * (low + high);
    (is_true(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Work of the operator over a cycle of m periods in kCycle ticks; gross: sum of absolute values.
struct CycleWork {
  double net = 0, gross = 0;
};
constexpr int kCycle = 512;  // [ticks]

CycleWork work_of_cycle(const SampledDevice& device, double K, double B, int m, double A,
                        const std::array<double, kCycle>& cosine) {
  const double T = device.tick(), q = device.resolution;
  const auto position = [&](int n) {
    return A * cosine[static_cast<std::size_t>((n + 4 * kCycle) * m % kCycle)];
  };
  const auto sensed = [&](int n) { return q > 0 ? q * std::floor(position(n) / q) : position(n); };
  CycleWork work;
  double before = sensed(-device.delay - 1), at = position(0);
  for (int n = 0; n < kCycle; ++n) {
    const double y = sensed(n - device.delay), next = position(n + 1), dx = next - at;
    const double wall = (K * y + B * (y - before) / T) * dx;
    const double dissipated = device.damping * dx * dx / T + device.friction * std::abs(dx);
    work.net += wall + dissipated;
    work.gross += std::abs(wall) + dissipated;
    before = y;
    at = next;
  }
  return work;
}

}  // namespace

double abbott_okamura_stiffness(const SampledDevice& device) {
  const double by_damping = 2 * device.damping / device.tick();
  if (!(device.resolution > 0)) return by_damping;
  return std::min(by_damping, 2 * device.friction / device.resolution);
}

bool is_stable(const SampledDevice& device, double K, double B) {
  constexpr int kWindow = 10000;
  const HeldTick tick(device);
  const double T = device.tick();
  std::vector<double> past(static_cast<std::size_t>(device.delay) + 2, 1.0);  // newest first
  double x = 1, v = 0, window = 0, before = 0;
  for (int n = 1; n <= 3 * kWindow; ++n) {
    std::rotate(past.begin(), past.end() - 1, past.end());
    past.front() = x;
    const double y = past[past.size() - 2], F = -K * y - B * (y - past.back()) / T;
    x += tick.x_v * v + tick.x_F * F;
    v = tick.v_v * v + tick.v_F * F;
    const double size = std::abs(x) + T * std::abs(v);
    if (!(size < 1e9)) return false;
    window = std::max(window, size);
    if (n % kWindow) continue;
    if (n > kWindow && window > before * (1 + 1e-12)) return false;
    if (window < 1e-100) return true;
    before = window;
    window = 0;
  }
  return true;
}

bool is_passive(const SampledDevice& device, double K, double B) {
  std::array<double, kCycle> cosine{};
  for (std::size_t n = 0; n < kCycle; ++n)
    cosine[n] = std::cos(2 * std::numbers::pi * static_cast<double>(n) / kCycle);
  std::vector<double> amplitudes{1.0};
  if (device.friction > 0 || device.resolution > 0) {
    const double unit = device.resolution > 0 ? device.resolution : 1e-5;
    amplitudes = {0.001 * unit, 0.1 * unit, 0.9 * unit, 3.3 * unit, 100 * unit, 1e6 * unit};
  }
  for (const double A : amplitudes)
    for (int m = kCycle / 2; m >= 1; --m) {
      const CycleWork work = work_of_cycle(device, K, B, m, A, cosine);
      if (work.net < -1e-12 * work.gross) return false;
    }
  return true;
}

double max_stable_stiffness(const SampledDevice& device, double B) {
  return bisect([&](double K) { return is_stable(device, K, B); });
}
double max_passive_stiffness(const SampledDevice& device, double B) {
  return bisect([&](double K) { return is_passive(device, K, B); });
}
double max_passive_damping(const SampledDevice& device, double K) {
  return bisect([&](double B) { return is_passive(device, K, B); });
}

}  // namespace twinarm
