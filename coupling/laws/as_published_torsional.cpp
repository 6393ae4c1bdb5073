#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "coupling/laws/as_published.h"
#include "solver/forces/spring.h"

namespace twinarm {
namespace {

Matrix3 rotation(const Vector3& turn) {
  const double angle = turn.norm();
  if (angle == 0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

}  // namespace

PrintedTorsional::PrintedTorsional(std::string name, const Model<double>& model,
                                   KinematicRobot& kvr, std::vector<Spring> springs,
                                   PrintedOptions options)
    : Coupling(std::move(name), model, kvr, std::move(springs)),
      options_(options),
      past_(springs_.size()) {
  options_.hold_steps = std::max(1, options_.hold_steps);
}

// Of the link in the world, or relative to its parent link.
Matrix3 PrintedTorsional::orientation(const Spring& spring, const Kinematics& k) const {
  const auto i = static_cast<std::size_t>(spring.body);
  if (options_.measure == Measure::world) return k.X_WL[i].R;
  const auto parent = static_cast<std::size_t>(model_.parent[i]);
  return k.X_WL[parent].R.transpose() * k.X_WL[i].R;
}

Vector3 PrintedTorsional::damping(const Spring& spring, const Vector3& step_K,
                                  const Vector3& step_D, double interval) const {
  const double per_time = options_.difference == Difference::per_frame ? 1.0 : 1.0 / interval;
  const Vector3 w_K = step_K * per_time, w_D = step_D * per_time;
  if (options_.damper == Damper::vector_) return spring.b * (w_K - w_D);
  const double angle_K = step_K.norm();
  if (angle_K < 1e-14) return Vector3::Zero();  // the KVR rests: the printed law has no axis
  const double relative = options_.damper == Damper::folded
                              ? rotation_vector(rotation(w_D) * rotation(w_K).transpose()).norm()
                              : (w_K - w_D).norm();
  return options_.damping_sign * spring.b * relative * (step_K / angle_K);
}

void PrintedTorsional::begin_step(const Kinematics& k, double t, double h) noexcept {
  kvr_.begin_step(t, h);
  const bool first = steps_ == 0, due = steps_ % options_.hold_steps == 0;
  ++steps_;
  if (!due) return;
  const double interval = h * options_.hold_steps;
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    const auto i = static_cast<std::size_t>(spring.body);
    Past& past = past_[s];
    const Matrix3 R_K = orientation(spring, kvr_.start().k), R_D = orientation(spring, k);
    const Vector3 old_step_K = past.step_K, old_step_D = past.step_D;
    past.step_K = first ? Vector3::Zero() : rotation_vector(R_K * past.R_K.transpose());
    past.step_D = first ? Vector3::Zero() : rotation_vector(R_D * past.R_D.transpose());
    past.R_K = R_K;
    past.R_D = R_D;

    const bool older = options_.difference == Difference::older;
    const Vector3 restoring = spring.k * (R_D * rotation_vector(R_D.transpose() * R_K));
    const Vector3 pull = restoring + damping(spring, older ? old_step_K : past.step_K,
                                             older ? old_step_D : past.step_D, interval);
    SpringReading& reading = readings_[s];
    // A joint's orientation stands in its parent's axes.
    const auto parent = static_cast<std::size_t>(model_.parent[i]);
    reading.pull = options_.measure == Measure::world ? pull : k.X_WL[parent].R * pull;
    reading.size = pull.norm();
    reading.p_K = kvr_.start().k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
  }
}

void PrintedTorsional::add_forces(const State<double>&, const Kinematics& k,
                                  Forces<double>& forces) noexcept {
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const int body = springs_[s].body;
    add_couple(k, body, readings_[s].pull, forces);
    const int parent = model_.parent[static_cast<std::size_t>(body)];
    if (options_.measure == Measure::joint && parent > 0)  // the reaction, on the parent link
      add_couple(k, parent, -readings_[s].pull, forces);
  }
}

Coupling::JointSpace PrintedTorsional::joint_space(const Kinematics& k) const {
  JointSpace sum(model_.nv);
  for (const Spring& spring : springs_) {
    Eigen::Matrix3Xd J = rotation_jacobian(model_, k, spring.body);
    if (options_.measure == Measure::joint)
      J -= rotation_jacobian(model_, k, model_.parent[static_cast<std::size_t>(spring.body)]);
    sum.add(spring.k, options_.damper == Damper::vector_ ? spring.b : 0, J);
  }
  return sum;
}

void PrintedTorsional::visit_memory(Memory& memory) {
  Coupling::visit_memory(memory);
  memory.visit(steps_);
  for (Past& past : past_) {
    for (Matrix3* R : {&past.R_K, &past.R_D})
      for (Eigen::Index c = 0; c < 9; ++c) memory.visit((*R)(c));
    for (Vector3* v : {&past.step_K, &past.step_D}) memory.visit(*v);
  }
}

}  // namespace twinarm
