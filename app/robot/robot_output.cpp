#include "app/robot/robot_output.h"

namespace twinarm {
namespace {

template <class Values>
void write_each(JsonWriter& json, const Coordinates& coordinates, Values values) {
  json.object([&] {
    for (std::size_t j = coordinates.first_joint(); j < coordinates.all().size(); ++j)
      json.key(coordinates.all()[j].name).number_or_list(values(coordinates.all()[j]));
  });
}

}  // namespace

void write_by_joint(JsonWriter& json, const Coordinates& coordinates, const Eigen::VectorXd& rows) {
  write_each(json, coordinates, [&](const NamedJoint& joint) {
    const double* first = rows.data() + joint.row;
    return std::vector<double>(first, first + joint.nv);
  });
}

void write_coordinates(JsonWriter& json, const Coordinates& coordinates, const State<double>& x) {
  write_each(json, coordinates, [&](const NamedJoint& j) { return coordinates_of(j, x); });
}

void write_velocities(JsonWriter& json, const Coordinates& coordinates, const State<double>& x) {
  write_each(json, coordinates, [&](const NamedJoint& j) { return from_solver(j, x, x.qd); });
}

void write_base(JsonWriter& json, const Coordinates& coordinates, const State<double>& x) {
  const std::vector<double> q = coordinates_of(coordinates.base(), x);
  const std::vector<double> qd = from_solver(coordinates.base(), x, x.qd);
  json.object({{"position", std::span(q).first(3)},
               {"orientation", std::span(q).subspan(3, 4)},
               {"linear_velocity", std::span(qd).first(3)},
               {"angular_velocity", std::span(qd).subspan(3, 3)}});
}

void write_links(JsonWriter& json, const Model<double>& model, const Kinematics& k) {
  json.object([&] {
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      json.key(model.body_name[i])
          .object({{"position", k.X_WL[i].p},
                   {"orientation", quaternion_of(k.X_WL[i].R)},
                   {"rotation", k.X_WL[i].R},
                   {"linear_velocity", k.v_WLo[i]},
                   {"angular_velocity", k.w_WL[i]}});
  });
}

Eigen::Vector4d quaternion_of(const Matrix3& R) {
  const Eigen::Quaterniond q(R);
  const double sign = q.w() < 0 ? -1 : 1;
  return sign * Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
}

JointUnits::JointUnits(const Coordinates& coordinates) {
  bool angles = false, lengths = false;
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components()) (c.is_angle ? angles : lengths) = true;
  const auto both = [&](const char* of_angle, const char* of_length) {
    if (!lengths) return std::string(of_angle);
    if (!angles) return std::string(of_length);
    return std::string(of_angle) + ", " + of_length;
  };
  q = both("rad", "m");
  qd = both("rad/s", "m/s");
  qdd = both("rad/s^2", "m/s^2");
  tau = both("N m", "N");
}

std::string component_name(const Coordinates& coordinates, const NamedJoint& joint,
                           const JointComponent& component) {
  const bool is_base = coordinates.floating() && &joint == &coordinates.base();
  const std::string name = is_base ? "base" : joint.name;
  return *component.label ? name + "/" + component.label : name;
}

std::vector<std::string> row_names(const Coordinates& coordinates) {
  std::vector<std::string> names;
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components())
      if (c.v >= 0) names.push_back(component_name(coordinates, joint, c));
  return names;
}

}  // namespace twinarm
