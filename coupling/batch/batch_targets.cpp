#include "coupling/batch/batch_targets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "coupling/target/operator_motion.h"

namespace twinarm {
namespace {

double* put(const Vector3& v, double* out) {
  return std::copy_n(v.data(), 3, out);
}

// Products of the target's own numbers (RowSizes).
void put_products(const RowSizes& size, const double* pose, const double* velocity, double* out) {
  if (size.products > 1) *out++ = std::inner_product(pose, pose + 3, velocity, 0.0);
  if (size.products > 0) *out = std::inner_product(velocity, velocity + 3, velocity, 0.0);
}

}  // namespace

// Writes one spring's numbers of the KVR to a table row.
struct BatchMotion::Reader {
  SpringKind kind;
  std::size_t iq, iv, body;
  Vector3 p_B;
  Discretization discretization;
  std::size_t target;

  Vector3 point(const TargetSample& kvr) const {
    return kvr.k.X_WL[body].p + kvr.k.R_WB[body] * p_B;
  }
  void pose(const TargetSample& kvr, double* out) const {
    if (kind == SpringKind::joint) *out = kvr.x.q[iq];
    if (kind == SpringKind::linear) put(point(kvr), out);
    for (int column = 0; column < 3 && kind == SpringKind::world; ++column)  // E = R^T, by rows
      out = put(kvr.k.R_WB[body].col(column), out);
  }
  void velocity(const TargetSample& kvr, double* out) const {
    if (kind == SpringKind::joint) *out = kvr.x.qd[iv];
    if (kind == SpringKind::linear) put(kvr.k.velocity(static_cast<int>(body), point(kvr)), out);
    if (kind == SpringKind::world) put(kvr.k.w_WL[body], out);
  }
};

BatchMotion::BatchMotion(const BatchSetup& setup) : joints(setup.measured.size()) {
  for (const BatchSpring& spring : setup.springs) {
    places.push_back({motion_stride, energy_stride});
    const RowSizes size = row_sizes(spring.kind);
    motion_stride += size.pose + size.velocity;
    energy_stride += size.pose + 2 * size.velocity + size.products;
  }
}

void BatchMotion::fill(const BatchSetup& setup, const ModelWithoutFixedJoints& merged,
                       const BatchCell& cell) {
  constexpr double kSameTime = 1e-9;     // [steps]
  stored_steps(setup.duration, cell.h);  // throws; cells of the shortest step come first
  const double whole = std::floor(setup.duration / cell.h + kSameTime);
  const double rest = setup.duration - whole * cell.h;
  const bool has_rest = rest > kSameTime * cell.h;
  steps = static_cast<std::size_t>(whole) + (has_rest ? 1 : 0);
  last_step = has_rest ? rest : cell.h;
  motion.assign(steps * motion_stride, 0);
  energy.assign((steps + 1) * energy_stride, 0);
  q_K.assign((steps + 1) * joints, 0);

  std::vector<DelayedMotion> motions;
  std::vector<TargetRobot> kvrs;
  motions.reserve(setup.targets.size());
  for (const BatchTarget& target : setup.targets) {
    motions.emplace_back(*target.motion, cell.delay, cell.speed);
    kvrs.emplace_back(merged.model, motions.back(), OperatorMapping{}, target.joints);
    kvrs.back().set_pose(target.rest);
  }
  std::vector<Reader> readers;
  for (std::size_t s = 0; s < setup.springs.size(); ++s) {
    const BatchSpring& spring = setup.springs[s];
    const auto body = static_cast<std::size_t>(spring.body);
    const Vec3<double> p = merged.point_of(*setup.model, body, cell.springs[s].p_L);
    readers.push_back({spring.kind, setup.model->iq[body], setup.model->iv[body],
                       merged.carrier[body], to_eigen(p), spring.discretization, spring.target});
  }
  double t = setup.start.t;
  for (std::size_t n = 0; n < steps; ++n, t += cell.h) {
    for (TargetRobot& kvr : kvrs) kvr.begin_step(t, n + 1 < steps ? cell.h : last_step);
    fill_step(n, setup, readers, kvrs);
  }
  find_velocity_jumps(setup, cell.h);
  find_range();
}

void BatchMotion::find_range() {
  low.assign(joints, std::numeric_limits<double>::infinity());
  high.assign(joints, -std::numeric_limits<double>::infinity());
  for (std::size_t at = 0; at < q_K.size(); ++at) {
    low[at % joints] = std::min(low[at % joints], q_K[at]);
    high[at % joints] = std::max(high[at % joints], q_K[at]);
  }
}

void BatchMotion::find_velocity_jumps(const BatchSetup& setup, double h) {
  is_velocity_jump.assign(steps + 1, 0);
  is_velocity_jump.front() = is_velocity_jump.back() = 1;
  if (last_step != h) is_velocity_jump[steps - 1] = 1;
  for (std::size_t s = 0; s < places.size(); ++s) {
    const RowSizes size = row_sizes(setup.springs[s].kind);
    for (std::size_t n = 1; n < steps; ++n) {
      const double* before = &energy[n * energy_stride + places[s].energy + size.pose];
      if (!std::equal(before, before + size.velocity, before + size.velocity))
        is_velocity_jump[n] = 1;
    }
  }
}

void BatchMotion::fill_step(std::size_t n, const BatchSetup& setup,
                            const std::vector<Reader>& readers,
                            const std::vector<TargetRobot>& kvrs) {
  for (std::size_t s = 0; s < readers.size(); ++s) {
    const Reader& of = readers[s];
    const RowSizes size = row_sizes(of.kind);
    const TargetSample &start = kvrs[of.target].start(), &end = kvrs[of.target].end();
    double* out = &motion[n * motion_stride + places[s].motion];
    of.pose(of.discretization == Discretization::implicit ? end : start, out);
    of.velocity(of.discretization == Discretization::explicit_ ? start : end, out + size.pose);
    double* pose = &energy[n * energy_stride + places[s].energy];
    double *before = pose + size.pose, *after = before + size.velocity;
    of.pose(start, pose);
    of.velocity(start, after);
    put_products(size, pose, after, after + size.velocity);
    of.pose(end, pose + energy_stride);  // overwritten by the next step's start, except at the end
    of.velocity(end, before + energy_stride);
  }
  for (std::size_t j = 0; j < joints; ++j) {
    const std::size_t iq = setup.measured[j];
    if (n == 0) q_K[j] = kvrs.front().start().x.q[iq];
    q_K[(n + 1) * joints + j] = kvrs.front().end().x.q[iq];
  }
}

}  // namespace twinarm
