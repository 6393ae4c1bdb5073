// DART's World, with its own collision detector (the default one makes spheres of triangles), all
// else as it comes: semi-implicit Euler, contacts by Dantzig's method.
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

#include <cmath>
#include <iostream>

#include "benchmarks/peers/peer.h"

namespace twinarm::peers {
namespace {

namespace dd = dart::dynamics;
using dart::constraint::ContactConstraint;

Eigen::Vector3d eigen(const Numbers3& v) {
  return Eigen::Vector3d(v.data());
}
Eigen::Matrix3d rotation(const double* q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}
void write_quaternion(const Eigen::Matrix3d& R, double* q) {
  const Eigen::Quaterniond turn(R);
  q[0] = turn.w(), q[1] = turn.x(), q[2] = turn.y(), q[3] = turn.z();
}

// DART tells of names that it changes, and on stdout, where the answer goes.
class SaidOnStderr {
 public:
  SaidOnStderr() : out_(std::cout.rdbuf(std::cerr.rdbuf())) {}
  ~SaidOnStderr() { std::cout.rdbuf(out_); }
  SaidOnStderr(const SaidOnStderr&) = delete;
  SaidOnStderr& operator=(const SaidOnStderr&) = delete;

 private:
  std::streambuf* out_;
};

class Dart final : public FixedStepPeer {
 public:
  std::string name() const override { return "dart"; }
  std::vector<Scheme> schemes(const Scene&) const override { return {{"semi-implicit"}}; }

  void load(const Scene& scene, const Scheme&, double h) override {
    const SaidOnStderr quiet;
    begin(h);
    scene_ = scene;
    static const double its_own = ContactConstraint::getErrorReductionParameter();
    ContactConstraint::setErrorReductionParameter(scene.uncorrected ? 0 : its_own);
    world_ = std::make_shared<dart::simulation::World>();
    world_->setGravity(eigen(scene.gravity));
    world_->setTimeStep(h);
    world_->getConstraintSolver()->setCollisionDetector(
        dart::collision::DARTCollisionDetector::create());
    bodies_.clear();
    for (const Body& b : scene.bodies) bodies_.push_back(add(b));
    set_state();
    for (const dd::BodyNodePtr& body : bodies_)
      if (body->getParentBodyNode() == nullptr) world_->addSkeleton(body->getSkeleton());
    if (scene.floor) add_floor();
  }
  void step() override {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (scene_.bodies[i].push != Numbers3{})
        bodies_[i]->setExtForce(eigen(scene_.bodies[i].push));
    world_->step();
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q.resize(scene_.q.size()), v.resize(scene_.v.size());
    double *at = q.data(), *rate = v.data();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const dd::Joint* joint = bodies_[i]->getParentJoint();
      const Eigen::VectorXd p = joint->getPositions(), u = joint->getVelocities();
      const Joint type = scene_.bodies[i].joint;
      if (type == Joint::hinge) {
        at[0] = p[0], rate[0] = u[0];
      } else if (type == Joint::ball) {
        write_quaternion(dd::BallJoint::convertToRotation(p), at);
        Eigen::Vector3d::Map(rate) = u;
      } else {  // its velocities are a twist in body axes
        const Eigen::Isometry3d X = dd::FreeJoint::convertToTransform(p);
        Eigen::Vector3d::Map(at) = X.translation();
        write_quaternion(X.linear(), at + 3);
        Eigen::Vector3d::Map(rate) = u.head<3>();
        Eigen::Vector3d::Map(rate + 3) = X.linear() * u.tail<3>();
      }
      at += coordinates_of(type), rate += velocities_of(type);
    }
  }

