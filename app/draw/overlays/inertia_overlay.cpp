// Inertia ellipsoids, centres of mass, total momentum.
//
// inertia      uniform solid ellipsoid with the body's mass and moments about its centre of mass:
//              I1 = m (b^2 + c^2) / 5, ..., so a^2 = 5 (I2 + I3 - I1) / (2 m).
// articulated  M, the lower right block of the articulated-body inertia I^A at the link's origin
//              (RBDA section 7.1): force M a for a link that does not rotate. Semi-axes are
//              proportional to the principal values of M: small along free joints of descendants,
//              equal for a rigid body alone.

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"
#include "app/inspect/inspection.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

struct Principal {
  Vector3 values;
  Matrix3 axes;  // right-handed
};

Principal principal(const Matrix3& A) {
  const SymmetricEigensystem system =
      generalized_eigensystem(0.5 * (A + A.transpose()), Matrix3::Identity());
  Principal found{system.values, system.vectors};
  found.axes.col(2) = found.axes.col(0).cross(found.axes.col(1));
  return found;
}

void draw_ellipsoid(SceneView& view, std::size_t body, const Vector3& center,
                    const Principal& shape, const Vector3& semi_axes, const Color& color) {
  const OfBody mark(view.list, body);
  add_mesh_instance(view.list, view.list.unit_mesh(UnitShape::sphere), {shape.axes, center}, color,
                    semi_axes.cwiseMax(0.004 * view.scales.length));
}

void show_inertia(SceneView& view, const Snapshot& snapshot) {
  const Model<double>& model = *view.model;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const double m = model.I[i].m;
    if (!(m > 0)) continue;
    const Principal I = principal(inertia_of(model, snapshot.k, i));
    const double sum = I.values.sum();
    Vector3 semi;
    for (int c = 0; c < 3; ++c)
      semi[c] = std::sqrt(std::max(0.0, 2.5 * (sum - 2 * I.values[c]) / m));
    draw_ellipsoid(view, i, com_of(model, snapshot.k, i), I, semi, palette::kInertia);
  }
  view.list.legend.push_back(
      {palette::kInertiaSwatch, "inertia: the uniform ellipsoid with the body's mass and moments"});
}

void show_articulated(SceneView& view, const Snapshot& snapshot) {
  const Model<double>& model = *view.model;
  const Inspection in(model, snapshot.x, {});
  std::vector<Principal> all(model.parent.size());
  double largest = 0;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const Matrix3 M_L = LinkAxes(in, i).show(in.w.IA[i]).bottomRightCorner<3, 3>();
    const Matrix3& R_WL = snapshot.k.X_WL[i].R;
    all[i] = principal(R_WL * M_L * R_WL.transpose());
    largest = std::max(largest, all[i].values.maxCoeff());
  }
  const double scale = largest > 0 ? round_down(0.3 * view.scales.length / largest) : 0;
  if (!(scale > 0)) return;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.joint[i] == JointType::free || !all[i].values.allFinite()) continue;
    if (!(all[i].values.maxCoeff() > 0)) continue;
    draw_ellipsoid(view, i, snapshot.k.X_WL[i].p, all[i], scale * all[i].values,
                   palette::kArticulated);
  }
  view.list.legend.push_back({palette::kArticulatedSwatch, "apparent mass of links: semi-axes",
                              scale_words(scale, view.scales.length, "kg")});
}

const Color kDark{0.10f, 0.10f, 0.12f, 1.0f}, kWhole{0.95f, 0.85f, 0.20f, 1.0f};

void show_com(SceneView& view, const Snapshot& snapshot) {
  const double radius = 1.6 * view.scales.radius();
  for (std::size_t i = 1; i < view.model->parent.size(); ++i)
    if (view.model->I[i].m > 0) {
      const OfBody mark(view.list, i);
      add_sphere(view.list, com_of(*view.model, snapshot.k, i), radius, kDark);
    }
  const TotalMotion total = total_motion(*view.model, snapshot.k);
  if (!(total.mass > 0)) return;
  add_sphere(view.list, total.com_W, 1.8 * radius, kWhole);
  add_label(view.list, total.com_W, with_unit(total.mass, "kg"), {22, -22});
  view.list.legend.push_back({kDark, "centre of mass of a body"});
  view.list.legend.push_back({kWhole, "centre of mass of the whole"});
}

void show_momentum(SceneView& view, const Snapshot& snapshot) {
  const TotalMotion total = total_motion(*view.model, snapshot.k);
  const double scale = view.scales.metres_per(view.scales.momentum);
  const double radius = 1.4 * view.scales.radius();
  const double size = total.linear.norm(), spin = total.angular.norm();
  // Rounding errors of a body at rest.
  const double smallest = 1e-9 * total.mass * view.scales.length;
  if (size > smallest) {
    const Vector3 tip = total.com_W + scale * total.linear;
    add_arrow(view.list, total.com_W, tip, radius, palette::kLinear);
    add_label(view.list, tip, with_unit(size, "kg m/s"), {14, -6});
  }
  view.list.legend.push_back({palette::kLinear, "momentum",
                              view.scales.momentum > smallest
                                  ? scale_words(scale, view.scales.length, "kg m/s")
                                  : ": none"});
  if (spin > smallest * view.scales.length) {
    add_rotation_arrow(view.list, total.com_W, total.angular, 0.25 * view.scales.length, radius,
                       palette::kAngular);
    add_label(view.list, total.com_W, with_unit(spin, "kg m\u00b2/s"), {30, 36});
  }
  view.list.legend.push_back({palette::kAngular, "angular momentum about the centre of mass"});
}

}  // namespace

Overlays inertia_overlay() {
  return {
      {120, "inertia", "inertia ellipsoids of bodies", show_inertia},
      {130, "articulated", "articulated-body inertia: apparent mass of links", show_articulated},
      {100, "com", "centres of mass", show_com},
      {110, "momentum", "total linear and angular momentum", show_momentum}};
}

}  // namespace twinarm
