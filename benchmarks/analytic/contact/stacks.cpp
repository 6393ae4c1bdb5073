// Stacks at rest (E11): ten boxes, and one that is a hundred times heavier on top of a light one.
#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

constexpr double kEdge = 0.2;

struct Standing {
  double force = 0;               // largest error under a box [relative]
  double sideways = 0, sunk = 0;  // how far a box ever was from its place [m]
};
// Cubes of these masses from below, each up to 1 cm off the middle, for a time. Forces count once
// each box has got its own, from the tenth step on.
// Gravity may lean, and the boxes may be smaller than their places.
struct Stack {
  std::vector<double> masses{};
  double duration = 0;
  Vector3 gravity{0, 0, -kGravity};
  double size = 1;
};
Standing stand(const Stack& stack) {
  const auto& [masses, duration, gravity, size] = stack;
  ContactScene scene(gravity);
  scene.add_floor(surface(0.5));
  const int count = static_cast<int>(masses.size());
  std::vector<double> load(masses.size());  // on the lower face
  double above = 0;
  for (std::size_t i = masses.size(); i-- > 0;) load[i] = (above += masses[i]) * kGravity;
  std::vector<Vector3> places;
  for (int i = 0; i < count; ++i) {
    places.emplace_back(0.01 * std::sin(3 * i), 0.01 * std::cos(2 * i), (i + 0.5) * kEdge);
    scene.add({Box{Vector3::Constant(size * kEdge)}, surface(0.5),
               masses[static_cast<std::size_t>(i)], places.back()});
  }
  scene.start();
  Standing result;
  for (long n = 0; n < std::lround(duration / kStep); ++n) {
    scene.step(kStep);
    std::vector<double> below(masses.size(), 0);
    for (const ContactPoint& point : scene.contacts().points()) {
      const int a = scene.contacts().bodies().geometry(point.contact.a).body;
      const int b = scene.contacts().bodies().geometry(point.contact.b).body;
      below[static_cast<std::size_t>(std::max(a, b) - 1)] += std::abs(point.force_W.z());
    }
    for (int i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vector3 moved = scene.p(i + 1) - places[k];
      result.sideways = std::max(result.sideways, std::hypot(moved.x(), moved.y()));
      result.sunk = std::max(result.sunk, std::abs(moved.z()));
      if (n >= 10) result.force = std::max(result.force, relative(below[k], load[k]));
    }
  }
  return scene.ok() ? result : Standing{NAN, NAN, NAN};
}
const std::vector<double> kTen(10, 1.0);
Standing ten_boxes() {  // 10 s, run once, and anew for who looks on
  if (contact_recorder) return stand({kTen, 10});
  static const Standing result = stand({kTen, 10});
  return result;
}

CaseResult forces(double off) {  // gravity
  if (off == 1) return {ten_boxes().force};
  return {stand({kTen, 0.1, {0, 0, -kGravity * off}}).force};
}
CaseResult sideways(double off) {  // its mistake: gravity leans more than the friction holds
  if (off == 1) return {ten_boxes().sideways};
  return {stand({kTen, 0.1, kGravity * Vector3(off - 1, 0, -1)}).sideways};
}
CaseResult sinking(double off) {  // edges
  if (off == 1) return {ten_boxes().sunk};
  return {stand({kTen, 0.1, {0, 0, -kGravity}, off}).sunk};
}
CaseResult heavy_on_light(double off) {  // gravity
  return {stand({{1, 100}, 2, {0, 0, -kGravity * off}}).force};
}

// ---- what a page draws of them ----

// Forces under boxes that stand on each other.
template <int... boxes>
Values seen_loads(Scene s) {
  const auto under = [&](int box) {
    double sum = s.t() == 0 ? NAN : 0;
    for (const ContactPoint& point : s.contacts().points())
      if (std::max(s.contacts().bodies().geometry(point.contact.a).body,
                   s.contacts().bodies().geometry(point.contact.b).body) == box)
        sum += std::abs(point.force_W.z());
    return sum;
  };
  return {under(boxes)...};
}

ContactCasePlot top_box(const std::string& axis, Values (*read)(Scene)) {
  return {.readings = {axis + " of the top box [m]"},
          .read = read,
          .exact = zero,
          .until = 1,
          .from_start = true,
          .no_steps = kResting};
}

}  // namespace

CaseFamily stacks_cases() {
  return {270,
          {contact_case<forces, 1>(
               "E11-forces", 1e-6,
               {.readings = {"under box 1 [N]", "under box 5 [N]", "under box 10 [N]"},
                .read = seen_loads<1, 5, 10>,
                .exact = [](std::size_t k,
                            double) { return kGravity * (k == 0   ? 10
                                                         : k == 1 ? 6
                                                                  : 1); },
                .until = 1,
                .no_steps = kResting}),
           contact_case<sideways, 600>("E11-drift", 1e-5, top_box("x", place<10, 0>)),
           contact_case<sinking, -1>("E11-sinking", 1e-4, top_box("z", place<10, 2>)),
           contact_case<heavy_on_light, 1>(
               "E11-heavy", 1e-6,
               {.readings = {"under 1 kg [N]", "under 100 kg [N]"},
                .read = seen_loads<1, 2>,
                .exact = [](std::size_t k, double) { return kGravity * (k == 0 ? 101 : 100); },
                .no_steps = kResting})}};
}

}  // namespace twinarm
