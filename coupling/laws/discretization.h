// What a treatment is called, which target it looks at, and the m* that it adds
// (solver/forces/spring.h).
#pragma once

#include "coupling/target/target_robot.h"
#include "solver/forces/force_source.h"

namespace twinarm {

inline const char* name_of(Treatment treatment) {
  constexpr const char* kNames[] = {"explicit", "semi-implicit", "implicit"};
  return kNames[static_cast<std::size_t>(treatment)];
}

struct TreatmentTerms {
  const KvrSample* spring_target;  // pose of the KVR that the spring pulls to
  const KvrSample* damper_target;  // velocity of the KVR that the damper pulls to
  double look_ahead;               // [s]: the spring sees the DVR at x + look_ahead v
  double m_star(double k, double b) const { return weight_b * b + weight_k * k; }
  double weight_b, weight_k;      // [s], [s^2]
  bool sees_target_moves = true;  // false: an absolute damper, against the link's own velocity
};

inline TreatmentTerms terms_of(Treatment treatment, KinematicRobot& kvr, double t, double h) {
  switch (treatment) {
    case Treatment::explicit_:
      return {&kvr.at(t), &kvr.at(t), 0, 0, 0};
    case Treatment::semi_implicit:
      return {&kvr.start(), &kvr.end(), 0, h, 0};
    case Treatment::implicit:
      break;
  }
  return {&kvr.end(), &kvr.end(), h, h, h * h};
}

}  // namespace twinarm
