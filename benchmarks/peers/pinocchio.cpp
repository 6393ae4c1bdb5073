// Pinocchio 3, header only, in two variants: its algorithms in body axes, and those in world axes,
// of which either is the faster on some mechanisms.
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/constrained-dynamics.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/pv.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>
#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

namespace pin = pinocchio;
using Eigen::VectorXd;

pin::JointModel joint_of(const Body& b) {
  if (b.joint == Joint::free) return pin::JointModelFreeFlyer();
  if (b.axis == 0) return pin::JointModelRX();
  if (b.axis == 1) return pin::JointModelRY();
  return pin::JointModelRZ();
}

// Situations of a base: the linear part first, both in body axes; q with x, y, z, w.
class Pinocchio final : public PeerEngine<VectorState> {
 public:
  Pinocchio(std::string name, pin::Convention axes) : name_(std::move(name)), axes_(axes) {}
  std::string name() const override { return name_; }
  // Inverse mass matrices and derivatives have one form. Its solver of loops in world axes,
  // constrainedABA, is iterative and stops at 1e-8.
  bool has(Algorithm algorithm) const override {
    return axes_ == pin::Convention::LOCAL || algorithm == Algorithm::forward_dynamics ||
           algorithm == Algorithm::mass_matrix || algorithm == Algorithm::constrained_dynamics;
  }
  double constrained_tolerance() const override {
    return axes_ == pin::Convention::LOCAL ? 1e-8 : 1e-5;
  }

  void load_mechanism(const Scene& mechanism) override {
    scene_ = mechanism;
    model_ = {};
    model_.gravity.linear(mechanism.gravity);
    std::vector<pin::JointIndex> joints;
    for (const Body& b : mechanism.bodies) {
      joints.push_back(model_.addJoint(b.parent < 0 ? 0 : joints[index(b.parent)], joint_of(b),
                                       pin::SE3(b.rotation, b.position),
                                       "joint" + std::to_string(joints.size())));
      model_.appendBodyToJoint(joints.back(), pin::Inertia(b.mass, b.com, inertia3(b.inertia)));
    }
    data_ = std::make_unique<pin::Data>(model_);
    pins_.clear(), pin_data_.clear();
    pins_.emplace_back(pin::CONTACT_3D, model_, joints.back(), pin::SE3::Identity(), pin::LOCAL);
    pin_data_.emplace_back(pins_[0]);
    pinned_ = std::make_unique<pin::Data>(model_);
    if (axes_ == pin::Convention::LOCAL)
      pin::initConstraintDynamics(model_, *pinned_, pins_);
    else
      pin::initPvSolver(model_, *pinned_, pins_);
  }
  std::vector<double> qdd(std::size_t k) override {
    run_one(Algorithm::forward_dynamics, converted_[k]);
    return in_order_of_scene(data_->ddq, converted_[k]);
  }
  std::vector<double> tau(std::size_t k) override {
    if (!has(Algorithm::inverse_dynamics)) return {};
    run_one(Algorithm::inverse_dynamics, converted_[k]);
    return {data_->tau.begin(), data_->tau.end()};  // only those of joints are compared
  }
  std::vector<double> constrained_qdd(std::size_t k) override {
    run_one(Algorithm::constrained_dynamics, converted_[k]);
    return in_order_of_scene(pinned_->ddq, converted_[k]);
  }

 protected:
  VectorState convert(const Situation& s) const override {
    VectorState to(s);
    if (!scene_.floats()) return to;
    const Eigen::Matrix3d R = quaternion(&s.q[3]).toRotationMatrix();
    std::rotate(&to.q[3], &to.q[4], &to.q[6] + 1);
    for (VectorXd* of : {&to.v, &to.tau, &to.qdd}) {
      const Vector3d angular = of->head<3>(), linear = of->segment<3>(3);
      of->head<6>() << R.transpose() * linear, angular;
    }
    to.qdd.head<3>() -= to.v.segment<3>(3).cross(to.v.head<3>());
    return to;
  }
  void run_one(Algorithm algorithm, const VectorState& s) override {
    switch (algorithm) {
      case Algorithm::forward_dynamics:
        pin::aba(model_, *data_, s.q, s.v, s.tau, axes_);
        return;
      case Algorithm::inverse_dynamics:
        pin::rnea(model_, *data_, s.q, s.v, s.qdd);
        return;
      case Algorithm::mass_matrix:
        pin::crba(model_, *data_, s.q, axes_);
        return;
      case Algorithm::kinematics:
        pin::forwardKinematics(model_, *data_, s.q, s.v);
        return;
      case Algorithm::step:
        pin::aba(model_, *data_, s.q, s.v, s.tau, axes_);
        next_.v = s.v + step_length * data_->ddq;
        shift_ = step_length * next_.v;
        next_.q.resize(model_.nq);
        pin::integrate(model_, s.q, shift_, next_.q);
        return;
      case Algorithm::inverse_mass_matrix:
        pin::computeMinverse(model_, *data_, s.q);
        return;
      case Algorithm::derivatives:
        pin::computeABADerivatives(model_, *data_, s.q, s.v, s.tau);
        return;
      case Algorithm::constrained_dynamics:
        if (axes_ == pin::Convention::LOCAL)
          pin::constraintDynamics(model_, *pinned_, s.q, s.v, s.tau, pins_, pin_data_, once_);
        else
          pin::constrainedABA(model_, *pinned_, s.q, s.v, s.tau, pins_, pin_data_, repeated_);
    }
  }

 private:
  std::vector<double> in_order_of_scene(const VectorXd& qdd, const VectorState& s) const {
    VectorXd out = qdd;
    if (scene_.floats()) {
      const Eigen::Matrix3d R = Eigen::Quaterniond(&s.q[3]).toRotationMatrix();
      const Vector3d linear = qdd.head<3>() + s.v.segment<3>(3).cross(s.v.head<3>());
      out.head<6>() << qdd.segment<3>(3), R * linear;
    }
    return {out.begin(), out.end()};
  }

  std::string name_;
  pin::Convention axes_;
  pin::Model model_;
  std::unique_ptr<pin::Data> data_, pinned_;
  PINOCCHIO_STD_VECTOR_WITH_EIGEN_ALLOCATOR(pin::RigidConstraintModel) pins_;
  PINOCCHIO_STD_VECTOR_WITH_EIGEN_ALLOCATOR(pin::RigidConstraintData) pin_data_;
  pin::ProximalSettings once_{1e-10, 0, 1}, repeated_{1e-10, 1e-8, 10};
  VectorState next_;
  VectorXd shift_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) void add_engines(Engines& engines) {
  engines.push_back(std::make_unique<Pinocchio>("pinocchio", pin::Convention::LOCAL));
  engines.push_back(std::make_unique<Pinocchio>("pinocchio world", pin::Convention::WORLD));
}

}  // namespace twinarm::bench
