// Contact forces: resultant of each pair of bodies at its centre of pressure, torques of torsional
// and rolling friction; weights; contact points with normal and friction cone.

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

constexpr std::size_t kMaxLabels = 14;
constexpr double kMinForce = 0.004;  // of the largest

// The smallest of the `count` largest forces.
double min_of_largest(const std::vector<PairForce>& pairs, std::size_t count) {
  std::vector<double> sizes;
  for (const PairForce& pair : pairs) sizes.push_back(pair.force.norm());
  std::ranges::sort(sizes, std::greater<>());
  return sizes.empty() ? 0 : sizes[std::min(count, sizes.size()) - 1];
}

void show_forces(SceneView& view, const Snapshot& snapshot) {
  const std::vector<PairForce> pairs = pair_forces(snapshot);
  if (pairs.empty()) return;
  const double scale = view.scales.metres_per(view.scales.contact_force);
  const double radius = view.scales.radius();
  const double min_labelled = min_of_largest(pairs, kMaxLabels);
  for (const PairForce& pair : pairs) {
    const double size = pair.force.norm();
    if (!(size > kMinForce * view.scales.contact_force)) continue;
    const Vector3 tip = pair.point + scale * pair.force;
    const OfBody mark(view.list, pair.body_b);
    add_arrow(view.list, pair.point, tip, radius, palette::kForce);
    if (size >= min_labelled) add_label(view.list, pair.point, with_unit(size, "N"), {30, -6});
    if (pair.couple.norm() > 0)
      add_rotation_arrow(view.list, pair.point, pair.couple, 0.1 * view.scales.length, 0.7 * radius,
                         palette::kForce);
  }
  view.list.legend.push_back(
      {palette::kForce, "contact force", scale_words(scale, view.scales.length, "N")});
}

void show_gravity(SceneView& view, const Snapshot& snapshot) {
  const Vector3 g = to_eigen(view.model->gravity);
  double heaviest = 0;
  for (const auto& I : view.model->I) heaviest = std::max(heaviest, I.m * g.norm());
  const double scale = view.scales.metres_per(std::max(heaviest, view.scales.contact_force));
  for (std::size_t i = 1; i < view.model->parent.size(); ++i) {
    const double m = view.model->I[i].m;
    if (!(m * g.norm() > 0)) continue;
    const Vector3 c = com_of(*view.model, snapshot.k, i);
    const OfBody mark(view.list, i);
    add_arrow(view.list, c, c + scale * m * g, view.scales.radius(), palette::kGravity);
  }
  view.list.legend.push_back(
      {palette::kGravity, "weight", scale_words(scale, view.scales.length, "N")});
}

// Tip at the contact point, axis along the normal.
void draw_cone(SceneView& view, const ShownContact& contact, double height) {
  if (!(contact.friction > 0)) return;
  const double radius = contact.friction * height;
  add_mesh_instance(view.list, view.list.unit_mesh(UnitShape::cone),
                    {rotation_taking_z_to(-contact.n_W), contact.p_W + height * contact.n_W},
                    palette::kCone, Vector3(radius, radius, height));
}

void show_contacts(SceneView& view, const Snapshot& snapshot) {
  // Smaller if there are many: dots cover the area of twenty, cones do not overlap.
  const double crowd = std::max(1.0, static_cast<double>(snapshot.contacts.size()) / 20);
  const double radius = 0.7 * std::pow(crowd, -0.5) * view.scales.radius();
  const double height = 0.09 * std::pow(crowd, -0.65) * view.scales.length;
  bool any_cone = false;
  for (const ShownContact& contact : snapshot.contacts) {
    const OfBody mark(view.list, contact.body_b);
    add_sphere(view.list, contact.p_W, 1.5 * radius, palette::kPoint);
    add_arrow(view.list, contact.p_W, contact.p_W + 1.35 * height * contact.n_W, 0.6 * radius,
              palette::kNormal);
    draw_cone(view, contact, height);
    any_cone = any_cone || contact.friction > 0;
  }
  if (snapshot.contacts.empty()) return;
  view.list.legend.push_back({palette::kNormal, "contact point and its normal"});
  if (any_cone)
    view.list.legend.push_back({palette::kConeSwatch, "friction cone: the force stays inside"});
}

}  // namespace

Overlays forces_overlay() {
  return {{60, "forces", "contact forces by pair of bodies, with values", show_forces},
          {70, "gravity", "weights", show_gravity},
          {50,
           "contacts",
           "contact points, normals, friction cones",
           show_contacts,
           {.seen_through = false, .shown = Overlay::Shown::on_pages}}};
}

}  // namespace twinarm
