#include "collision/contact/contact_bodies.h"

#include <cmath>

#include "solver/support/diagnostics.h"

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
  const auto check = [&](bool good, const char* what, const char* fix) {
    if (!good) faults.add(where, what, fix, "contact.geometry");
  };
  check(geometry.body >= 0 && geometry.body < model_->body_count(), "it hangs on no body",
        "name a body of the model, or the world");
  check(s.friction >= 0 && std::isfinite(s.friction), "friction is negative or not a number",
        "give 0 or more");
  check(s.restitution >= 0 && s.restitution <= 1, "restitution is not within 0 and 1",
        "give 0 (no bounce) to 1 (all of the speed)");
  check(s.torsional >= 0 && s.rolling >= 0, "torsional or rolling friction is negative",
        "give a length of 0 m or more");
  check(s.stiffness > 0 && std::isfinite(s.stiffness), "stiffness is not a positive number",
        "give it in N/m, above 0");
  check(s.dissipation >= 0 && std::isfinite(s.dissipation),
        "dissipation is negative or not a number", "give it in s/m, 0 or more");
  faults.check();
  const int id = world_.add({geometry.name, geometry.shape, geometry.group, geometry.body == 0});
  geometries_.push_back(geometry);
  const bool bounded = !std::holds_alternative<HalfSpace>(geometry.shape);
  radius_.push_back(bounded ? geometry.X_LG.p.norm() + half_diagonal(geometry.shape) : 0);
  for (int other = 0; other < id; ++other)
    if (this->geometry(other).body == geometry.body) world_.disable_pair(other, id);
  return id;
}

void ContactBodies::set_pair(int a, int b, const ContactMaterialPair& law) {
  rules_.push_back({std::min(a, b), std::max(a, b), law});
}

ContactMaterialPair ContactBodies::law_of(int id_a, int id_b) const {
  const ContactSurface &a = geometry(id_a).surface, &b = geometry(id_b).surface;
  ContactMaterialPair law{std::sqrt(a.friction * b.friction), a.restitution * b.restitution,
                          in_series({a.stiffness, a.dissipation}, {b.stiffness, b.dissipation})};
  for (const PairOverride& problem : rules_)
    if (problem.a == id_a && problem.b == id_b) law = problem.law;
  return law;
}

double ContactBodies::way(std::size_t geometry, const Kinematics& k, double h) const {
  const auto body = static_cast<std::size_t>(geometries_[geometry].body);
  return h * (k.v_WLo[body].norm() + k.w_WL[body].norm() * radius_[geometry]);
}

Vector3 ContactBodies::point_on(const Contact& c, int body) const {
  const int a = geometry(c.a).body, b = geometry(c.b).body;
  const double gap = locates ? -c.depth : std::max(0.0, -c.depth);
  if (body == b && is_immovable(a)) return c.p_WC + 0.5 * gap * c.n_W;
  if (body == a && is_immovable(b)) return c.p_WC - 0.5 * gap * c.n_W;
  return c.p_WC;
}

Vector3 ContactBodies::approach(const Contact& c, const Kinematics& k) const {
  const int a = geometry(c.a).body, b = geometry(c.b).body;
  return k.velocity(b, point_on(c, b)) - k.velocity(a, point_on(c, a));
}

Vector3 ContactBodies::moment_of(const Contact& c, const Vector3& impulse_W) const {
  const int a = geometry(c.a).body, b = geometry(c.b).body;
  return point_on(c, is_immovable(b) ? a : b).cross(impulse_W);
}

}  // namespace twinarm
