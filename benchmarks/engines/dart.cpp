// DART.
//
// header: dart/dynamics/Skeleton.hpp
// libraries: dart
//
// Scenes: World with DART's own collision detector (the default one approximates spheres by
// triangles), otherwise defaults: semi-implicit Euler, contacts by Dantzig's method. Algorithms: a
// step is that of World for a skeleton without contact: forward dynamics, velocities, positions.
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

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

namespace dd = dart::dynamics;
using dart::constraint::ContactConstraint;

// DART reports renamed bodies on stdout, which is reserved for the results.
class ReportsOnStderr {
 public:
  ReportsOnStderr() : out_(std::cout.rdbuf(std::cerr.rdbuf())) {}
  ~ReportsOnStderr() { std::cout.rdbuf(out_); }
  ReportsOnStderr(const ReportsOnStderr&) = delete;
  ReportsOnStderr& operator=(const ReportsOnStderr&) = delete;

 private:
  std::streambuf* out_;
};

// Situations in DART's coordinates: of the base the rotation vector and position; velocities,
// accelerations and forces are twists and wrenches in body axes, angular part first.
class Dart final : public PeerEngine<VectorState> {
 public:
  std::string name() const override { return "dart"; }
  std::vector<Scheme> schemes(const Scene&) const override { return {{"semi-implicit"}}; }

  void load(const Scene& scene, const Scheme&, double h) override {
    const ReportsOnStderr quiet;
    begin(scene, h);
    static const double its_own = ContactConstraint::getErrorReductionParameter();
    ContactConstraint::setErrorReductionParameter(scene.uncorrected ? 0 : its_own);
    world_ = std::make_shared<dart::simulation::World>();
    world_->setGravity(scene.gravity);
    world_->setTimeStep(h);
    world_->getConstraintSolver()->setCollisionDetector(
        dart::collision::DARTCollisionDetector::create());
    add_bodies();
    set_joints();
    for (const dd::BodyNodePtr& body : bodies_)
      if (body->getParentBodyNode() == nullptr) world_->addSkeleton(body->getSkeleton());
    if (scene.floor) add_floor();
  }
  void step() override {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (!scene_.bodies[i].push.isZero(0)) bodies_[i]->setExtForce(scene_.bodies[i].push);
    world_->step();
  }

  void load_mechanism(const Scene& mechanism) override {
    const ReportsOnStderr quiet;
    scene_ = mechanism;
    add_bodies();
    skeleton_ = bodies_[0]->getSkeleton();
    skeleton_->setGravity(mechanism.gravity);
    skeleton_->setTimeStep(step_length);
  }
  std::vector<double> qdd(std::size_t k) override {
    run_one(Algorithm::forward_dynamics, converted_[k]);
    Eigen::VectorXd a = skeleton_->getAccelerations();
    if (scene_.floats()) {  // (alpha; spatial acceleration of the origin), both in body axes
      const Base base(situations_[k]);
      const Vector3d v_B = base.R.conjugate() * base.v_W;
      a.segment<3>(3) = base.R * (a.segment<3>(3) + base.w_B.cross(v_B)).eval();
    }
    return {a.begin(), a.end()};
  }
  std::vector<double> tau(std::size_t k) override {
    run_one(Algorithm::inverse_dynamics, converted_[k]);
    const Eigen::VectorXd tau = skeleton_->getForces();
    return {tau.begin(), tau.end()};
  }

