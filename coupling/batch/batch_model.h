// A model without fixed joints: what is fixed to a link is one body with it.
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
  std::vector<std::size_t> origin;   // by lumped body: the body of the whole model
  std::vector<std::size_t> carrier;  // by body: the lumped body that it is part of; 0 of the base
  std::vector<Transform<double>> X;  // by body: from its carrier's axes and origin to its own
  std::vector<Inertia<double>> I;  // by body: its own inertia, about and in the axes of its carrier

  // All joints with a degree of freedom have one.
  explicit ModelWithoutFixedJoints(const Model<double>& whole);
  // A point of one of the bodies, from its origin in link axes: from the carrier's in body axes.
  Vec3<double> point_of(const Model<double>& whole, std::size_t body, const Vector3& p_L) const;
  // Of the lumped bodies, where each body's inertia has a factor; empty: 1 for all.
  std::vector<Inertia<double>> inertias(const std::vector<double>& factor) const;
};

// A cell's spring put into its lane of a batch.
inline SpringKind kind_of(const BatchSpring& spring) {
  if (spring.type == CouplingSpec::Type::linear) return SpringKind::linear;
  return spring.measure == SpringSpace::world ? SpringKind::world : SpringKind::joint;
}

inline SampleTime sees_of(Discretization treatment) {
  return treatment == Discretization::explicit_       ? SampleTime::start
         : treatment == Discretization::semi_implicit ? SampleTime::both
                                                      : SampleTime::end;
}

// m* of the treatment (solver/forces/spring.h).
inline double m_star(Discretization treatment, double h, const BatchCell::Gains& gains) {
  const double by_damper = treatment == Discretization::explicit_ ? 0 : h * gains.b;
  return by_damper + (treatment == Discretization::implicit ? h * h * gains.k : 0);
}

// A weightless flywheel, or a particle at p.
inline Inertia<double> weightless(SpringKind kind, double m, const Vec3<double>& p) {
  if (kind == SpringKind::world) return {0, {}, Sym3<double>::scaled_identity(m)};
  return particle_inertia(m, p);
}

// p: its point in body axes. What the treatment makes the body feel is added to `felt`, or to the
// joint's armature.
template <class S>
void load_spring(BatchWork<S>& work, std::size_t s, std::size_t lane, const BatchSpring& spring,
                 const BatchCell::Gains& gains, double h, const Vec3<double>& p,
                 Inertia<double>& felt) {
  LaneSpring<S>& pull = work.pulls[s];
  const double position_lead = spring.treatment == Discretization::implicit ? h : 0;
  const double m = m_star(spring.treatment, h, gains);
  set_lane(pull.k, lane, gains.k);
  set_lane(pull.b, lane, gains.b);
  set_lane(pull.kb, lane, gains.k * position_lead + gains.b);
  set_lane(pull.b_seen, lane, spring.absolute_damper ? 0 : gains.b);
  set_lane(pull.m_star, lane, m);
  set_lane(pull.p_B, lane, p);
  set_lane(pull.kp, lane, gains.k * p);
  if (pull.kind == SpringKind::joint) {
    S& armature = work.forces.armature[pull.iv];
    set_lane(armature, lane, lane_of(armature, lane) + m);
  } else {
    add_congruence(Transform<double>{}, weightless(pull.kind, m, p), felt);
  }
}

}  // namespace twinarm
