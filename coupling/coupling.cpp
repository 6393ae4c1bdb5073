#include "coupling/coupling.h"

#include <Eigen/Geometry>
#include <utility>

#include "solver/fault.h"

namespace twinarm {

Coupling::Coupling(std::string name, const Model<double>& model, KinematicRobot& kvr,
                   std::vector<Spring> springs)
    : name_(std::move(name)),
      model_(model),
      kvr_(kvr),
      springs_(std::move(springs)),
      readings_(springs_.size()) {
  FaultList faults;
  for (const Spring& spring : springs_) {
    const std::string where = "coupling '" + name_ + "', spring '" + spring.name + "'";
    if (spring.body <= 0 || spring.body >= model.body_count())
      faults.add({"", 0, where, "it names no moving link", "name a link of the robot"});
    if (!(spring.k >= 0))
      faults.add({"", 0, where,
                  "stiffness is " + std::to_string(spring.k) + ", must not be negative",
                  "give a stiffness of at least 0"});
    if (!(spring.b >= 0))
      faults.add({"", 0, where, "damping is " + std::to_string(spring.b) + ", must not be negative",
                  "give a damping of at least 0"});
  }
  faults.check();
}

void Coupling::visit_memory(Memory& memory) {
  for (SpringReading& reading : readings_) {
    for (Vector3* v : {&reading.p_K, &reading.p_D, &reading.pull}) memory.visit(*v);
    memory.visit(reading.size);
  }
}

Vector3 rotation_vector(const Matrix3& R) {
  const Eigen::Quaterniond quaternion(R);
  const double sign = quaternion.w() < 0 ? -1.0 : 1.0;  // the shorter way round
  const double s = quaternion.vec().norm();
  if (s < 1e-12) return 2 * sign * quaternion.vec();  // sin(x) = x to rounding
  return 2 * std::atan2(s, sign * quaternion.w()) / s * sign * quaternion.vec();
}

}  // namespace twinarm
