#include "benchmarks/analytic/smooth_parts.h"

#include <algorithm>

namespace twinarm::smooth_parts {

Model<double> free_body(double mass, const Vector3& moments) {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body("body", 0, "free", JointType::free, {}, Vector3::UnitZ(),
                   {mass, Vector3::Zero(), moments.asDiagonal()});
  return builder.build();
}

CaseReadings attitude_and_rate(const Eigen::Quaterniond& attitude, const Vector3& rate) {
  return {attitude.w(), attitude.x(), attitude.y(), attitude.z(), rate.x(), rate.y(), rate.z()};
}

CaseReadings observe_attitude_and_rate(const Model<double>&, const State<double>& x) {
  return {x.q[3], x.q[4], x.q[5], x.q[6], x.qd[0], x.qd[1], x.qd[2]};
}

double attitude_and_rate_error(const CaseReadings& seen, const CaseReadings& exact) {
  const auto attitude = [](const CaseReadings& r) {
    return Eigen::Quaterniond(r[0], r[1], r[2], r[3]);
  };
  const auto rate = [](const CaseReadings& r) { return Vector3(r[4], r[5], r[6]); };
  return std::max(attitude(seen).angularDistance(attitude(exact)),
                  (rate(seen) - rate(exact)).norm());
}

}  // namespace twinarm::smooth_parts
