// What several of the smooth cases are made of.
#pragma once

#include <Eigen/Geometry>

#include "benchmarks/analytic/trajectory_case.h"
#include "solver/model_builder.h"

namespace twinarm::smooth_parts {

// One free body of these principal moments about its centre, without gravity [kg m^2].
Model<double> free_body(double mass, const Vector3& moments);

// Attitude and rate of a free body that is the first of its model, without the signs that a
// quaternion leaves open: w, x, y, z, and the angular velocity in body axes.
CaseReadings attitude_and_rate(const Eigen::Quaterniond& attitude, const Vector3& rate);
CaseReadings observe_attitude_and_rate(const Model<double>&, const State<double>& x);
// The larger of the angle between the attitudes and the length of the difference of the rates.
double attitude_and_rate_error(const CaseReadings& seen, const CaseReadings& exact);

}  // namespace twinarm::smooth_parts