 private:
  template <class JointType>
  dd::BodyNode* make(const dd::SkeletonPtr& skeleton, dd::BodyNode* parent,
                     typename JointType::Properties properties) {
    const std::string number = std::to_string(bodies_.size());  // or it renames them, and tells
    properties.mName = "joint " + number;
    const dd::BodyNode::AspectProperties named("body " + number);
    return skeleton->createJointAndBodyNodePair<JointType>(parent, properties, named).second;
  }
  dd::BodyNodePtr add(const Body& b) {
    dd::BodyNode* parent =
        b.parent < 0 ? nullptr : bodies_[static_cast<std::size_t>(b.parent)].get();
    const dd::SkeletonPtr skeleton =
        parent ? parent->getSkeleton()
               : dd::Skeleton::create("of " + std::to_string(bodies_.size()));
    dd::Joint::Properties placed;
    placed.mT_ParentBodyToJoint.linear() = rotation(b.turn.data());
    placed.mT_ParentBodyToJoint.translation() = eigen(b.position);
    dd::BodyNode* body = nullptr;
    if (b.joint == Joint::hinge) {
      dd::RevoluteJoint::Properties hinge;
      hinge.mAxis = Eigen::Vector3d::UnitZ();
      hinge.mT_ParentBodyToJoint = placed.mT_ParentBodyToJoint;
      body = make<dd::RevoluteJoint>(skeleton, parent, hinge);
    } else if (b.joint == Joint::ball) {
      dd::BallJoint::Properties ball;
      ball.mT_ParentBodyToJoint = placed.mT_ParentBodyToJoint;
      body = make<dd::BallJoint>(skeleton, parent, ball);
    } else {
      body = make<dd::FreeJoint>(skeleton, parent, {});
    }
    const auto& [xx, yy, zz, xy, xz, yz] = b.inertia;
    body->setInertia(dd::Inertia(b.mass, b.com[0], b.com[1], b.com[2], xx, yy, zz, xy, xz, yz));
    if (b.form == Form::sphere)
      add_shape(body, std::make_shared<dd::SphereShape>(b.half[0]), scene_.friction);
    if (b.form == Form::box)
      add_shape(body, std::make_shared<dd::BoxShape>(2 * eigen(b.half)), scene_.friction);
    return body;
  }
  // A pair takes the smaller friction and the product of the restitutions.
  void add_shape(dd::BodyNode* body, const dd::ShapePtr& shape, double friction) const {
    auto* node = body->createShapeNodeWith<dd::CollisionAspect, dd::DynamicsAspect>(shape);
    node->getDynamicsAspect()->setFrictionCoeff(friction);
    node->getDynamicsAspect()->setRestitutionCoeff(std::sqrt(scene_.restitution));
  }
  // Its detector knows no half-space: a large box.
  void add_floor() {
    const dd::SkeletonPtr floor = dd::Skeleton::create("floor");
    dd::WeldJoint::Properties below;
    below.mT_ParentBodyToJoint.translation() = Eigen::Vector3d(0, 0, -1);
    add_shape(make<dd::WeldJoint>(floor, nullptr, below),
              std::make_shared<dd::BoxShape>(Eigen::Vector3d(200, 200, 2)), scene_.floor_friction);
    world_->addSkeleton(floor);
  }
  void set_state() {
    const double *q = scene_.q.data(), *v = scene_.v.data();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      dd::Joint* joint = bodies_[i]->getParentJoint();
      const Joint type = scene_.bodies[i].joint;
      if (type == Joint::hinge) {
        joint->setPosition(0, q[0]), joint->setVelocity(0, v[0]);
      } else if (type == Joint::ball) {
        joint->setPositions(dd::BallJoint::convertToPositions(rotation(q)));
        joint->setVelocities(Eigen::Vector3d(v));
      } else {
        Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
        X.linear() = rotation(q + 3);
        X.translation() = Eigen::Vector3d(q);
        joint->setPositions(dd::FreeJoint::convertToPositions(X));
        Eigen::Matrix<double, 6, 1> twist;
        twist << Eigen::Vector3d(v), X.linear().transpose() * Eigen::Vector3d(v + 3);
        joint->setVelocities(twist);
      }
      q += coordinates_of(type), v += velocities_of(type);
    }
  }

  Scene scene_;
  dart::simulation::WorldPtr world_;
  std::vector<dd::BodyNodePtr> bodies_;  // each keeps its skeleton alive
};

}  // namespace

void add_dart(Peers& peers) {
  peers.push_back(std::make_unique<Dart>());
}

}  // namespace twinarm::peers
