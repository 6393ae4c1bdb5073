// A scene in Bullet: a tree of bodies, and a world with all bodies and shapes. btScalar is double
// or float.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletCollisionCommon.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "benchmarks/scenes/scene.h"

namespace twinarm::bench {

inline btScalar bt(double x) {
  return static_cast<btScalar>(x);
}
inline btVector3 bt(const Vector3d& v) {
  return {bt(v.x()), bt(v.y()), bt(v.z())};
}
inline btQuaternion bt(const Eigen::Quaterniond& q) {
  return {bt(q.x()), bt(q.y()), bt(q.z()), bt(q.w())};
}

inline bool all_free(const Scene& scene) {
  return std::ranges::count(scene.bodies, Joint::free, &Body::joint) == std::ssize(scene.bodies);
}

// Bullet requires body frames at the com along the principal axes of inertia.
struct Principal {
  Vector3d moments;
  Eigen::Matrix3d R_BP = Eigen::Matrix3d::Identity();  // principal axes to body axes
  explicit Principal(const Body& body) {
    const Eigen::Matrix3d I = inertia3(body.inertia);
    moments = I.diagonal();
    if (I.isDiagonal()) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(I);
    moments = eigen.eigenvalues();
    R_BP = eigen.eigenvectors();
    if (R_BP.determinant() < 0) R_BP.col(0) *= -1;
  }
};

// All bodies on joints; the first body is free or jointed to the world.
inline std::unique_ptr<btMultiBody> make_tree(const Scene& scene,
                                              const std::vector<Principal>& frames) {
  const bool floats = scene.floats();
  const int first = floats ? 1 : 0;
  auto tree = std::make_unique<btMultiBody>(
      static_cast<int>(scene.bodies.size()) - first, bt(floats ? scene.bodies[0].mass : 0),
      floats ? bt(frames[0].moments) : btVector3(0, 0, 0), !floats, false);
  for (int i = first; i < static_cast<int>(scene.bodies.size()); ++i) {
    const Body& b = scene.bodies[index(i)];
    const Principal& frame = frames[index(i)];
    Eigen::Matrix3d R_PPr = Eigen::Matrix3d::Identity();  // parent axes to principal axes
    Vector3d parent_com = Vector3d::Zero();
    if (b.parent >= 0) {
      R_PPr = frames[index(b.parent)].R_BP.transpose();
      parent_com = scene.bodies[index(b.parent)].com;
    }
    const Eigen::Matrix3d R = R_PPr * b.rotation * frame.R_BP;
    const btQuaternion to_this = bt(Eigen::Quaterniond(R.transpose()));
    const btVector3 from_com = bt(R_PPr * (b.position - parent_com));
    const btVector3 com = bt(frame.R_BP.transpose() * b.com);
    if (b.joint == Joint::revolute)
      tree->setupRevolute(i - first, bt(b.mass), bt(frame.moments), b.parent - first, to_this,
                          bt(frame.R_BP.transpose() * axis_of(b)), from_com, com, true);
    else
      tree->setupSpherical(i - first, bt(b.mass), bt(frame.moments), b.parent - first, to_this,
                           from_com, com, true);
  }
  tree->finalizeMultiDof();
  tree->setLinearDamping(0);
  tree->setAngularDamping(0);
  tree->setUseGyroTerm(true);
  tree->setMaxCoordinateVelocity(bt(1e30));  // the default clips at 100
  tree->setCanSleep(false);
  return tree;
}

// Members are destroyed in reverse order: bodies after the world.
struct BulletWorld {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broad_phase;
  btMultiBodyConstraintSolver tree_solver;
  btSequentialImpulseConstraintSolver solver;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btCollisionObject>> fixed;
  std::unique_ptr<btMultiBody> tree;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders;
  btMultiBodyDynamicsWorld tree_world{&dispatcher, &broad_phase, &tree_solver, &configuration};
  btDiscreteDynamicsWorld free_world{&dispatcher, &broad_phase, &solver, &configuration};
  btDiscreteDynamicsWorld& world;

