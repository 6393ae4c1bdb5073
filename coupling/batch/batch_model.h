// A model without fixed joints: links fixed to each other are merged into one body.
#pragma once

#include <vector>

#include "coupling/batch/batch_run.h"
#include "coupling/batch/kernel/batch_state.h"
#include "coupling/batch/simd_access.h"
#include "solver/forces/spring.h"
#include "solver/model/model.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct ModelWithoutFixedJoints {
  Model<double> model;               // same coordinates, velocities and joints' properties
  std::vector<std::size_t> origin;   // by merged body: its body in the whole model
  std::vector<std::size_t> carrier;  // by body: its merged body; 0: base
  std::vector<Transform<double>> X;  // by body: from its carrier's frame to its own
  std::vector<Inertia<double>> I;    // by body: inertia in the frame of its carrier

  // Joints have at most one degree of freedom.
  explicit ModelWithoutFixedJoints(const Model<double>& whole);
  // From link coordinates of a body's point to coordinates of its carrier.
  Vec3<double> point_of(const Model<double>& whole, std::size_t body, const Vector3& p_L) const;
  // Inertias of the merged bodies with a factor for each body; empty: 1.
  std::vector<Inertia<double>> inertias(const std::vector<double>& factor) const;
};

inline SpringKind kind_of(const BatchSpring& spring) {
  if (spring.type == CouplingSpec::Type::linear) return SpringKind::linear;
  return spring.measure == SpringSpace::world ? SpringKind::world : SpringKind::joint;
}

inline SpringTime time_of(Discretization discretization) {
  return discretization == Discretization::explicit_       ? SpringTime::start
         : discretization == Discretization::semi_implicit ? SpringTime::both
                                                           : SpringTime::end;
}

// Added inertia m* of the discretization (solver/forces/spring.h).
inline double m_star(Discretization discretization, double h, const BatchCell::Gains& gains) {
  const double by_damper = discretization == Discretization::explicit_ ? 0 : h * gains.b;
  return by_damper + (discretization == Discretization::implicit ? h * h * gains.k : 0);
}

// Of a flywheel, or of a particle at p.
inline Inertia<double> added_inertia(SpringKind kind, double m, const Vec3<double>& p) {
  if (kind == SpringKind::world) return {0, {}, Sym3<double>::scaled_identity(m)};
  return particle_inertia(m, p);
}

// Writes a cell's spring to a lane; p: its point in body axes. The added inertia goes to
// `effective` or to the joint's armature.
template <class S>
void load_spring(BatchWork<S>& work, std::size_t s, std::size_t lane, const BatchSpring& spring,
                 const BatchCell::Gains& gains, double h, const Vec3<double>& p,
                 Inertia<double>& effective) {
  LaneSpring<S>& lane_spring = work.springs[s];
  const double position_lead = spring.discretization == Discretization::implicit ? h : 0;
  const double m = m_star(spring.discretization, h, gains);
  set_lane(lane_spring.k, lane, gains.k);
  set_lane(lane_spring.b, lane, gains.b);
  set_lane(lane_spring.kb, lane, gains.k * position_lead + gains.b);
  set_lane(lane_spring.b_seen, lane, spring.absolute_damper ? 0 : gains.b);
  set_lane(lane_spring.m_star, lane, m);
  set_lane(lane_spring.p_B, lane, p);
  set_lane(lane_spring.kp, lane, gains.k * p);
  if (lane_spring.kind == SpringKind::joint) {
    S& armature = work.forces.armature[lane_spring.iv];
    set_lane(armature, lane, lane_of(armature, lane) + m);
  } else {
    add_congruence(Transform<double>{}, added_inertia(lane_spring.kind, m, p), effective);
  }
}

}  // namespace twinarm
