// Inertias as ellipsoids.
//
// inertia      the uniform solid ellipsoid of the body's own mass and moments about its centre of
//              mass: I1 = m (b^2 + c^2) / 5 .., so a^2 = 5 (I2 + I3 - I1) / (2 m).
// articulated  M, the lower right block of the articulated-body inertia I^A at the link's origin
//              (RBDA section 7.1): the force that accelerates that point is M a where the link does
//              not turn. What hangs on the link yields along free joints, so the ellipsoid is flat
//              there; the axes are in proportion to the principal values of M, the largest of all
//              bodies being a quarter of the scene. A rigid body alone is a ball: its mass.
#include <algorithm>
#include <cmath>
#include <vector>

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

// A body without extent along an axis is still to be seen.
void draw_ellipsoid(SceneView& stage, std::size_t body, const Vector3& center,
                    const Principal& shape, const Vector3& semi_axes, const Color& color) {
  const OfBody mark(stage.list, body);
  add_mesh_instance(stage.list, stage.list.unit_mesh(UnitShape::sphere), {shape.axes, center},
                    color, semi_axes.cwiseMax(0.004 * stage.scales.length));
}

void show_inertia(SceneView& stage, const Snapshot& moment) {
  const Model<double>& model = *stage.model;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const double m = model.I[i].m;
    if (!(m > 0)) continue;
    const Principal I = principal(inertia_of(model, moment.k, i));
    const double sum = I.values.sum();
    Vector3 semi;
    for (int c = 0; c < 3; ++c)
      semi[c] = std::sqrt(std::max(0.0, 2.5 * (sum - 2 * I.values[c]) / m));
    draw_ellipsoid(stage, i, com_of(model, moment.k, i), I, semi, palette::kInertia);
  }
  stage.list.legend.push_back(
      {palette::kInertiaSwatch, "inertia: the uniform ellipsoid with the body's mass and moments"});
}

void show_articulated(SceneView& stage, const Snapshot& moment) {
  const Model<double>& model = *stage.model;
  const Inspection in(model, moment.x, {});
  std::vector<Principal> all(model.parent.size());
  double largest = 0;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const Matrix3 M_L = LinkAxes(in, i).show(in.w.IA[i]).bottomRightCorner<3, 3>();
    const Matrix3& R_WL = moment.k.X_WL[i].R;
    all[i] = principal(R_WL * M_L * R_WL.transpose());
    largest = std::max(largest, all[i].values.maxCoeff());
  }
  const double scale = largest > 0 ? round_down(0.3 * stage.scales.length / largest) : 0;
  if (!(scale > 0)) return;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.joint[i] == JointType::free || !all[i].values.allFinite()) continue;
    if (!(all[i].values.maxCoeff() > 0)) continue;
    draw_ellipsoid(stage, i, moment.k.X_WL[i].p, all[i], scale * all[i].values,
                   palette::kArticulated);
  }
  stage.list.legend.push_back({palette::kArticulatedSwatch, "apparent mass of links: semi-axes",
                               scale_words(scale, stage.scales.length, "kg")});
}

}  // namespace

Overlays inertia_overlay() {
  return {{.place = 120,
           .name = "inertia",
           .what = "of each body, as an ellipsoid",
           .add = show_inertia},
          {.place = 130,
           .name = "articulated",
           .what = "apparent mass of each body with what hangs on it",
           .add = show_articulated}};
}

}  // namespace twinarm
