// What one batch of runs reads and writes: plain data by lanes, made by batch_run.cpp and worked on
// by the kernel (batch_kernel.h), which is compiled for several levels of the instruction set.
//
// A lane is a cell. All lanes share the step's number, and so the table of the KVR's motion: rows
// by step, each a few doubles, spread over the lanes where they are read.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "solver/model/workspace.h"
#include "solver/spatial/batch.h"

namespace twinarm {

// A Model with inertias of its own in each lane. Between the passes of aba() the kernel turns I
// from the bodies' own to what pass 2 is to feel: with the weightless inertias of implicit springs,
// which are constant in body axes, and belong to IA and to nothing else (solver/forces/spring.h).
template <class S>
struct LaneModel : Model<S> {
  std::vector<Inertia<S>> I_own, I_felt;
  const Inertia<S>* I = nullptr;
  explicit LaneModel(Model<S> of) : Model<S>(std::move(of)) {}
};
// The one-dof joints alone: the rest is refused, and need not be compiled.
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
// and in a row for the energies likewise, at the step's start whatever the treatment, with the
// velocities before and after that moment, and then what the target has alone: of a linear one
// position times velocity after it; of both the square of that velocity.
enum class SpringKind { world, linear, joint };
struct RowSizes {
  std::size_t pose, velocity, products;
};
constexpr RowSizes row_sizes(SpringKind kind) {
  return kind == SpringKind::world    ? RowSizes{9, 3, 1}
         : kind == SpringKind::linear ? RowSizes{3, 3, 2}
                                      : RowSizes{1, 1, 0};
}
// Which moment of the step spring and damper see: its start, its start and its end, its end.
enum class SampleTime { start, both, end };
template <class S>
struct LaneSpring {
  SpringKind kind = SpringKind::world;
  std::size_t body = 0, iq = 0, iv = 0;
  std::size_t motion = 0, energy = 0;  // where its numbers begin in a row of each table
  S k, b, kb;  // stiffness, damping; k position_lead + b: what meets the link's own velocity
  S b_seen;    // b, or 0 of an absolute damper, which does not see the target move
  S m_star;    // weightless inertia of the treatment
  SampleTime sees = SampleTime::start;
  Vec3<S> p_B, kp;  // linear: the point in body axes, and k times it
};

// How a body is placed: not at all, or by its Xup, which may be a turn about z alone, as may be its
// way down to the base (coupling/batch/kernel/batch_kinematics.h).
enum class Place : char { none, general, in_line, turned };

template <class S>
struct BatchWork {
  static constexpr std::size_t kWindows = 4;

  LaneModel<S> model;
  State<S> x;
  Forces<S> forces;  // f_ext stays zero
  Workspace<S> w;
  S h;                                         // 0 in a lane that stands still
  S h_before;                                  // of the step before; 0 at the start
  S bound;                                     // infinite in a lane that stands still
  std::size_t steps = 0, first = 0, last = 0;  // of the run; those that the kernel is to take

  // By body, where springs need them: world to body axes, origin, bias acceleration.
  std::vector<Place> place;
  bool has_places = false, has_points = false, has_bias = false;  // some spring asks: E, o, a_bias
  bool has_joint_pulls = false, has_damping = false, has_energy = false;
  std::vector<Mat3<S>> E;
  std::vector<Vec3<S>> o;
  std::vector<Motion<S>> a_bias;
  std::vector<LaneSpring<S>> pulls;

  // Tables by step: `motion` has steps rows, the others steps + 1.
  const double *motion = nullptr, *energy = nullptr, *q_K = nullptr;
  const char* is_corner = nullptr;  // of a row of `energy`: the two velocities or steps differ
  std::size_t motion_stride = 0, energy_stride = 0;

  // By measured joint.
  std::vector<std::size_t> measured;                     // coordinates
  std::vector<S> error_integral, error_max, error_last;  // twice the integral
  std::vector<S> window_error_of;
  std::array<S, kWindows> window_error;
  // Sums of powers by the trapezoidal rule: of the hand; of all dampers. And what the springs hold
  // [J].
  S hand_work, hand_work_least, lost_work, spring_energy, spring_energy_at_start;
  S hand_power, lost_power;  // at the moment, while springs add theirs

  // A lane stops at its first step that leaves the bounds; `stopped` takes its results.
  std::size_t lanes_running = 0;
  void (*stopped)(BatchWork& work, std::size_t lane, std::size_t step) = nullptr;
  void* owner = nullptr;

  explicit BatchWork(const Model<S>& m) : model(m), x(m), forces(m), w(m) {}
};

}  // namespace twinarm