  explicit BulletWorld(const Scene& scene)
      : world(all_free(scene) ? free_world : static_cast<btDiscreteDynamicsWorld&>(tree_world)) {
    world.setGravity(bt(scene.gravity));
    if (scene.uncorrected) world.getSolverInfo().m_erp = world.getSolverInfo().m_erp2 = 0;
    if (all_free(scene))
      for (const Body& b : scene.bodies) add(scene, b);
    else
      add_tree(scene);
    if (scene.floor) add_floor(scene);
    for (const Scene::FixedBox& box : scene.fixed_boxes)
      add_fixed(std::make_unique<btBoxShape>(bt(box.half)), bt(box.centre),
                std::sqrt(scene.friction), scene.restitution);
  }
  ~BulletWorld() {
    if (tree) tree_world.removeMultiBody(tree.get());
    while (world.getNumCollisionObjects() > 0)
      world.removeCollisionObject(world.getCollisionObjectArray()[0]);
  }

  // Double precision: a large box as the floor below boxes, as a half-space finds only one corner
  // of a box per step. Single precision is too coarse for that.
  void add_floor(const Scene& scene) {
    const double friction =
        scene.friction > 0 ? scene.floor_friction / std::sqrt(scene.friction) : 0;
    if (std::ranges::count(scene.bodies, Form::box, &Body::form) > 0 &&
        sizeof(btScalar) == sizeof(double))
      add_fixed(std::make_unique<btBoxShape>(btVector3(100, 100, 1)), btVector3(0, 0, -1), friction,
                scene.restitution);
    else
      add_fixed(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), bt(0)), btVector3(0, 0, 0),
                friction, scene.restitution);
  }
  void add_fixed(std::unique_ptr<btCollisionShape> shape, const btVector3& position,
                 double friction, double restitution) {
    btCollisionObject& object = *fixed.emplace_back(std::make_unique<btCollisionObject>());
    object.setWorldTransform(btTransform(btQuaternion::getIdentity(), position));
    object.setCollisionShape(shapes.emplace_back(std::move(shape)).get());
    object.setFriction(bt(friction));
    object.setRestitution(bt(std::sqrt(restitution)));
    world.addCollisionObject(&object, btBroadphaseProxy::StaticFilter,
                             btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
  }
  btCollisionShape* shape_of(const Body& b) {
    std::unique_ptr<btCollisionShape> shape;
    if (b.form == Form::box)
      shape = std::make_unique<btBoxShape>(bt(b.half));
    else  // without a shape it does not collide
      shape = std::make_unique<btSphereShape>(b.form == Form::sphere ? bt(b.half[0]) : bt(0.1));
    return shapes.emplace_back(std::move(shape)).get();
  }

  // Friction and restitution of a pair are products.
  void add(const Scene& scene, const Body& b) {
    btRigidBody& body = *bodies.emplace_back(std::make_unique<btRigidBody>(
        bt(b.mass), nullptr, shape_of(b),
        btVector3(bt(b.inertia[0]), bt(b.inertia[1]), bt(b.inertia[2]))));
    body.setFriction(bt(std::sqrt(scene.friction)));
    body.setRestitution(bt(std::sqrt(scene.restitution)));
    body.setDamping(0, 0);
    body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);
  }
  void add_tree(const Scene& scene) {
    tree = make_tree(scene, {scene.bodies.begin(), scene.bodies.end()});
    tree_world.addMultiBody(tree.get());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (scene.bodies[i].form != Form::none)
        add_collider(scene, scene.bodies[i], static_cast<int>(i));
  }
  // The shape of a link is placed relative to its com.
  void add_collider(const Scene& scene, const Body& b, int link) {
    auto compound = std::make_unique<btCompoundShape>();
    compound->addChildShape(btTransform(btQuaternion::getIdentity(), bt(b.form_at) - bt(b.com)),
                            shape_of(b));
    auto& collider =
        *colliders.emplace_back(std::make_unique<btMultiBodyLinkCollider>(tree.get(), link));
    collider.setCollisionShape(shapes.emplace_back(std::move(compound)).get());
    collider.setFriction(bt(std::sqrt(scene.friction)));
    collider.setActivationState(DISABLE_DEACTIVATION);
    tree->getLink(link).m_collider = &collider;
    update_transforms();
    tree_world.addCollisionObject(&collider, btBroadphaseProxy::DefaultFilter,
                                  btBroadphaseProxy::AllFilter);
  }
  void update_transforms() const {
    btAlignedObjectArray<btQuaternion> rotations;
    btAlignedObjectArray<btVector3> positions;
    tree->forwardKinematics(rotations, positions);
    if (!colliders.empty()) tree->updateCollisionObjectWorldTransforms(rotations, positions);
  }
};

}  // namespace twinarm::bench
