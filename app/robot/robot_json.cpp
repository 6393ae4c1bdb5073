#include "app/robot/robot_json.h"

namespace twinarm {
namespace {

template <class Values>
void write_each(JsonWriter& json, const Coordinates& coordinates, Values values) {
  json.begin_object();
  for (std::size_t j = coordinates.first_joint(); j < coordinates.all().size(); ++j) {
    const NamedJoint& joint = coordinates.all()[j];
    json.key(joint.name).number_or_list(values(joint));
  }
  json.end_object();
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
  json.begin_object();
  json.key("position").numbers({q[0], q[1], q[2]});
  json.key("orientation").numbers({q[3], q[4], q[5], q[6]});
  json.key("linear_velocity").numbers({qd[0], qd[1], qd[2]});
  json.key("angular_velocity").numbers({qd[3], qd[4], qd[5]});
  json.end_object();
}

void write_links(JsonWriter& json, const Model<double>& model, const Kinematics& k) {
  json.begin_object();
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    json.key(model.body_name[i])
        .object({{"position", k.X_WL[i].p},
                 {"orientation", quaternion_of(k.X_WL[i].R)},
                 {"rotation", k.X_WL[i].R},
                 {"linear_velocity", k.v_WLo[i]},
                 {"angular_velocity", k.w_WL[i]}});
  json.end_object();
}

Eigen::Vector4d quaternion_of(const Matrix3& R) {
  const Eigen::Quaterniond turn(R);
  const double sign = turn.w() < 0 ? -1 : 1;
  return sign * Eigen::Vector4d(turn.w(), turn.x(), turn.y(), turn.z());
}

}  // namespace twinarm
