// E11: stacks at rest: ten boxes, and a box on one of a hundredth of its mass.
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kEdge = 0.2;

// Vertical contact force on the lower face of a box of a stack.
double force_under(Scene scene, int box) {
  double sum = 0;
  for (const ContactPoint& point : scene.contacts().points())
    if (std::max(scene.contacts().bodies().geometry(point.contact.a).body,
                 scene.contacts().bodies().geometry(point.contact.b).body) == box)
      sum += std::abs(point.force_W.z());
  return sum;
}

struct StackErrors {
  double force = 0;                         // under a box [relative]
  double displacement = 0, settlement = 0;  // horizontal and vertical, of a box [m]
};
// Cubes, masses from below, each up to 1 cm off the middle.
struct Stack {
  std::vector<double> masses{};
  double duration = 0;
  Vector3 gravity{0, 0, -kGravity};
  double size = 1;  // factor of the edges, not of the distances
};
// Largest errors; of forces from the tenth step on, when the contacts carry the load.
StackErrors run_stack(const Stack& stack) {
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
  StackErrors result;
  for (long n = 0; n < std::lround(duration / kStep); ++n) {
    scene.step(kStep);
    for (int i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vector3 moved = scene.p(i + 1) - places[k];
      result.displacement = std::max(result.displacement, std::hypot(moved.x(), moved.y()));
      result.settlement = std::max(result.settlement, std::abs(moved.z()));
      if (n >= 10)
        result.force = std::max(result.force, relative(force_under(scene, i + 1), load[k]));
    }
  }
  return scene.ok() ? result : StackErrors{NAN, NAN, NAN};
}
const std::vector<double> kTen(10, 1.0);
StackErrors ten_boxes() {  // 10 s; run once, and again for a recorder
  if (contact_recorder) return run_stack({kTen, 10});
  static const StackErrors result = run_stack({kTen, 10});
  return result;
}

CaseResult forces(double scale) {  // gravity
  if (scale == 1) return {ten_boxes().force};
  return {run_stack({kTen, 0.1, {0, 0, -kGravity * scale}}).force};
}
CaseResult sliding_boxes(double scale) {  // mutant: gravity is inclined beyond the friction angle
  if (scale == 1) return {ten_boxes().displacement};
  return {run_stack({kTen, 0.1, kGravity * Vector3(scale - 1, 0, -1)}).displacement};
}
CaseResult sinking(double scale) {  // edges
  if (scale == 1) return {ten_boxes().settlement};
  return {run_stack({kTen, 0.1, {0, 0, -kGravity}, scale}).settlement};
}
CaseResult heavy_on_light(double scale) {  // gravity
  return {run_stack({{1, 100}, 2, {0, 0, -kGravity * scale}}).force};
}

// ---- plots ----

template <int... boxes>
Values read_loads(Scene s) {
  return {(s.t() == 0 ? NAN : force_under(s, boxes))...};
}

}  // namespace

CaseFamily stacks_cases() {
  const auto exact_ten = [](std::size_t k, double) {
    constexpr double kBoxes[] = {10, 6, 1};
    return kGravity * kBoxes[k];
  };
  const auto exact_heavy = [](std::size_t k, double) { return kGravity * (k == 0 ? 101 : 100); };
  const Plot resting = Plot{}.with(&Plot::until, 1).without_convergence(kResting);
  const Plot top = resting.with(&Plot::exact, zero).with(&Plot::from_start, true);
  return {270,
          {contact_case<forces, 1>("E11-forces", 1e-6,
                                   Plot{{"under box 1 [N]", "under box 5 [N]", "under box 10 [N]"},
                                        read_loads<1, 5, 10>,
                                        exact_ten}
                                       .with(&Plot::until, 1)
                                       .without_convergence(kResting)),
           contact_case<sliding_boxes, 600>(
               "E11-drift", 1e-5,
               top.with(&Plot::readings, {"x of the top box [m]"}).with(&Plot::read, place<10, 0>)),
           contact_case<sinking, -1>(
               "E11-sinking", 1e-4,
               top.with(&Plot::readings, {"z of the top box [m]"}).with(&Plot::read, place<10, 2>)),
           contact_case<heavy_on_light, 1>(
               "E11-heavy", 1e-6,
               Plot{{"under 1 kg [N]", "under 100 kg [N]"}, read_loads<1, 2>, exact_heavy}
                   .without_convergence(kResting))}};
}

}  // namespace twinarm
