// State of one batch, created by batch_run.cpp and advanced by the kernel (batch_kernel.h), which
// is compiled for several instruction sets. One lane per cell; all lanes share the step index and
// so the table of the KVR's motion.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "solver/model/workspace.h"
#include "solver/spatial/batch.h"

namespace twinarm {

// A Model with different inertias in each lane. Between the passes of aba() the kernel switches I
// from the bodies' inertias to those with the added inertias of implicit springs, which belong to
// IA only (solver/forces/spring.h).
template <class S>
struct LaneModel : Model<S> {
  std::vector<Inertia<S>> I_own, I_effective;
  const Inertia<S>* I = nullptr;
  explicit LaneModel(Model<S> of) : Model<S>(std::move(of)) {}
};
// One-dof joints only.
template <class S, class F>
void visit_joint(const LaneModel<S>& model, std::size_t i, F&& f) {
  switch (model.joint[i]) {
    case JointType::revolute:
      return f(RevoluteJoint<S>{});
    case JointType::prismatic:
      return f(PrismaticJoint<S>{});
    default:
      return f(ScrewJoint<S>{{}, model.pitch[i]});
  }
}

// One spring-damper. In a row of the motion:
//   world   E (9, from world to body axes of the KVR's link), angular velocity (3, world axes)
//   linear  position and velocity of the KVR's point (3, 3, world axes)
//   joint   coordinate and velocity (1, 1)
// A row of the energy table: the same at the step's start, with the velocities before and after
// that time, then the products of the target's numbers: linear: position times velocity after;
// linear and world: square of that velocity.
enum class SpringKind { world, linear, joint };
struct RowSizes {
  std::size_t pose, velocity, products;
};
constexpr RowSizes row_sizes(SpringKind kind) {
  return kind == SpringKind::world    ? RowSizes{9, 3, 1}
         : kind == SpringKind::linear ? RowSizes{3, 3, 2}
                                      : RowSizes{1, 1, 0};
}
// Sample time of spring and damper: start of the step; start and end; end.
enum class SpringTime { start, both, end };
template <class S>
struct LaneSpring {
  SpringKind kind = SpringKind::world;
  std::size_t body = 0, iq = 0, iv = 0;
  std::size_t motion = 0, energy = 0;  // offsets in the rows of the tables
  S k, b, kb;                          // stiffness, damping; k position_lead + b
  S b_seen;  // damping on the target's velocity: b, or 0 (absolute damper)
  S m_star;  // added inertia
  SpringTime time = SpringTime::start;
  Vec3<S> p_B, kp;  // linear: point in body axes, and k times it
};

// By step, shared by all lanes.
struct BatchTables {
  std::size_t motion_stride = 0, energy_stride = 0;
  std::size_t steps = 0;               // the last one may be shorter
  std::vector<double> motion;          // steps rows
  std::vector<double> energy;          // steps + 1 rows
  std::vector<char> is_velocity_jump;  // by row of `energy`: velocities or steps differ
  std::vector<double> q_K;             // steps + 1 rows
};

// Kinematics needed of a body (batch_kinematics.h).
enum class Frame : char { none, general, aligned, planar };

template <class S>
struct BatchWork {
  LaneModel<S> model;
  State<S> x;
  Forces<S> forces;  // f_ext stays zero
  Workspace<S> w;
  S h;         // 0 in a stopped lane
  S h_before;  // of the step before; 0 at the start
  S bound;     // infinite in a stopped lane
  const BatchTables& tables;
  std::size_t first = 0, last = 0;  // steps, for the kernel

  // By body with springs: world to body axes, origin, bias acceleration.
  std::vector<Frame> frames;
  bool needs_rotations = false, needs_origins = false, needs_bias = false;  // E, o, a_bias
  bool has_joint_springs = false, has_damping = false;
  std::vector<Mat3<S>> E;
  std::vector<Vec3<S>> o;
  std::vector<Motion<S>> a_bias;
  std::vector<LaneSpring<S>> springs;

  // By measured joint.
  std::vector<std::size_t> measured;                     // coordinates
  std::vector<S> error_integral, error_max, error_last;  // twice the integral
  // Work of the operator and of all dampers (trapezoidal rule), and spring energy [J].
  S input_work, input_work_min, dissipated_work, spring_energy, spring_energy_at_start;
  S operator_power,
      dissipated_power;  // at the current time  `stopped` stores the results of a diverged lane.
  std::size_t lanes_running = 0;
  void (*stopped)(BatchWork& work, std::size_t lane, std::size_t step) = nullptr;
  void* owner = nullptr;

  BatchWork(const Model<S>& m, const BatchTables& t) : model(m), x(m), forces(m), w(m), tables(t) {}
};

}  // namespace twinarm
