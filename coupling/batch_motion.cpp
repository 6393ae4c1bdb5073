#include "coupling/batch_motion.h"

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

using SpringType = CouplingSpec::Type;

bool is_at_joint(const BatchSpring& spring) {
  return spring.type == SpringType::torsional && spring.measure == Measure::joint;
}

double* put(const Vector3& v, double* out) {
  return std::copy_n(v.data(), 3, out);
}

// Reads one spring's numbers off the KVR, and writes them one after another.
struct SpringOnKvr {
  const Model<double>& model;
  const BatchSpring& spring;
  Vector3 p_L;
  std::size_t carrier;  // the link that the spring's link is fixed to, or itself

  double* pose(const KvrSample& kvr, double* out) const {
    const auto i = static_cast<std::size_t>(spring.body);
    if (is_at_joint(spring)) return *out = kvr.x.q[model.iq[i]], out + 1;
    if (spring.type == SpringType::linear) return put(kvr.k.position(spring.body, p_L), out);
    for (int column = 0; column < 3; ++column)  // E = R^T, by rows
      out = put(kvr.k.R_WB[carrier].col(column), out);
    return out;
  }
  double* velocity(const KvrSample& kvr, double* out) const {
    const auto i = static_cast<std::size_t>(spring.body);
    if (is_at_joint(spring)) return *out = kvr.x.qd[model.iv[i]], out + 1;
    if (spring.type == SpringType::linear)
      return put(kvr.k.velocity(spring.body, kvr.k.position(spring.body, p_L)), out);
    return put(kvr.k.w_WL[i], out);
  }
};

}  // namespace

HandSample ShiftedHand::sample(double t, double toward) const {
  constexpr double kSameTime = 1e-9;  // [s]: a step that begins with the motion, to rounding
  const double since = t - delay_;
  const bool waits = std::abs(since) < kSameTime ? toward < t : since < 0;
  HandSample hand =
      waits ? hand_.sample(0, 1) : hand_.sample(speed_ * since, speed_ * (toward - delay_));
  for (double& rate : hand.theta_dot) rate *= waits ? 0 : speed_;
  return hand;
}

BatchMotion::BatchMotion(const BatchSetup& setup) : joints(setup.measured.size()) {
  for (const BatchSpring& spring : setup.springs) {
    places.push_back({motion_stride, energy_stride});
    const bool at_joint = is_at_joint(spring);
    const std::size_t pose = at_joint ? 1 : spring.type == SpringType::linear ? 3 : 9;
    const std::size_t velocity = at_joint ? 1 : 3;
    motion_stride += pose + velocity;
    if (setup.energy) energy_stride += pose + 2 * velocity;
  }
}

void BatchMotion::fill(const BatchSetup& setup, const LumpedModel& lumped, const BatchCell& cell) {
  constexpr double kSameTime = 1e-9;  // parts of a step
  const double whole = std::floor(setup.duration / cell.h + kSameTime);
  const double rest = setup.duration - whole * cell.h;
  const bool has_rest = rest > kSameTime * cell.h;
  steps = static_cast<std::size_t>(whole) + (has_rest ? 1 : 0);
  last_step = has_rest ? rest : cell.h;
  motion.assign(steps * motion_stride, 0);
  energy.assign((steps + 1) * energy_stride, 0);
  q_K.assign((steps + 1) * joints, 0);

  std::vector<ShiftedHand> hands;
  std::vector<KinematicRobot> kvrs;
  hands.reserve(setup.targets.size());
  for (const BatchTarget& target : setup.targets) {
    hands.emplace_back(*target.hand, cell.speed, cell.delay);
    kvrs.emplace_back(*setup.model, hands.back(), target.mapping, target.joints);
    kvrs.back().stand_at(target.rest);
  }
  double t = setup.start.t;
  for (std::size_t n = 0; n < steps; ++n, t += cell.h) {
    for (KinematicRobot& kvr : kvrs) kvr.begin_step(t, n + 1 < steps ? cell.h : last_step);
    fill_step(n, setup, lumped, cell, kvrs);
  }
  if (setup.energy) find_corners(setup, cell.h);
}

void BatchMotion::find_corners(const BatchSetup& setup, double h) {
  is_corner.assign(steps + 1, 0);
  is_corner.front() = is_corner.back() = 1;
  if (last_step != h) is_corner[steps - 1] = 1;
  for (std::size_t n = 1; n < steps; ++n)
    for (std::size_t s = 0; s < places.size(); ++s) {
      const bool at_joint = is_at_joint(setup.springs[s]);
      const std::size_t size = at_joint ? 1 : 3;
      const std::size_t next = s + 1 < places.size() ? places[s + 1].energy : energy_stride;
      const double* after = &energy[n * energy_stride + next - size];
      if (!std::equal(after, after + size, after - size)) is_corner[n] = 1;
    }
}

void BatchMotion::fill_step(std::size_t n, const BatchSetup& setup, const LumpedModel& lumped,
                            const BatchCell& cell, std::vector<KinematicRobot>& kvrs) {
  for (std::size_t s = 0; s < setup.springs.size(); ++s) {
    const BatchSpring& spring = setup.springs[s];
    const auto body = static_cast<std::size_t>(spring.body);
    const SpringOnKvr of{*setup.model, spring, cell.springs[s].p_L,
                         lumped.origin[lumped.carrier[body]]};
    const KvrSample &start = kvrs[spring.target].start(), &end = kvrs[spring.target].end();
    const bool implicit = spring.treatment == Treatment::implicit;
    const bool explicit_ = spring.treatment == Treatment::explicit_;
    double* out = of.pose(implicit ? end : start, &motion[n * motion_stride + places[s].motion]);
    of.velocity(explicit_ ? start : end, out);
    if (!setup.energy) continue;
    const std::size_t here = n * energy_stride + places[s].energy;
    const auto velocities = static_cast<std::size_t>(of.pose(start, &energy[here]) - &energy[0]);
    const std::size_t one = is_at_joint(spring) ? 1 : 3, next = velocities + energy_stride;
    of.velocity(start, &energy[velocities + one]);  // after t
    of.velocity(end, &energy[next]);                // before t + h
    of.pose(end, &energy[here + energy_stride]);    // as the next step's start, but for the last
  }
  for (std::size_t j = 0; j < joints; ++j) {
    const std::size_t iq = setup.measured[j];
    if (n == 0) q_K[j] = kvrs.front().start().x.q[iq];
    q_K[(n + 1) * joints + j] = kvrs.front().end().x.q[iq];
  }
}

}  // namespace twinarm
