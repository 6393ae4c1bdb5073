// Joint type at run time: JointType, the constants of its struct, and dispatch to the struct.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "solver/model/joints.h"

namespace twinarm {

#define TWINARM_JOINT_NAME(name, Joint) name,
enum class JointType : unsigned char { TWINARM_JOINTS(TWINARM_JOINT_NAME) };
#define TWINARM_TYPE(name, Joint) JointType::name,
inline constexpr std::array all_joint_types{TWINARM_JOINTS(TWINARM_TYPE)};
#undef TWINARM_TYPE

// Constants of a joint's struct (joints.h).
struct JointFacts {
  const char* name;
  std::size_t nq, nv;
  AxisUse axis;
  int quaternion;
  std::span<const Coordinate> coordinates;
};
constexpr JointFacts facts_of(JointType type) {
#define TWINARM_FACTS(name, Joint)      \
  JointFacts{#name,                     \
             Joint<double>::nq,         \
             Joint<double>::nv,         \
             Joint<double>::axis,       \
             Joint<double>::quaternion, \
             Joint<double>::coordinates},
  constexpr std::array all{TWINARM_JOINTS(TWINARM_FACTS)};
#undef TWINARM_FACTS
  return all[static_cast<std::size_t>(type)];
}
constexpr const char* name_of(JointType type) {
  return facts_of(type).name;
}
// One degree of freedom, which is a length.
constexpr bool is_translational(JointType type) {
  return facts_of(type).nv == 1 && !facts_of(type).coordinates[0].is_angle;
}

template <class Joint, class S>
Joint joint_of([[maybe_unused]] const S& pitch) {
  if constexpr (requires { &Joint::pitch; })
    return {{}, pitch};
  else
    return {};
}

// Calls f with the joint struct of this type, e.g. f(RevoluteJoint<S>{}).
template <class S, class F>
void visit_joint(JointType type, const S& pitch, F&& f) {
  switch (type) {
#define TWINARM_CASE(name, Joint) \
  case JointType::name:           \
    return f(joint_of<Joint<S>>(pitch));
    TWINARM_JOINTS(TWINARM_CASE)
#undef TWINARM_CASE
  }
}

// vJ = S qd, RBDA (3.34); for a prescribed joint the given velocity.
template <class Joint, class Subspace, class S>
auto joint_velocity(const Joint& joint, const Subspace& subspace, const S* qd) {
  if constexpr (requires { joint.np; }) {
    return joint.vJ(qd);
  } else {
    VecN<S, Joint::nv> rate;
    for (std::size_t k = 0; k < Joint::nv; ++k) rate[k] = qd[k];
    return times(subspace, rate);
  }
}

// XJ(q), with the precomputed sine and cosine of q[0] if valid (solver/spatial/sincos_batch.h).
template <class Joint, class S>
auto joint_transform(const Joint& joint, const S* q, const S* sin, const S* cos) {
  if constexpr (precomputes_sincos<S> && requires { joint.XJ(SinCos<S>{}); })
    if (std::abs(q[0]) <= kPolynomialRange) return joint.XJ(SinCos<S>{*sin, *cos});
  return joint.XJ(q);
}

}  // namespace twinarm
