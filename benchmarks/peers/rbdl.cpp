// RBDL 3.
#include <rbdl/rbdl.h>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

namespace rbd = RigidBodyDynamics;
using rbd::Math::VectorNd;

// Situations of a base: the position first; its quaternion as x, y, z, with w at the end of q.
class Rbdl final : public PeerEngine<VectorState> {
 public:
  std::string name() const override { return "rbdl"; }
  bool has(Algorithm algorithm) const override {
    return algorithm != Algorithm::derivatives &&
           (algorithm != Algorithm::step || !scene_.floats());
  }
  double constrained_tolerance() const override { return 1e-8; }
  void load_mechanism(const Scene& mechanism) override {
    scene_ = mechanism;
    model_ = std::make_unique<rbd::Model>();
    model_->gravity = mechanism.gravity;
    constexpr rbd::JointType kAbout[] = {rbd::JointTypeRevoluteX, rbd::JointTypeRevoluteY,
                                         rbd::JointTypeRevoluteZ};
    std::vector<unsigned> bodies;
    for (const Body& b : mechanism.bodies)
      bodies.push_back(model_->AddBody(
          b.parent < 0 ? 0 : bodies[index(b.parent)],
          rbd::Math::SpatialTransform(b.rotation.transpose(), b.position),
          rbd::Joint(b.joint == Joint::free ? rbd::JointTypeFloatingBase : kAbout[b.axis]),
          rbd::Body(b.mass, b.com, rbd::Math::Matrix3d(inertia3(b.inertia)))));
    pin_ = std::make_unique<rbd::ConstraintSet>();
    for (const Vector3d axis : {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()})
      pin_->AddContactConstraint(bodies.back(), Vector3d::Zero(), axis);
    pin_->Bind(*model_);
    qdd_ = tau_ = unit_ = VectorNd::Zero(model_->dof_count);
    M_ = rbd::Math::MatrixNd::Zero(model_->dof_count, model_->dof_count);
  }
  std::vector<double> qdd(std::size_t k) override {
    return in_order(k, Algorithm::forward_dynamics, qdd_);
  }
  std::vector<double> tau(std::size_t k) override {
    return in_order(k, Algorithm::inverse_dynamics, tau_);
  }
  std::vector<double> constrained_qdd(std::size_t k) override {
    return in_order(k, Algorithm::constrained_dynamics, qdd_);
  }

 protected:
  VectorState convert(const Situation& s) const override {
    VectorState to(s);
    if (!scene_.floats()) return to;
    std::rotate(&to.q[3], &to.q[4], to.q.data() + to.q.size());
    for (VectorNd* of : {&to.v, &to.tau, &to.qdd}) std::rotate(of->data(), &(*of)[3], &(*of)[6]);
    return to;
  }
  void run_one(Algorithm algorithm, const VectorState& s) override {
    switch (algorithm) {
      case Algorithm::forward_dynamics:
        rbd::ForwardDynamics(*model_, s.q, s.v, s.tau, qdd_);
        return;
      case Algorithm::inverse_dynamics:
        rbd::InverseDynamics(*model_, s.q, s.v, s.qdd, tau_);
        return;
      case Algorithm::mass_matrix:
        M_.setZero();
        rbd::CompositeRigidBodyAlgorithm(*model_, s.q, M_, true);
        return;
      case Algorithm::kinematics:
        rbd::UpdateKinematicsCustom(*model_, &s.q, &s.v, nullptr);
        return;
      case Algorithm::step:
        rbd::ForwardDynamics(*model_, s.q, s.v, s.tau, qdd_);
        next_.v = s.v + step_length * qdd_;
        next_.q = s.q + step_length * next_.v;
        return;
      case Algorithm::inverse_mass_matrix:
        for (Eigen::Index k = 0; k < unit_.size(); ++k) {
          unit_[k] = 1;
          rbd::CalcMInvTimesTau(*model_, s.q, unit_, qdd_, k == 0);
          M_.col(k) = qdd_;
          unit_[k] = 0;
        }
        return;
      case Algorithm::constrained_dynamics:
        rbd::ForwardDynamicsContactsKokkevis(*model_, s.q, s.v, s.tau, *pin_, qdd_);
        return;
      case Algorithm::derivatives:
        return;
    }
  }

 private:
  std::vector<double> in_order(std::size_t k, Algorithm algorithm, VectorNd& result) {
    run_one(algorithm, converted_[k]);
    std::vector<double> out(result.begin(), result.end());
    if (scene_.floats()) std::rotate(&out[0], &out[3], &out[6]);
    return out;
  }

  std::unique_ptr<rbd::Model> model_;
  std::unique_ptr<rbd::ConstraintSet> pin_;
  VectorNd qdd_, tau_, unit_;
  rbd::Math::MatrixNd M_;
  VectorState next_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) void add_engines(Engines& engines) {
  engines.push_back(std::make_unique<Rbdl>());
}

}  // namespace twinarm::bench
