#include "app/coupling/gain_equivalents.h"

#include "app/coupling/posed_couplings.h"

namespace twinarm {

Equivalents equivalents_of(const SpringGains& gains, double inertia,
                           const MujocoImpedance& impedance) {
  Equivalents found;
  found.inertia = inertia;
  found.gains = gains;
  found.response = response_of(gains, inertia);
  if (gains.k > 0 && gains.b > 0) found.solref = solref_of(gains, inertia, impedance);
  if (gains.k > 0) found.direct = direct_solref_of(gains, inertia, impedance);
  found.static_stiffness = mujoco_static_stiffness(gains.k, impedance);
  found.force_drive = drive_of(gains, inertia, Drive::Mode::force);
  found.acceleration_drive = drive_of(gains, inertia, Drive::Mode::acceleration);
  return found;
}

std::vector<Equivalents> scene_equivalents(SimulateInput& input,
                                           const std::optional<SpringResponse>& wanted,
                                           const MujocoImpedance& impedance) {
  PosedCouplings posed(input);
  std::vector<Equivalents> all;
  for (std::size_t c = 0; c < input.couplings->size(); ++c) {
    const PredictedCoupling coupling = posed.coupling(c, 1e-3);
    const SceneCoupling& spec = input.couplings->spec(c);
    if (!(coupling.gains.k > 0)) continue;  // no spring: a god object, a damper, half of a weld
    // A weld has an inertia of its own: the spring that swings as it does is softer.
    const double inertia = posed.felt_inertia(c), d = spec.reference.impedance;
    const double part = inertia / (inertia + coupling.felt_mass);
    Equivalents found = equivalents_of({part * coupling.gains.k, part * coupling.gains.b}, inertia,
                                       coupling.felt_mass > 0 ? MujocoImpedance{d, d} : impedance);
    found.is_weld = coupling.felt_mass > 0;
    found.name = coupling.name;
    found.kind = coupling.kind;
    found.is_length = coupling.is_length;
    if (wanted) found.wanted = gains_of(*wanted, found.inertia);
    const auto body = static_cast<std::size_t>(spec.spring.body);
    for (const SpringArm& arm : coupling.arms)
      if (arm.joint == input.robot.model.joint_name[body]) {
        found.radius = arm.radius;
        found.as_torsional = torsional_of_linear(coupling.gains, arm.radius);
      }
    all.push_back(std::move(found));
  }
  return all;
}

}  // namespace twinarm
