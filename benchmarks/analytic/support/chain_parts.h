// Plane chains of links, hanging on -z from the world's origin, that turn from -z towards x.
#pragma once

#include "benchmarks/analytic/support/equations_of_motion.h"
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm::smooth_parts {

struct ChainLink {
  double mass = 1, length = 1;
  double com = 0.5;      // from the link's joint [m]
  double inertia = 0;    // about the centre of mass [kg m^2]
  bool in_line = false;  // a rod: no inertia about itself
};
inline ChainLink rod_link(double mass, double length) {
  return {mass, length, length / 2, mass * length * length / 12, true};
}
inline ChainLink point_link(double mass, double length) {
  return {mass, length, length, 0, true};
}

// Angles are those between neighbours.
Model<double> plane_chain(const std::vector<ChainLink>& links, double gravity = kGravity);
Model<double> plane_chain(const ChainLink& link, int count);

// Angles and rates from the vertical, in place of those of the joints.
CaseObserver absolute_angles();

// The case's own equations, from (q, qd) at time 0.
std::function<CaseReadings(double)> solution_of(special::Rates rates, special::Numbers start);

}  // namespace twinarm::smooth_parts
