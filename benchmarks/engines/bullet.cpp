// Bullet.
//
// header: BulletDynamics/Featherstone/btMultiBody.h
// libraries: BulletDynamics-float64 BulletCollision-float64 LinearMath-float64
// single: BulletDynamics BulletCollision LinearMath
// options: -DBT_USE_DOUBLE_PRECISION
//
// Scenes: bodies on joints form one btMultiBody, free bodies are btRigidBodies; contacts by
// sequential impulses with ten iterations; damping and sleeping off, otherwise defaults.
// Algorithms: those of btMultiBody; inverse dynamics and mass matrix are in a separate library of
// Bullet, which is not used. Double precision; bench_contact uses single precision, its usual
// build (Debian has both).
#include "benchmarks/engines/bullet_world.h"
#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

// State and torques of the joints; of the base at the com, world axes.
struct BulletState {
  std::vector<btScalar> q, v, tau;
  btVector3 position, velocity, omega, force, torque;
  btQuaternion world_to_base;
};

class Bullet final : public PeerEngine<BulletState> {
 public:
  std::string name() const override { return "bullet"; }
  std::vector<Scheme> schemes(const Scene& scene) const override {
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
  std::vector<Scheme> contact_schemes(const Scene&) const override { return {{"semi-implicit"}}; }

  void load(const Scene& scene, const Scheme& scheme, double h) override {
    begin(scene, h);
    world_.reset();
    world_ = std::make_unique<BulletWorld>(scene);
    set_joints();
    if (!world_->tree) return;
    world_->tree->useRK4Integration(scheme.name == "RK4");
    world_->update_transforms();
  }
  void step() override {
    for (std::size_t i = 0; i < world_->bodies.size(); ++i)
      if (!scene_.bodies[i].push.isZero(0))
        world_->bodies[i]->applyCentralForce(bt(scene_.bodies[i].push));
    if (scene_.control)
      for (int j = 0; j < world_->tree->getNumLinks(); ++j)
        world_->tree->addJointTorque(
            j, bt(scene_.control->torque(index(j), world_->tree->getJointPos(j),
                                         world_->tree->getJointVel(j))));
    world_->world.stepSimulation(bt(h_), 0);  // one step of this length
  }

  bool has(Algorithm algorithm) const override {
    return PeerEngine::has(algorithm) && algorithm != Algorithm::inverse_dynamics &&
           algorithm != Algorithm::mass_matrix;
  }
  void load_mechanism(const Scene& mechanism) override {
    scene_ = mechanism;
    first_ = mechanism.floats() ? 1 : 0;
    frames_ = {mechanism.bodies.begin(), mechanism.bodies.end()};
    tree_ = make_tree(mechanism, frames_);
    // A Bullet world adds the weights before every step; they are constant, so they are added
    // once here.
    for (int i = 0; i < tree_->getNumLinks(); ++i)
      tree_->addLinkForce(i, weight(index(i) + first_));
  }
  // Bullet gives accelerations only as velocities after a step; hence a step of 1 s.
  std::vector<double> qdd(std::size_t k) override {
    set_position(converted_[k]);
    set_velocity(converted_[k]);
    accelerate(1);
    const btScalar* v = tree_->getVelocityVector();
    const Situation& s = situations_[k];
    std::vector<double> qdd;
    if (scene_.floats()) {
      // of the com, world axes; of the origin: a_O = a_C - alpha x c - w x (w x c)
      const Base base(s);
      const Vector3d w = base.R * base.w_B, c = base.R * scene_.bodies[0].com;
      const Vector3d alpha = Vector3d(v[0], v[1], v[2]) - w;
      const Vector3d v_C = base.v_W + w.cross(c);
      const Vector3d a_C = Vector3d(v[3], v[4], v[5]) - v_C;
      const Vector3d a = a_C - alpha.cross(c) - w.cross(w.cross(c));
      const Vector3d alpha_B = base.R.conjugate() * alpha;
      qdd = {alpha_B.x(), alpha_B.y(), alpha_B.z(), a.x(), a.y(), a.z()};
    }
    const std::size_t n = converted_[k].v.size();
    for (std::size_t j = 0; j < n; ++j) qdd.push_back(v[6 + j] - s.v[s.v.size() - n + j]);
    return qdd;
  }

 private:
  void set_joint(std::size_t i, const double* q, const double* v) override {
    const Joint joint = scene_.bodies[i].joint;
    if (joint == Joint::free) {
      const btQuaternion R = bt(quaternion(q + 3));
      btRigidBody& body = *world_->bodies[i];
      body.setCenterOfMassTransform(btTransform(R, {bt(q[0]), bt(q[1]), bt(q[2])}));
      body.setAngularVelocity(quatRotate(R, {bt(v[0]), bt(v[1]), bt(v[2])}));
      body.setLinearVelocity({bt(v[3]), bt(v[4]), bt(v[5])});
      return;
    }
    btScalar p[4] = {bt(q[0])}, rate[3] = {};
    if (joint == Joint::spherical)
      for (int k = 0; k < 4; ++k) p[k] = bt(q[(k + 1) % 4]);
    std::transform(v, v + velocities_of(joint), rate, [](double x) { return bt(x); });
    world_->tree->setJointPosMultiDof(static_cast<int>(i), p);
    world_->tree->setJointVelMultiDof(static_cast<int>(i), rate);
  }
  void read_joint(std::size_t i, double* q, double* v) override {
    const Joint joint = scene_.bodies[i].joint;
    if (joint == Joint::free) {
      const btRigidBody& body = *world_->bodies[i];
      const btTransform& X = body.getCenterOfMassTransform();
      const btVector3 w = quatRotate(X.getRotation().inverse(), body.getAngularVelocity());
      std::copy_n(&X.getOrigin()[0], 3, q), write_quaternion(X.getRotation(), q + 3);
      std::copy_n(&w[0], 3, v), std::copy_n(&body.getLinearVelocity()[0], 3, v + 3);
      return;
    }
    const btScalar* p = world_->tree->getJointPosMultiDof(static_cast<int>(i));
    if (joint == Joint::revolute)
      q[0] = p[0];
    else
      write_quaternion(btQuaternion(p[0], p[1], p[2], p[3]), q);
    std::copy_n(world_->tree->getJointVelMultiDof(static_cast<int>(i)), velocities_of(joint), v);
  }

  BulletState convert(const Situation& s) const override {
    const auto n = static_cast<std::ptrdiff_t>(scene_.bodies.size() - first_);
    BulletState state;
    state.q.assign(s.q.end() - n, s.q.end());
    state.v.assign(s.v.end() - n, s.v.end());
    state.tau.assign(s.tau.end() - n, s.tau.end());
    if (!scene_.floats()) return state;
    const Base base(s);
    const Vector3d w = base.R * base.w_B, c = base.R * scene_.bodies[0].com;
    state.position = bt(base.p + c), state.velocity = bt(base.v_W + w.cross(c));
    state.omega = bt(w);
    state.world_to_base = bt((base.R * Eigen::Quaterniond(frames_[0].R_BP)).conjugate());
    state.force = bt(base.f_W) + weight(0);
    state.torque = bt(base.R * base.t_B - c.cross(base.f_W));
    return state;
  }
  btVector3 weight(std::size_t i) const {
    return {0, 0, bt(-standard_gravity * scene_.bodies[i].mass)};
  }

  void set_position(const BulletState& s) {
    if (scene_.floats()) {
      tree_->setBasePos(s.position);
      tree_->setWorldToBaseRot(s.world_to_base);
    }
    for (std::size_t j = 0; j < s.q.size(); ++j)
      tree_->setJointPosMultiDof(static_cast<int>(j), s.q.data() + j);
  }
  void set_velocity(const BulletState& s) {
    if (scene_.floats()) {
      tree_->setBaseVel(s.velocity);
      tree_->setBaseOmega(s.omega);
      // The force on the base can only be added to.
      tree_->addBaseForce(s.force - tree_->getBaseForce());
      tree_->addBaseTorque(s.torque - tree_->getBaseTorque());
    }
    for (std::size_t j = 0; j < s.v.size(); ++j) {
      tree_->setJointVel(static_cast<int>(j), s.v[j]);
      tree_->getLink(static_cast<int>(j)).m_jointTorque[0] = s.tau[j];
    }
  }
  void accelerate(btScalar h) {
    tree_->computeAccelerationsArticulatedBodyAlgorithmMultiDof(h, numbers_, vectors_, matrices_,
                                                                false, false, false);
  }
  void run_one(Algorithm algorithm, const BulletState& s) override {
    set_position(s);
    if (algorithm == Algorithm::kinematics) {
      tree_->forwardKinematics(quaternions_, vectors_);
      return;
    }
    set_velocity(s);
    accelerate(bt(step_length));  // also adds them to the velocities, at negligible cost
    if (algorithm == Algorithm::step) tree_->stepPositionsMultiDof(bt(step_length));
  }

  std::unique_ptr<BulletWorld> world_;
  std::size_t first_ = 0;  // first body on a joint, of a mechanism
  std::vector<Principal> frames_;
  std::unique_ptr<btMultiBody> tree_;
  btAlignedObjectArray<btScalar> numbers_;
  btAlignedObjectArray<btVector3> vectors_;
  btAlignedObjectArray<btMatrix3x3> matrices_;
  btAlignedObjectArray<btQuaternion> quaternions_;
};

}  // namespace

EngineKind bullet_engine() {
  return {"bullet", 2, one_engine<Bullet>};
}

}  // namespace twinarm::bench
