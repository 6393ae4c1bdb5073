// Hunt-Crossley contact of the study alone; scenes: contact_constraints.h.
#include "collision/contact/contact_force.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "solver/forces/spring.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr int kObstacleGroup = 0, kLinkGroup = 1;
constexpr std::size_t kMaxContacts = 256;  // reserved: a step does not allocate
constexpr double kMinForceMargin = 1e-3;   // of speculative contacts [m]

}  // namespace

ContactForce::ContactForce(const Model<double>& model, const ContactLaw& law)
    : model_(model), law_(law) {
  world_.set_group_filter(kObstacleGroup, kObstacleGroup, false);
  world_.set_group_filter(kLinkGroup, kLinkGroup, false);
  contacts_.reserve(kMaxContacts);
  readings_.reserve(kMaxContacts);
  last_readings_.reserve(kMaxContacts);
  points_.reserve(kMaxContacts);
}

void ContactForce::add(int body, const Pose& X_LG, const std::string& name, const Shape& shape) {
  if (body < 0 || body >= model_.body_count())
    throw InputError({{"", 0, "geometry '" + name + "'",
                       "body index " + std::to_string(body) + " does not exist",
                       "give an index from 0 (world) to " + std::to_string(model_.body_count() - 1),
                       "contact.no-link"}});
  world_.add({name, shape, body == 0 ? kObstacleGroup : kLinkGroup});
  pieces_.push_back({body, X_LG});
  X_WG_.push_back(X_LG);
}

void ContactForce::find_contacts(const Kinematics& k, double margin) {
  for (std::size_t g = 0; g < pieces_.size(); ++g)
    X_WG_[g] = k.X_WL[static_cast<std::size_t>(pieces_[g].body)] * pieces_[g].X_LG;
  world_.detect(X_WG_, margin, contacts_);
}

double ContactForce::deepest(const Kinematics& k) {
  find_contacts(k, 0);
  double depth = 0;
  for (const Contact& contact : contacts_) depth = std::max(depth, contact.depth);
  return depth;
}

double ContactForce::last_normal_force(const Contact& contact) const {
  const auto key = [](const Contact& c) { return std::tuple(c.a, c.b, c.feature); };
  const auto found = std::lower_bound(
      last_readings_.begin(), last_readings_.end(), contact,
      [&](const ContactReading& r, const Contact& c) { return key(r.contact) < key(c); });
  const bool same = found != last_readings_.end() && key(found->contact) == key(contact);
  return same ? found->normal_force : 0.0;
}

void ContactForce::begin_step(const Kinematics& k, double /*t*/, double h) noexcept {
  h_ = h;
  double max_speed = 0;  // estimate for the points of a link: |v| + |w| 1 m
  for (std::size_t i = 1; i < k.v_WLo.size(); ++i)
    max_speed = std::max(max_speed, k.v_WLo[i].norm() + k.w_WL[i].norm());
  find_contacts(k, std::max(kMinForceMargin, 2 * h * max_speed));

  std::swap(readings_, last_readings_);
  readings_.clear();
  points_.clear();
  for (const Contact& contact : contacts_) {
    const int body_a = pieces_[static_cast<std::size_t>(contact.a)].body;
    const int body_b = pieces_[static_cast<std::size_t>(contact.b)].body;
    ContactReading reading;
    reading.contact = contact;
    reading.body = body_b > 0 ? body_b : body_a;
    reading.normal_W = body_b > 0 ? contact.n_W : Vector3(-contact.n_W);
    reading.p_W = contact.p_WC;
    Point point;
    point.v_n = k.velocity(reading.body, reading.p_W);
    point.s_n = point.s0 = -point.v_n.dot(reading.normal_W);
    point.v_t0 = point.v_n + point.s_n * reading.normal_W;
    point.N_last = last_normal_force(contact);
    readings_.push_back(reading);
    points_.push_back(point);
  }
}

void ContactForce::add_forces(const State<double>&, const Kinematics& k,
                              Forces<double>& forces) noexcept {
  for (std::size_t c = 0; c < readings_.size(); ++c) {
    ContactReading& reading = readings_[c];
    const Point& point = points_[c];
    const double depth = reading.contact.depth + h_ * point.s0;
    const double damping = 1 + law_.dissipation * point.s0;
    reading.normal_force = 0;
    reading.friction_W.setZero();
    if (depth <= 0 || damping <= 0) continue;
    const double N0 = law_.k * depth * damping;
    const double slope = law_.k * (h_ * damping + depth * law_.dissipation);  // dN/ds
    const double N = N0 + slope * (point.s_n - point.s0);                     // at qdd = 0
    add_point_force(k, reading.body, reading.p_W, N * reading.normal_W, forces);
    add_particle_along(k, reading.body, reading.p_W, reading.normal_W, h_ * slope, forces);
    reading.normal_force = N0;

    const double factor =
        law_.friction * point.N_last / std::hypot(point.v_t0.norm(), law_.stiction_speed);
    const Matrix3 axes = contact_axes(reading.normal_W);
    for (const Vector3& t : {Vector3(axes.col(1)), Vector3(axes.col(2))}) {
      add_point_force(k, reading.body, reading.p_W, -factor * t.dot(point.v_n) * t, forces);
      add_particle_along(k, reading.body, reading.p_W, t, h_ * factor, forces);
    }
    reading.friction_W = -factor * point.v_t0;
  }
}

bool ContactForce::refine(const Kinematics& k, const Workspace<double>& w) noexcept {
  constexpr double kTolerance = 1e-7;  // [m/s], and relative
  bool again = false;
  for (std::size_t c = 0; c < readings_.size(); ++c) {
    const ContactReading& reading = readings_[c];
    Point& point = points_[c];
    const Vector3 v = point.v_n + h_ * point_acceleration_of_qdd(k, w, reading.body, reading.p_W);
    const double s = -v.dot(reading.normal_W);
    const Vector3 v_t = v + s * reading.normal_W;
    const bool touches = reading.contact.depth + h_ * std::max(s, point.s0) > 0;
    const double change = std::abs(s - point.s0) + (v_t - point.v_t0).norm();
    if (touches && change > kTolerance * (1 + v.norm())) again = true;
    point.s0 = s;
    point.v_t0 = v_t;
  }
  return again;
}

}  // namespace twinarm
