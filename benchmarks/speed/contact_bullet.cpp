// Bullet's contact scenes, in single precision, which is what it is mostly built for: sequential
// impulses, ten iterations, all else as it comes; bodies at rest are not put to sleep. The arm is a
// btMultiBody. (bench_speed has the library in double; the two do not go into one program.)
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletCollisionCommon.h>

#include <cmath>

#include "benchmarks/speed/contact_engine.h"

namespace twinarm::speed {
namespace {

btScalar bt(double x) {
  return static_cast<btScalar>(x);
}
btVector3 bt(const Numbers3& v) {
  return {bt(v[0]), bt(v[1]), bt(v[2])};
}
// A pair takes the product of the frictions.
const btScalar surface_friction = bt(std::sqrt(contact_friction));

// The world of one run. Members are destroyed from the last to the first: bodies after the world.
struct BulletRun {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broad_phase;
  btMultiBodyConstraintSolver solver;  // for rigid bodies the sequential impulses it is built on
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> boxes;
  std::unique_ptr<btMultiBody> arm;
  std::unique_ptr<btCollisionObject> fixed;
  std::unique_ptr<btMultiBodyLinkCollider> tip;
  std::unique_ptr<btSequentialImpulseConstraintSolver> plain_solver;
  std::unique_ptr<btDiscreteDynamicsWorld> world;

  explicit BulletRun(const ContactScene& scene) {
    if (scene.has_arm())
      make_arm();
    else
      make_boxes(scene);
    fixed->setFriction(surface_friction);
    world->setGravity({0, 0, bt(-standard_gravity)});
  }
  ~BulletRun() {
    while (world->getNumCollisionObjects() > 0)
      world->removeCollisionObject(world->getCollisionObjectArray()[0]);
  }

  void make_boxes(const ContactScene& scene) {
    plain_solver = std::make_unique<btSequentialImpulseConstraintSolver>();
    world = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, &broad_phase, plain_solver.get(),
                                                      &configuration);
    add_fixed(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), bt(0)), {0, 0, 0});
    const btScalar half = bt(box_edge / 2);
    btCollisionShape* shape =
        shapes.emplace_back(std::make_unique<btBoxShape>(btVector3(half, half, half))).get();
    btVector3 inertia;
    shape->calculateLocalInertia(bt(box_mass), inertia);
    for (const Numbers3& centre : scene.boxes) {
      btRigidBody& box =
          *boxes.emplace_back(std::make_unique<btRigidBody>(bt(box_mass), nullptr, shape, inertia));
      box.setWorldTransform(btTransform(btQuaternion::getIdentity(), bt(centre)));
      box.setFriction(surface_friction);
      box.setActivationState(DISABLE_DEACTIVATION);
      world->addRigidBody(&box);
    }
  }

  // The inertias of scara3 are diagonal, its axes along z, its links not turned.
  void make_arm() {
    auto multi = std::make_unique<btMultiBodyDynamicsWorld>(&dispatcher, &broad_phase, &solver,
                                                            &configuration);
    const Mechanism scara = scara3();
    const Push push;
    arm = std::make_unique<btMultiBody>(3, bt(0), btVector3(0, 0, 0), true, false);
    btVector3 parent_com(0, 0, 0);
    for (int i = 0; i < 3; ++i) {
      const Link& link = scara.links[static_cast<std::size_t>(i)];
      const Numbers9& I = link.inertia;
      arm->setupRevolute(i, bt(link.mass), {bt(I[0]), bt(I[4]), bt(I[8])}, link.parent,
                         btQuaternion::getIdentity(), {0, 0, 1}, bt(link.position) - parent_com,
                         bt(link.com), true);
      parent_com = bt(link.com);
    }
    arm->finalizeMultiDof();
    arm->setLinearDamping(0);
    arm->setAngularDamping(0);
    arm->setCanSleep(false);
    multi->addMultiBody(arm.get());

    // its shape stands about the link's com
    btCollisionShape* ball =
        shapes.emplace_back(std::make_unique<btSphereShape>(bt(push.radius))).get();
    auto compound = std::make_unique<btCompoundShape>();
    compound->addChildShape(
        btTransform(btQuaternion::getIdentity(), bt(push.tip) - bt(scara.links[2].com)), ball);
    tip = std::make_unique<btMultiBodyLinkCollider>(arm.get(), 2);
    tip->setCollisionShape(shapes.emplace_back(std::move(compound)).get());
    tip->setFriction(surface_friction);
    tip->setActivationState(DISABLE_DEACTIVATION);
    arm->getLink(2).m_collider = tip.get();
    btAlignedObjectArray<btQuaternion> turns;
    btAlignedObjectArray<btVector3> places;
    arm->forwardKinematics(turns, places);
    arm->updateCollisionObjectWorldTransforms(turns, places);
    multi->addCollisionObject(tip.get(), btBroadphaseProxy::DefaultFilter,
                              btBroadphaseProxy::AllFilter);
    world = std::move(multi);
    const btScalar half = bt(box_edge / 2);
    add_fixed(std::make_unique<btBoxShape>(btVector3(half, half, half)), push.obstacle);
  }

  void add_fixed(std::unique_ptr<btCollisionShape> shape, const Numbers3& position) {
    fixed = std::make_unique<btCollisionObject>();
    fixed->setCollisionShape(shapes.emplace_back(std::move(shape)).get());
    fixed->setWorldTransform(btTransform(btQuaternion::getIdentity(), bt(position)));
    world->addCollisionObject(fixed.get(), btBroadphaseProxy::StaticFilter,
                              btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
  }
};

class Bullet final : public ContactEngine {
 public:
  std::string name() const override { return "bullet"; }
  void load(const ContactScene& scene) override {
    scene_ = scene;
    run_ = std::make_unique<BulletRun>(scene);
  }
  void step() override {
    if (scene_.has_arm())
      for (int j = 0; j < 3; ++j)
        run_->arm->addJointTorque(
            j, bt(push_.torque(static_cast<std::size_t>(j), run_->arm->getJointPos(j),
                               run_->arm->getJointVel(j))));
    run_->world->stepSimulation(bt(scene_.h), 0);  // one step of that length
  }
  std::vector<Placed> bodies() const override {
    if (scene_.has_arm()) {
      const btTransform& X = run_->tip->getWorldTransform();
      const btVector3 p = X * (bt(push_.tip) - bt(scara3().links[2].com));
      return {{{p.x(), p.y(), p.z()}, {1, 0, 0, 0}}};
    }
    std::vector<Placed> all;
    for (const auto& box : run_->boxes) {
      const btVector3& p = box->getWorldTransform().getOrigin();
      const btQuaternion q = box->getWorldTransform().getRotation();
      all.push_back({{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}});
    }
    return all;
  }

 private:
  ContactScene scene_;
  Push push_;
  std::unique_ptr<BulletRun> run_;
};

}  // namespace

void add_bullet(ContactEngines& engines) {
  engines.push_back(std::make_unique<Bullet>());
}

}  // namespace twinarm::speed
