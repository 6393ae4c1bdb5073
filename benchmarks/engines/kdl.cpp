// Orocos KDL: algorithms of chains with a fixed base; no scenes. Forward dynamics solves with the
// mass matrix.
//
// header: kdl/chain.hpp
// libraries: orocos-kdl
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainfksolvervel_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

struct KdlState {
  KDL::JntArray q, v, tau, qdd;
};

KDL::Vector vector_of(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

class Kdl final : public PeerEngine<KdlState> {
 public:
  std::string name() const override { return "kdl"; }
  std::string refusal(const Scene& scene) const override {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (scene.bodies[i].joint != Joint::revolute || index(scene.bodies[i].parent + 1) != i)
        return "KDL computes the dynamics of chains of one-dof joints alone";
    return {};
  }
  bool has(Algorithm algorithm) const override { return algorithm <= Algorithm::kinematics; }

  void load_mechanism(const Scene& mechanism) override {
    scene_ = mechanism;
    chain_ = KDL::Chain();
    for (const Body& b : mechanism.bodies) {
      const Eigen::Matrix3d& R = b.rotation;
      const KDL::Frame at(KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2),
                                        R(2, 0), R(2, 1), R(2, 2)),
                          vector_of(b.position));
      const auto& [xx, yy, zz, xy, xz, yz] = b.inertia;
      const KDL::Joint joint(at.p, at.M * vector_of(axis_of(b)), KDL::Joint::RotAxis);
      const KDL::RigidBodyInertia inertia(b.mass, vector_of(b.com),
                                          KDL::RotationalInertia(xx, yy, zz, xy, xz, yz));
      chain_.addSegment(KDL::Segment(joint, at, inertia));
    }
    const KDL::Vector gravity = vector_of(mechanism.gravity);
    forward_ = std::make_unique<KDL::ChainFdSolver_RNE>(chain_, gravity);
    inverse_ = std::make_unique<KDL::ChainIdSolver_RNE>(chain_, gravity);
    mass_ = std::make_unique<KDL::ChainDynParam>(chain_, gravity);
    kinematics_ = std::make_unique<KDL::ChainFkSolverVel_recursive>(chain_);
    frames_.resize(chain_.getNrOfSegments());
    wrenches_.assign(frames_.size(), KDL::Wrench::Zero());
    out_.resize(chain_.getNrOfJoints());
    M_.resize(chain_.getNrOfJoints());
  }
  std::vector<double> qdd(std::size_t k) override {
    return answer(Algorithm::forward_dynamics, converted_[k]);
  }
  std::vector<double> tau(std::size_t k) override {
    return answer(Algorithm::inverse_dynamics, converted_[k]);
  }

 protected:
  KdlState convert(const Situation& s) const override {
    const auto joints = [](const std::vector<double>& of) {
      KDL::JntArray to(static_cast<unsigned>(of.size()));
      std::copy(of.begin(), of.end(), to.data.data());
      return to;
    };
    return {joints(s.q), joints(s.v), joints(s.tau), joints(s.qdd)};
  }
  void run_one(Algorithm algorithm, const KdlState& s) override {
    if (algorithm == Algorithm::forward_dynamics)
      forward_->CartToJnt(s.q, s.v, s.tau, wrenches_, out_);
    else if (algorithm == Algorithm::inverse_dynamics)
      inverse_->CartToJnt(s.q, s.v, s.qdd, wrenches_, out_);
    else if (algorithm == Algorithm::mass_matrix)
      mass_->JntToMass(s.q, M_);
    else if (algorithm == Algorithm::kinematics)
      kinematics_->JntToCart({s.q, s.v}, frames_);
  }

 private:
  std::vector<double> answer(Algorithm algorithm, const KdlState& s) {
    run_one(algorithm, s);
    return {out_.data.data(), out_.data.data() + out_.data.size()};
  }

  KDL::Chain chain_;
  std::unique_ptr<KDL::ChainFdSolver_RNE> forward_;
  std::unique_ptr<KDL::ChainIdSolver_RNE> inverse_;
  std::unique_ptr<KDL::ChainDynParam> mass_;
  std::unique_ptr<KDL::ChainFkSolverVel_recursive> kinematics_;
  std::vector<KDL::FrameVel> frames_;
  KDL::Wrenches wrenches_;
  KDL::JntArray out_;
  KDL::JntSpaceInertiaMatrix M_;
};

}  // namespace

EngineKind kdl_engine() {
  return {"kdl", 6, one_engine<Kdl>};
}

}  // namespace twinarm::bench
