// Bullet's btMultiBodyDynamicsWorld, in double: what hangs on joints is one btMultiBody, free
// bodies are btRigidBodies; contacts by sequential impulses, ten iterations, all else as it comes
// but damping and sleep, which are off.
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/peers/peer.h"

namespace twinarm::peers {
namespace {

btVector3 bt3(const Numbers3& v) {
  return {v[0], v[1], v[2]};
}
btQuaternion bt4(const double* q) {
  return {q[1], q[2], q[3], q[0]};
}
void write(const btQuaternion& turn, double* q) {
  q[0] = turn.w(), q[1] = turn.x(), q[2] = turn.y(), q[3] = turn.z();
}
bool all_free(const Scene& scene) {
  return std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& b) { return b.joint == Joint::free; });
}

bool has_boxes(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& b) { return b.form == Form::box; });
}

// Members are destroyed from the last to the first: bodies after the world.
struct BulletWorld {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broad_phase;
  btMultiBodyConstraintSolver tree_solver;
  btSequentialImpulseConstraintSolver solver;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::unique_ptr<btCollisionObject> floor;
  std::unique_ptr<btMultiBody> tree;
  btMultiBodyDynamicsWorld tree_world{&dispatcher, &broad_phase, &tree_solver, &configuration};
  btDiscreteDynamicsWorld free_world{&dispatcher, &broad_phase, &solver, &configuration};
  btDiscreteDynamicsWorld& world;

  explicit BulletWorld(const Scene& scene)
      : world(all_free(scene) ? free_world : static_cast<btDiscreteDynamicsWorld&>(tree_world)) {
    world.setGravity(bt3(scene.gravity));
    if (scene.uncorrected) world.getSolverInfo().m_erp = world.getSolverInfo().m_erp2 = 0;
    if (all_free(scene))
      for (const Body& b : scene.bodies) add(scene, b);
    else
      make_tree(scene);
    if (!scene.floor) return;
    floor = std::make_unique<btCollisionObject>();
    if (has_boxes(
            scene)) {  // a half-space finds one corner of a box in a step, and loses the others
      shapes.push_back(std::make_unique<btBoxShape>(btVector3(100, 100, 1)));
      floor->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, -1)));
    } else {
      shapes.push_back(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0));
    }
    floor->setCollisionShape(shapes.back().get());
    floor->setFriction(scene.friction > 0 ? scene.floor_friction / std::sqrt(scene.friction) : 0);
    floor->setRestitution(std::sqrt(scene.restitution));
    world.addCollisionObject(floor.get(), btBroadphaseProxy::StaticFilter,
                             btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
  }
  ~BulletWorld() {
    if (tree) tree_world.removeMultiBody(tree.get());
    while (world.getNumCollisionObjects() > 0)
      world.removeCollisionObject(world.getCollisionObjectArray()[0]);
  }

  // A pair takes the products of the frictions and of the restitutions.
  void add(const Scene& scene, const Body& b) {
    btCollisionShape* shape = nullptr;
    if (b.form == Form::box)
      shape = shapes.emplace_back(std::make_unique<btBoxShape>(bt3(b.half))).get();
    else  // without a form it meets nothing
      shape = shapes
                  .emplace_back(std::make_unique<btSphereShape>(
                      b.form == Form::sphere ? b.half[0] : btScalar(0.1)))
                  .get();
    btRigidBody& body = *bodies.emplace_back(std::make_unique<btRigidBody>(
        b.mass, nullptr, shape, btVector3(b.inertia[0], b.inertia[1], b.inertia[2])));
    body.setFriction(std::sqrt(scene.friction));
    body.setRestitution(std::sqrt(scene.restitution));
    body.setDamping(0, 0);
    body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);
  }
  void make_tree(const Scene& scene) {
    tree = std::make_unique<btMultiBody>(static_cast<int>(scene.bodies.size()), 0,
                                         btVector3(0, 0, 0), true, false);
    int i = 0;
    for (const Body& b : scene.bodies) {
      const btVector3 inertia(b.inertia[0], b.inertia[1], b.inertia[2]), com = bt3(b.com);
      const btVector3 from_com =
          bt3(b.position) - (b.parent < 0
                                 ? btVector3(0, 0, 0)
                                 : bt3(scene.bodies[static_cast<std::size_t>(b.parent)].com));
      const btQuaternion to_this = bt4(b.turn.data()).inverse();
      if (b.joint == Joint::hinge)
        tree->setupRevolute(i++, b.mass, inertia, b.parent, to_this, {0, 0, 1}, from_com, com);
      else
        tree->setupSpherical(i++, b.mass, inertia, b.parent, to_this, from_com, com);
    }
    tree->finalizeMultiDof();
    tree->setLinearDamping(0);
    tree->setAngularDamping(0);
    tree->setMaxCoordinateVelocity(1e30);  // it would be clipped at 100
    tree->setCanSleep(false);
    tree_world.addMultiBody(tree.get());
  }
};

