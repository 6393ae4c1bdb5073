// DART. A step is what its World does for a skeleton without contact: forward dynamics, velocities,
// positions.
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "benchmarks/speed/eigen.h"
#include "benchmarks/speed/engine.h"

namespace twinarm::speed {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::FreeJoint;
using dart::dynamics::RevoluteJoint;

class Dart : public Engine {
 public:
  std::string name() const override { return "dart"; }
  bool has(Algorithm) const override { return true; }

  void load(const Mechanism& mechanism) override {
    mechanism_ = mechanism;
    skeleton_ = dart::dynamics::Skeleton::create(mechanism.name);
    skeleton_->setGravity({0, 0, -standard_gravity});
    skeleton_->setTimeStep(step_length);
    bodies_.clear();
    for (std::size_t i = 0; i < mechanism.links.size(); ++i) bodies_.push_back(add(i));
  }

  void set_situations(const std::vector<Situation>& situations) override {
    states_.clear();
    for (const Situation& s : situations) states_.push_back(convert(s));
    situations_ = situations;
  }
  void run(Algorithm algorithm) override {
    for (const State& state : states_) run(algorithm, state);
  }
  std::vector<double> qdd(std::size_t k) override {
    run(Algorithm::forward_dynamics, states_[k]);
    Eigen::VectorXd a = skeleton_->getAccelerations();
    if (mechanism_.floating) {  // (alpha; spatial acceleration of the origin), both in body axes
      const Base base(situations_[k]);
      const Eigen::Vector3d alpha = a.head<3>();
      const Eigen::Vector3d v_B = base.R.conjugate() * base.v_W;
      const Eigen::Vector3d a_B = a.segment<3>(3) + base.w_B.cross(v_B);
      a.head<3>() = base.R * a_B;
      a.segment<3>(3) = alpha;
    }
    return {a.begin(), a.end()};
  }
  std::vector<double> tau(std::size_t k) override {
    run(Algorithm::inverse_dynamics, states_[k]);
    const Eigen::VectorXd tau = skeleton_->getForces();
    return joints_of(mechanism_, {tau.begin(), tau.end()});
  }

 private:
  // In DART's coordinates: of the base its logarithm of rotation and position; velocities, forces
  // and accelerations are twists and wrenches in body axes, angular part first.
  struct State {
    Eigen::VectorXd q, v, tau, qdd;
  };

  BodyNode* add(std::size_t i) {
    const Link& link = mechanism_.links[i];
    BodyNode* parent = link.parent < 0 ? nullptr : bodies_[static_cast<std::size_t>(link.parent)];
    const BodyNode::AspectProperties named("link" + std::to_string(i));
    BodyNode* body = nullptr;
    if (i < mechanism_.first_joint()) {
      body = skeleton_->createJointAndBodyNodePair<FreeJoint>(parent, {}, named).second;
    } else {
      RevoluteJoint::Properties properties;
      properties.mName = "joint" + std::to_string(i);
      properties.mAxis = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(link.axis));
      properties.mT_ParentBodyToJoint.linear() = matrix3(link.rotation);
      properties.mT_ParentBodyToJoint.translation() = vector3(link.position);
      body = skeleton_->createJointAndBodyNodePair<RevoluteJoint>(parent, properties, named).second;
    }
    body->setInertia({link.mass, vector3(link.com), matrix3(link.inertia)});
    return body;
  }

  State convert(const Situation& s) const {
    const auto eigen = [](const std::vector<double>& v) {
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())));
    };
    State state{eigen(s.q), eigen(s.v), eigen(s.tau), eigen(s.qdd)};
    if (!mechanism_.floating) return state;

    const Base base(s);
    const Eigen::Quaterniond R_BW = base.R.conjugate();
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WB.linear() = base.R.toRotationMatrix();
    X_WB.translation() = base.p;
    const Eigen::VectorXd joints = state.q.tail(static_cast<Eigen::Index>(mechanism_.joints()));
    state.q.resize(joints.size() + 6);
    state.q << FreeJoint::convertToPositions(X_WB), joints;
    const Eigen::Vector3d v_B = R_BW * base.v_W;
    state.v.head<6>() << base.w_B, v_B;
    state.tau.head<6>() << base.t_B, R_BW * base.f_W;
    const Eigen::Vector3d a_W(s.qdd.data()), alpha_B(s.qdd.data() + 3);
    state.qdd.head<6>() << alpha_B, R_BW * a_W - base.w_B.cross(v_B);
    return state;
  }

  void run(Algorithm algorithm, const State& state) {
    skeleton_->setPositions(state.q);
    switch (algorithm) {
      case Algorithm::mass_matrix:
        skeleton_->getMassMatrix();
        return;
      case Algorithm::kinematics:  // computed on demand, down to the body that is asked for
        for (const BodyNode* body : bodies_) body->getWorldTransform();
        return;
      case Algorithm::inverse_dynamics:
        skeleton_->setVelocities(state.v);
        skeleton_->setAccelerations(state.qdd);
        skeleton_->computeInverseDynamics();
        return;
      case Algorithm::forward_dynamics:
      case Algorithm::step:
        skeleton_->setVelocities(state.v);
        skeleton_->setForces(state.tau);
        skeleton_->computeForwardDynamics();
        if (algorithm == Algorithm::forward_dynamics) return;
        skeleton_->integrateVelocities(step_length);
        skeleton_->integratePositions(step_length);
    }
  }

  Mechanism mechanism_;
  dart::dynamics::SkeletonPtr skeleton_;
  std::vector<BodyNode*> bodies_;
  std::vector<State> states_;
  std::vector<Situation> situations_;
};

}  // namespace

void add_dart(Engines& engines) {
  engines.push_back(std::make_unique<Dart>());
}

}  // namespace twinarm::speed
