#include "app/inspect/report/dynamics_output.h"
#include "app/robot/robot_json.h"

namespace twinarm {

std::string dynamics_json(const RobotInput& input, const Dynamics& d) {
  const Coordinates& coordinates = input.coordinates;
  Kinematics k(input.model);
  forward_kinematics(input.model, input.state.x, k);
  const bool floats = coordinates.floating();
  const Vector3 still = Vector3::Zero();

  return json_text([&](JsonWriter& json) {
    json.put("joints", coordinates.names());
    write_by_joint(json.key("qdd"), coordinates, d.qdd);
    json.key("base_acceleration")
        .object({{"linear", floats ? Vector3(d.qdd.head<3>()) : still},
                 {"angular", floats ? Vector3(d.qdd.segment<3>(3)) : still}});
    write_by_joint(json.key("tau_inverse"), coordinates, d.tau_inverse);
    json.key("base_wrench").object({{"force", d.base_force}, {"torque", d.base_torque}});
    json.members({{"mass_matrix", d.mass_matrix},
                  {"bias", d.bias},
                  {"gravity", d.gravity},
                  {"kinetic_energy", d.kinetic_energy},
                  {"potential_energy", d.potential_energy},
                  {"mass", d.mass},
                  {"com", d.com},
                  {"linear_momentum", d.linear_momentum},
                  {"angular_momentum", d.angular_momentum}});
    write_links(json.key("links"), input.model, k);
    json.put("warnings", input.warnings);
  });
}

}  // namespace twinarm