class Bullet final : public FixedStepPeer {
 public:
  std::string name() const override { return "bullet"; }
  std::vector<Scheme> schemes(const Scene& scene) const override {
    if (!refusal(scene).empty()) return {};
    if (all_free(scene)) return {{"semi-implicit"}};
    return {{"semi-implicit"}, {"RK4"}};
  }
  std::string refusal(const Scene& scene) const override {
    const bool diagonal = std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
      const double rest = std::abs(b.inertia[3]) + std::abs(b.inertia[4]) + std::abs(b.inertia[5]);
      return rest <= 1e-12 * (b.inertia[0] + b.inertia[1] + b.inertia[2]);
    });
    return diagonal ? "" : "Bullet wants bodies in the principal axes of their inertias";
  }

  void load(const Scene& scene, const Scheme& scheme, double h) override {
    begin(h);
    scene_ = scene;
    world_.reset();
    world_ = std::make_unique<BulletWorld>(scene);
    const double *q = scene.q.data(), *v = scene.v.data();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Joint joint = scene.bodies[i].joint;
      const int link = static_cast<int>(i);
      if (joint == Joint::hinge) {
        world_->tree->setJointPosMultiDof(link, q), world_->tree->setJointVelMultiDof(link, v);
      } else if (joint == Joint::ball) {
        const double turn[] = {q[1], q[2], q[3], q[0]};
        world_->tree->setJointPosMultiDof(link, turn), world_->tree->setJointVelMultiDof(link, v);
      } else {
        const btQuaternion turn = bt4(q + 3);
        btRigidBody& body = *world_->bodies[i];
        body.setCenterOfMassTransform(btTransform(turn, btVector3(q[0], q[1], q[2])));
        body.setAngularVelocity(quatRotate(turn, btVector3(v[0], v[1], v[2])));
        body.setLinearVelocity(btVector3(v[3], v[4], v[5]));
      }
      q += coordinates_of(joint), v += velocities_of(joint);
    }
    if (world_->tree) {
      world_->tree->useRK4Integration(scheme.name == "RK4");
      btAlignedObjectArray<btQuaternion> turns;
      btAlignedObjectArray<btVector3> places;
      world_->tree->forwardKinematics(turns, places);
    }
  }
  void step() override {
    for (std::size_t i = 0; i < world_->bodies.size(); ++i)
      if (scene_.bodies[i].push != Numbers3{})
        world_->bodies[i]->applyCentralForce(bt3(scene_.bodies[i].push));
    world_->world.stepSimulation(h_, 0);  // one step of that length
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q.resize(scene_.q.size()), v.resize(scene_.v.size());
    double *at = q.data(), *rate = v.data();
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const Joint joint = scene_.bodies[i].joint;
      if (joint == Joint::free) {
        const btTransform& X = world_->bodies[i]->getCenterOfMassTransform();
        const btQuaternion turn = X.getRotation();
        const btVector3 w = quatRotate(turn.inverse(), world_->bodies[i]->getAngularVelocity());
        for (int k = 0; k < 3; ++k) {
          at[k] = X.getOrigin()[k], rate[k] = w[k];
          rate[3 + k] = world_->bodies[i]->getLinearVelocity()[k];
        }
        write(turn, at + 3);
      } else {
        const int link = static_cast<int>(i);
        const btScalar* p = world_->tree->getJointPosMultiDof(link);
        if (joint == Joint::hinge)
          at[0] = p[0];
        else
          write(btQuaternion(p[0], p[1], p[2], p[3]), at);
        std::copy_n(world_->tree->getJointVelMultiDof(link), velocities_of(joint), rate);
      }
      at += coordinates_of(joint), rate += velocities_of(joint);
    }
  }

 private:
  Scene scene_;
  std::unique_ptr<BulletWorld> world_;
};

}  // namespace

void add_bullet(Peers& peers) {
  peers.push_back(std::make_unique<Bullet>());
}

}  // namespace twinarm::peers
