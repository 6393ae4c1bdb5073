#include "collision/contact/contact_bodies.h"

#include <cmath>

#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

double half_diagonal(const Shape& shape) {
  Vector3 extent;
  for (int axis = 0; axis < 3; ++axis)
    extent[axis] = std::max(support(shape, Vector3::Unit(axis))[axis],
                            -support(shape, -Vector3::Unit(axis))[axis]);
  return extent.norm();
}

}  // namespace

ContactBodies::ContactBodies(const Model<double>& model) : model_(&model) {
  is_immovable_.assign(model.parent.size(), 1);
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    is_immovable_[i] = is_immovable(model.parent[i]) && model.dofs(i) == 0;
}

int ContactBodies::add(const ContactGeometry& geometry) {
  const ContactSurface& s = geometry.surface;
  DiagnosticList faults;
  const std::string where = "geometry '" + geometry.name + "'";
  const auto check = [&](bool good, const std::string& what, const std::string& fix) {
    if (!good) faults.add(where, what, fix, "contact.geometry");
  };
  check(geometry.body >= 0 && geometry.body < model_->body_count(),
        "body index " + std::to_string(geometry.body) + " does not exist",
        "give an index from 0 (world) to " + std::to_string(model_->body_count() - 1));
  check(s.friction >= 0 && std::isfinite(s.friction),
        "friction is " + short_number_text(s.friction) + ", must be a finite number >= 0",
        "give 0 or more");
  check(s.restitution >= 0 && s.restitution <= 1,
        "restitution is " + short_number_text(s.restitution) + ", must be from 0 to 1",
        "give 0 (inelastic) to 1 (elastic)");
  check(s.torsional_friction >= 0 && s.rolling_friction >= 0,
        "torsional or rolling friction is negative", "give a length of 0 m or more");
  check(s.stiffness > 0 && std::isfinite(s.stiffness),
        "stiffness is " + short_number_text(s.stiffness) + " N/m, must be positive and finite",
        "give a stiffness above 0 N/m");
  check(s.dissipation >= 0 && std::isfinite(s.dissipation),
        "dissipation is " + short_number_text(s.dissipation) + " s/m, must be a finite number >= 0",
        "give 0 s/m or more");
  faults.check();
  const int id = world_.add({geometry.name, geometry.shape, geometry.group, geometry.body});
  geometries_.push_back(geometry);
  const bool bounded = !std::holds_alternative<HalfSpace>(geometry.shape);
  radius_.push_back(bounded ? geometry.X_LG.p.norm() + half_diagonal(geometry.shape) : 0);
  return id;
}

Vector3 ContactBodies::application_point(const Contact& c, int body) const {
  const int a = geometry(c.a).body, b = geometry(c.b).body;
  const double gap = locates_events ? -c.depth : std::max(0.0, -c.depth);
  if (body == b && is_immovable(a)) return c.p_WC + 0.5 * gap * c.n_W;
  if (body == a && is_immovable(b)) return c.p_WC - 0.5 * gap * c.n_W;
  return c.p_WC;
}

}  // namespace twinarm