 private:
  template <class JointType>
  dd::BodyNode* make(const dd::SkeletonPtr& skeleton, dd::BodyNode* parent,
                     const Eigen::Isometry3d& placed,
                     typename JointType::Properties properties = typename JointType::Properties()) {
    const std::string number = std::to_string(bodies_.size());  // unique, otherwise DART renames it
    properties.mName = "joint " + number;
    properties.mT_ParentBodyToJoint = placed;
    const dd::BodyNode::AspectProperties named("body " + number);
    return skeleton->createJointAndBodyNodePair<JointType>(parent, properties, named).second;
  }
  void add_bodies() {
    bodies_.clear();
    for (const Body& b : scene_.bodies) bodies_.push_back(add(b));
  }
  dd::BodyNodePtr add(const Body& b) {
    dd::BodyNode* parent = b.parent < 0 ? nullptr : bodies_[index(b.parent)].get();
    const dd::SkeletonPtr skeleton =
        parent ? parent->getSkeleton()
               : dd::Skeleton::create("of " + std::to_string(bodies_.size()));
    Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
    placed.linear() = b.rotation;
    placed.translation() = b.position;
    dd::BodyNode* body = nullptr;
    if (b.joint == Joint::revolute) {
      dd::RevoluteJoint::Properties revolute;
      revolute.mAxis = axis_of(b);
      body = make<dd::RevoluteJoint>(skeleton, parent, placed, revolute);
    } else if (b.joint == Joint::spherical) {
      body = make<dd::BallJoint>(skeleton, parent, placed);
    } else {
      body = make<dd::FreeJoint>(skeleton, parent, Eigen::Isometry3d::Identity());
    }
    body->setInertia({b.mass, b.com, inertia3(b.inertia)});
    if (b.form == Form::sphere)
      add_shape(body, std::make_shared<dd::SphereShape>(b.half[0]), scene_.friction);
    if (b.form == Form::box)
      add_shape(body, std::make_shared<dd::BoxShape>(2 * b.half), scene_.friction);
    return body;
  }
  // Friction of a pair is the minimum, restitution the product.
  void add_shape(dd::BodyNode* body, const dd::ShapePtr& shape, double friction) const {
    auto* node = body->createShapeNodeWith<dd::CollisionAspect, dd::DynamicsAspect>(shape);
    node->getDynamicsAspect()->setFrictionCoeff(friction);
    node->getDynamicsAspect()->setRestitutionCoeff(std::sqrt(scene_.restitution));
  }
  // The detector has no half-space; a large box instead.
  void add_floor() {
    const dd::SkeletonPtr floor = dd::Skeleton::create("floor");
    const Eigen::Isometry3d below(Eigen::Translation3d(0, 0, -1));
    add_shape(make<dd::WeldJoint>(floor, nullptr, below),
              std::make_shared<dd::BoxShape>(Vector3d(200, 200, 2)), scene_.floor_friction);
    world_->addSkeleton(floor);
  }
  void set_joint(std::size_t i, const double* q, const double* v) override {
    dd::Joint* joint = bodies_[i]->getParentJoint();
    const Joint type = scene_.bodies[i].joint;
    if (type == Joint::revolute) {
      joint->setPosition(0, q[0]), joint->setVelocity(0, v[0]);
    } else if (type == Joint::spherical) {
      joint->setPositions(dd::BallJoint::convertToPositions(quaternion(q).toRotationMatrix()));
      joint->setVelocities(Vector3d(v));
    } else {
      joint->setPositions(free_positions(q));
      Eigen::Matrix<double, 6, 1> twist;
      twist << Vector3d(v), quaternion(q + 3).toRotationMatrix().transpose() * Vector3d(v + 3);
      joint->setVelocities(twist);
    }
  }
  void read_joint(std::size_t i, double* q, double* v) override {
    const dd::Joint* joint = bodies_[i]->getParentJoint();
    const Eigen::VectorXd p = joint->getPositions(), u = joint->getVelocities();
    const Joint type = scene_.bodies[i].joint;
    if (type == Joint::revolute) {
      q[0] = p[0], v[0] = u[0];
    } else if (type == Joint::spherical) {
      write_quaternion(Eigen::Quaterniond(dd::BallJoint::convertToRotation(p)), q);
      Vector3d::Map(v) = u;
    } else {  // velocities are a twist in body axes
      const Eigen::Isometry3d X = dd::FreeJoint::convertToTransform(p);
      Vector3d::Map(q) = X.translation();
      write_quaternion(Eigen::Quaterniond(X.linear()), q + 3);
      Vector3d::Map(v) = u.head<3>();
      Vector3d::Map(v + 3) = X.linear() * u.tail<3>();
    }
  }
  static Eigen::Matrix<double, 6, 1> free_positions(const double* q) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = quaternion(q + 3).toRotationMatrix();
    X.translation() = Vector3d(q);
    return dd::FreeJoint::convertToPositions(X);
  }

  VectorState convert(const Situation& s) const override {
    VectorState state(s);
    if (!scene_.floats()) return state;
    const Base base(s);
    const Eigen::Quaterniond R_BW = base.R.conjugate();
    const Eigen::VectorXd joints = state.q.tail(state.q.size() - 7);
    state.q.resize(joints.size() + 6);
    state.q << free_positions(s.q.data()), joints;
    const Vector3d v_B = R_BW * base.v_W;
    state.v.segment<3>(3) = v_B;
    state.tau.segment<3>(3) = R_BW * base.f_W;
    state.qdd.segment<3>(3) = R_BW * Vector3d(s.qdd.data() + 3) - base.w_B.cross(v_B);
    return state;
  }

  void run_one(Algorithm algorithm, const VectorState& state) override {
    skeleton_->setPositions(state.q);
    switch (algorithm) {
      case Algorithm::mass_matrix:
        skeleton_->getMassMatrix();
        return;
      case Algorithm::kinematics:  // computed on demand, up to the requested body
        for (const dd::BodyNode* body : bodies_) body->getWorldTransform();
        return;
      case Algorithm::inverse_dynamics:
        skeleton_->setVelocities(state.v);
        skeleton_->setAccelerations(state.qdd);
        skeleton_->computeInverseDynamics();
        return;
      default:  // forward dynamics, step
        skeleton_->setVelocities(state.v);
        skeleton_->setForces(state.tau);
        skeleton_->computeForwardDynamics();
        if (algorithm == Algorithm::forward_dynamics) return;
        skeleton_->integrateVelocities(step_length);
        skeleton_->integratePositions(step_length);
    }
  }

  dart::simulation::WorldPtr world_;
  std::vector<dd::BodyNodePtr> bodies_;  // each keeps its skeleton alive
  dd::SkeletonPtr skeleton_;             // of a mechanism
};

}  // namespace

EngineKind dart_engine() {
  return {"dart", 3, one_engine<Dart>};
}

}  // namespace twinarm::bench
