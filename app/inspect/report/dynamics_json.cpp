#include "app/inspect/report/dynamics_output.h"
#include "app/robot/robot_json.h"

namespace twinarm {

std::string dynamics_json(const RobotInput& input, const Dynamics& d) {
  const Coordinates& coordinates = input.coordinates;
  Kinematics k(input.model);
  forward_kinematics(input.model, input.state.x, k);
  const bool floats = coordinates.floating();
  const Vector3 still = Vector3::Zero();

  JsonWriter json;
  json.begin_object();
  json.key("joints").texts(coordinates.names());
  write_by_joint(json.key("qdd"), coordinates, d.qdd);
  json.key("base_acceleration").begin_object();
  json.key("linear").vector(floats ? Vector3(d.qdd.head<3>()) : still);
  json.key("angular").vector(floats ? Vector3(d.qdd.segment<3>(3)) : still);
  json.end_object();
  write_by_joint(json.key("tau_inverse"), coordinates, d.tau_inverse);
  json.key("base_wrench").begin_object();
  json.key("force").vector(d.base_force);
  json.key("torque").vector(d.base_torque);
  json.end_object();
  json.key("mass_matrix").matrix(d.mass_matrix);
  json.key("bias").vector(d.bias);
  json.key("gravity").vector(d.gravity);
  json.key("kinetic_energy").number(d.kinetic_energy);
  json.key("potential_energy").number(d.potential_energy);
  json.key("mass").number(d.mass);
  json.key("com").vector(d.com);
  json.key("linear_momentum").vector(d.linear_momentum);
  json.key("angular_momentum").vector(d.angular_momentum);
  write_links(json.key("links"), input.model, k);
  json.key("warnings").texts(input.warnings);
  json.end_object();
  return json.str();
}

}  // namespace twinarm
