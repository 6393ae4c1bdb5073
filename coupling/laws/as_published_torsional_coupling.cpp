// The torsional coupling as published (coupling/laws/as_published.h).
#include <Eigen/Geometry>

#include "coupling/laws/coupling_spec.h"
#include "solver/forces/spring.h"

namespace twinarm {
namespace {

Matrix3 rotation(const Vector3& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

class AsPublishedTorsional final : public AsPublished<AsPublishedTorsional, Matrix3> {
 public:
  AsPublishedTorsional(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr)
      : AsPublished(spec, model, kvr, spec.options, Matrix3::Identity()) {}
  void add_forces(const State<double>&, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const int body = springs_[s].body;
      add_couple(k, body, readings_[s].force_W, forces);
      const int parent = model_.parent[static_cast<std::size_t>(body)];
      if (options_.measure == SpringSpace::joint && parent > 0)  // the reaction, on the parent link
        add_couple(k, parent, -readings_[s].force_W, forces);
    }
  }
  // B_q = 0 for the folded and the unsigned damper, which have no linear part.
  JointSpace joint_space(const Kinematics& k) const override {
    JointSpace sum(model_.nv);
    for (const Spring& spring : springs_) {
      Eigen::Matrix3Xd J = rotation_jacobian(model_, k, spring.body);
      if (options_.measure == SpringSpace::joint)
        J -= rotation_jacobian(model_, k, model_.parent[static_cast<std::size_t>(spring.body)]);
      sum.add(spring.k, options_.damper == Damper::vector_ ? spring.b : 0, J);
    }
    return sum;
  }

  // Orientation of the link in the world, or relative to its parent link.
  Matrix3 pose(const Spring& spring, const Kinematics& k) const {
    const auto i = static_cast<std::size_t>(spring.body);
    if (options_.measure == SpringSpace::world) return k.X_WL[i].R;
    return k.X_WL[parent_of(i)].R.transpose() * k.X_WL[i].R;
  }
  static Vector3 step_between(const Matrix3& before, const Matrix3& now) {
    return rotation_vector(now * before.transpose());
  }
  void evaluate(std::size_t s, const Kinematics& k, const Matrix3& R_K, const Matrix3& R_D,
                const Vector3& step_K, const Vector3& step_D, double interval) {
    const Spring& spring = springs_[s];
    const auto i = static_cast<std::size_t>(spring.body);
    const Vector3 restoring = spring.k * (R_D * rotation_vector(R_D.transpose() * R_K));
    const Vector3 torque = restoring + damping(spring, step_K, step_D, interval);
    SpringState& reading = readings_[s];
    // In joint space the torque is in the parent's axes.
    reading.force_W =
        options_.measure == SpringSpace::world ? torque : Vector3(k.X_WL[parent_of(i)].R * torque);
    reading.size = torque.norm();
    reading.p_K = kvr_.start().k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
  }

 private:
  Vector3 damping(const Spring& spring, const Vector3& step_K, const Vector3& step_D,
                  double interval) const {
    const double per_time = options_.difference == Difference::per_frame ? 1.0 : 1.0 / interval;
    const Vector3 w_K = step_K * per_time, w_D = step_D * per_time;
    if (options_.damper == Damper::vector_) return spring.b * (w_K - w_D);
    const double angle_K = step_K.norm();
    if (angle_K < 1e-14) return Vector3::Zero();  // the KVR is at rest: no axis
    const double relative = options_.damper == Damper::folded
                                ? rotation_vector(rotation(w_D) * rotation(w_K).transpose()).norm()
                                : (w_K - w_D).norm();
    return options_.damping_sign * spring.b * relative * (step_K / angle_K);
  }
  std::size_t parent_of(std::size_t i) const { return static_cast<std::size_t>(model_.parent[i]); }
};

}  // namespace

CouplingFacts as_published_torsional_coupling() {
  return {.name = "published-torsional",
          .type = CouplingSpec::Type::torsional,
          .printed = true,
          .order = 9,
          .can_hold = true,
          .step_law = StepLaw::printed,
          .make = make_law<AsPublishedTorsional>};
}

}  // namespace twinarm
