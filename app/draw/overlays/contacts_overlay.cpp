// Contact points that press: a dot, the normal of the contact, the cone in which friction can hold.
#include <algorithm>
#include <cmath>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

// The tip at the point, open along the normal: the force on b stays inside of it.
void draw_cone(SceneView& stage, const ShownContact& contact, double height) {
  if (!(contact.friction > 0)) return;
  const double radius = contact.friction * height;
  add_mesh_instance(stage.list, stage.list.unit_mesh(UnitShape::cone),
                    {rotation_taking_z_to(-contact.n_W), contact.p_W + height * contact.n_W},
                    palette::kCone, Vector3(radius, radius, height));
}

void show_contacts(SceneView& stage, const Snapshot& moment) {
  // Many are drawn smaller: dots so that as much of the picture is covered as by twenty, cones so
  // that rows of them stay apart.
  const double crowd = std::max(1.0, static_cast<double>(moment.contacts.size()) / 20);
  const double radius = 0.7 * std::pow(crowd, -0.5) * stage.scales.radius();
  const double height = 0.09 * std::pow(crowd, -0.65) * stage.scales.length;
  bool any_cone = false;
  for (const ShownContact& contact : moment.contacts) {
    const OfBody mark(stage.list, contact.body_b);
    add_sphere(stage.list, contact.p_W, 1.5 * radius, palette::kPoint);
    add_arrow(stage.list, contact.p_W, contact.p_W + 1.35 * height * contact.n_W, 0.6 * radius,
              palette::kNormal);
    draw_cone(stage, contact, height);
    any_cone = any_cone || contact.friction > 0;
  }
  if (moment.contacts.empty()) return;
  stage.list.legend.push_back({palette::kNormal, "contact point and its normal"});
  if (any_cone)
    stage.list.legend.push_back({palette::kConeSwatch, "friction cone: the force stays inside"});
}

}  // namespace

Overlays contacts_overlay() {
  return {{.place = 50,
           .name = "contacts",
           .what = "points, normals, friction cones",
           .add = show_contacts,
           .seen_through = false,
           .shown = Overlay::Shown::on_pages}};
}

}  // namespace twinarm
