#include "app/lab/stream/lab_view.h"

#include "solver/model/mimic.h"

namespace twinarm {
namespace {

constexpr double kAspect = 1.35;  // as in a replay page
constexpr int kPoses = 64;
constexpr double kTrail = 10, kTrailStep = kTrail / 160;  // [s]; 160 pieces
constexpr std::size_t kTrailPoints = 9600;                // ten minutes

struct JointRange {
  std::size_t iq = 0;
  double low = 0, high = 0;
};

// Whether the link moves freely: the joints of a robot with a constraint depend on one another, and
// only its first links are taken as free.
bool is_free(const SceneView& stage, std::size_t body) {
  if (stage.model->parent[body] == 0 || !stage.scene) return true;
  const int link = static_cast<int>(body);
  for (std::size_t robot = 0; robot < stage.scene->description.robots.size(); ++robot) {
    const std::pair<int, int> links = stage.scene->bodies_of_robot(robot);
    const auto is_link = [&](int b) { return links.first <= b && b <= links.second; };
    if (is_link(link))
      return std::ranges::none_of(stage.scene->constraints, [&](const SceneConstraint& c) {
        return is_link(c.a) || is_link(c.b);
      });
  }
  return true;
}

std::vector<JointRange> ranges_of(const SceneView& stage, const RobotInput& robots) {
  std::vector<JointRange> ranges;
  for (const NamedJoint& joint : robots.coordinates.all()) {
    if (joint.components().size() != 1 || !is_free(stage, joint.body)) continue;
    const auto& joints = robots.robot.joints;
    const auto found = std::ranges::find(joints, joint.name, &JointDescription::name);
    const bool has_limits = found != joints.end() && found->is_limited() &&
                            std::isfinite(found->lower) && std::isfinite(found->upper);
    if (has_limits)
      ranges.push_back({joint.iq, found->lower, found->upper});
    else if (joint.components().front().is_angle)
      ranges.push_back({joint.iq, -std::numbers::pi, std::numbers::pi});
  }
  return ranges;
}

// n-th number of the van der Corput sequence: digits of n in that base, mirrored at the radix
// point.
double van_der_corput(int n, int base) {
  double value = 0, digit = 1;
  for (; n > 0; n /= base) {
    digit /= base;
    value += digit * (n % base);
  }
  return value;
}

void add_reach(SceneView& stage, const RobotInput& robots, const Snapshot& start) {
  constexpr std::array<int, 12> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  const std::vector<JointRange> ranges = ranges_of(stage, robots);
  if (ranges.empty()) return;
  SceneMeshes moved = stage.cast;  // robots alone
  moved.ties.clear();
  std::erase_if(moved.parts, [&](const ScenePart& part) {
    return part.robot < 0 || !is_free(stage, part.body);
  });
  Extent now;
  now.add(moved, start);
  const bool is_on_ground =
      !now.empty() && now.low().z() > -0.02 * now.radius() && now.low().z() < 0.05 * now.radius();
  const double lowest = is_on_ground ? std::min(0.0, now.low().z()) : -1e300;
  Snapshot pose(*stage.model);
  pose.x = start.x;
  for (int n = 1; n <= kPoses; ++n) {
    for (std::size_t j = 0; j < ranges.size(); ++j) {
      const double share = van_der_corput(n, kPrimes[j % kPrimes.size()]);
      pose.x.q[ranges[j].iq] = ranges[j].low + share * (ranges[j].high - ranges[j].low);
    }
    apply_mimics(*stage.model, pose.x);
    forward_kinematics(*stage.model, pose.x, pose.k);
    Extent reached;
    reached.add(moved, pose);
    for (Vector3 p : reached.points()) {
      p.z() = std::max(p.z(), lowest);
      stage.extent.add(p);
    }
  }
}

// Bodies hinged to the world, at eight angles.
void add_revolutions(SceneView& stage, const Snapshot& start) {
  if (!stage.scene) return;
  for (const SceneConstraint& c : stage.scene->constraints) {
    if (c.type != SceneConstraint::Type::hinge || (c.a != 0 && c.b != 0)) continue;
    const Pose hinge = c.a == 0 ? c.X_AC : c.X_BC;  // in the world
    SceneMeshes moved = stage.cast;
    moved.ties.clear();
    std::erase_if(moved.parts, [&](const ScenePart& part) {
      return static_cast<int>(part.body) != std::max(c.a, c.b);
    });
    Extent body;
    body.add(moved, start);
    for (int n = 1; n < 8; ++n) {
      const Eigen::AngleAxisd turn(n * std::numbers::pi / 4, hinge.R.col(2));
      for (const Vector3& p : body.points()) stage.extent.add(hinge.p + turn * (p - hinge.p));
    }
  }
}

// Smallest 1, 2 or 5 times a power of ten that is not below the value.
double round_up(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 0;
  double round = round_down(value);
  while (round < value * (1 - 1e-9)) round = round_down(round * 2.6);
  return round;
}

// From the weights at the start.
void set_first_scales(SceneView& stage, const Snapshot& start) {
  Scales& scales = stage.scales;
  const double g = to_eigen(stage.model->gravity).norm(), length = scales.length;
  double heaviest = 0;
  for (std::size_t i = 1; i < stage.model->parent.size(); ++i)
    heaviest = std::max(heaviest, stage.model->I[i].m);
  const double mass = total_motion(*stage.model, start.k).mass;
  const double speed = 0.2 * length;  // a fifth of the scene per second
  scales.contact_force = round_up(heaviest * g);
  scales.force = round_up(heaviest * g);
  scales.couple = round_up(0.1 * heaviest * g * length);
  scales.momentum = round_up(mass * speed);
  scales.kinetic = round_up(0.5 * mass * speed * speed);
}

}  // namespace

void extend_by_reach(SceneView& stage, const RobotInput& robots, const Snapshot& start) {
  look_at(stage, start);
  settle(stage);
  stage.farthest = 1e300;
  add_reach(stage, robots, start);
  add_revolutions(stage, start);
}

void set_live_view(SceneView& stage, const Snapshot& start, bool has_device) {
  stage.has_operator = true;  // a device may be chosen later
  stage.frames_device = has_device;
  set_view(stage, {}, kAspect);
  stage.trace.span = kTrail;
  set_first_scales(stage, start);
}

void grow_scales(SceneView& stage, const Snapshot& snapshot) {
  Scales seen;
  seen.widen_run(*stage.model, snapshot);
  seen.widen_contacts(snapshot);
  if (const auto& s = snapshot.mouse_spring) seen.force = std::max(seen.force, s->force_W.norm());
  for (double Scales::*scale_of : {&Scales::contact_force, &Scales::force, &Scales::couple,
                                   &Scales::momentum, &Scales::kinetic, &Scales::elastic}) {
    double& scale = stage.scales.*scale_of;
    const double value = std::exchange(seen.*scale_of, 0);
    if (value > scale && std::isfinite(value))
      scale = scale > 0 ? round_up(1.5 * scale) : round_up(value);
  }
  stage.scales.widen(seen);  // potential energies, for the bars
}

void extend_trails(SceneView& stage, const Snapshot& snapshot) {
  Trace& trace = stage.trace;
  const double t = snapshot.x.t;
  if (!std::isfinite(t)) return;
  while (!trace.t.empty() && trace.t.back() > t + 1e-9) {
    trace.t.pop_back();
    trace.p_Wc.pop_back();
  }
  if (!trace.t.empty() && t < trace.t.back() + kTrailStep) return;
  trace.add(*stage.model, snapshot);
  if (trace.t.size() <= kTrailPoints) return;
  const auto old = static_cast<std::ptrdiff_t>(kTrailPoints / 10);  // in blocks: erasing moves all
  trace.t.erase(trace.t.begin(), trace.t.begin() + old);
  trace.p_Wc.erase(trace.p_Wc.begin(), trace.p_Wc.begin() + old);
}

}  // namespace twinarm
