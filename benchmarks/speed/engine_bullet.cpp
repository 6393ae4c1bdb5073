// Bullet's btMultiBody, in double (Debian has both; the pc file is bullet-float64).
//
// Inverse dynamics and mass matrix live in an extra library of Bullet's, which is left out.
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Eigenvalues>

#include "benchmarks/speed/eigen.h"
#include "benchmarks/speed/engine.h"

namespace twinarm::speed {
namespace {

btVector3 bt(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
btQuaternion bt(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

// Bullet wants each link in a frame at its com along the principal axes of its inertia.
struct Principal {
  Eigen::Vector3d moments;
  Eigen::Matrix3d R_LP;  // principal axes to link axes
  explicit Principal(const Link& link) {
    const Eigen::Matrix3d I = matrix3(link.inertia);
    if (I.isDiagonal()) {
      moments = I.diagonal();
      R_LP.setIdentity();
      return;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(I);
    moments = eigen.eigenvalues();
    R_LP = eigen.eigenvectors();
    if (R_LP.determinant() < 0) R_LP.col(0) *= -1;
  }
};

class Bullet : public Engine {
 public:
  std::string name() const override { return "bullet"; }
  bool has(Algorithm algorithm) const override {
    return algorithm != Algorithm::inverse_dynamics && algorithm != Algorithm::mass_matrix;
  }

  void load(const Mechanism& mechanism) override {
    mechanism_ = mechanism;
    const std::size_t first = mechanism.first_joint();
    for (const Link& link : mechanism.links) frames_.emplace_back(link);
    const btScalar base_mass = mechanism.floating ? mechanism.links[0].mass : 0;
    const btVector3 base_inertia = mechanism.floating ? bt(frames_[0].moments) : btVector3(0, 0, 0);
    body_ = std::make_unique<btMultiBody>(static_cast<int>(mechanism.joints()), base_mass,
                                          base_inertia, !mechanism.floating, false);
    for (std::size_t i = first; i < mechanism.links.size(); ++i) {
      const Link& link = mechanism.links[i];
      const Principal& frame = frames_[i];
      const bool on_link = link.parent >= 0;
      const auto p = static_cast<std::size_t>(on_link ? link.parent : 0);
      const Eigen::Matrix3d R_PPl =  // link axes of the parent to its principal axes
          on_link ? Eigen::Matrix3d(frames_[p].R_LP.transpose()) : Eigen::Matrix3d::Identity();
      const Eigen::Vector3d parent_com =
          on_link ? vector3(mechanism.links[p].com) : Eigen::Vector3d::Zero();
      const Eigen::Matrix3d R = R_PPl * matrix3(link.rotation) * frame.R_LP;
      const Eigen::Vector3d axis = frame.R_LP.row(static_cast<Eigen::Index>(link.axis));
      body_->setupRevolute(static_cast<int>(i - first), link.mass, bt(frame.moments),
                           link.parent - static_cast<int>(first),
                           bt(Eigen::Quaterniond(R.transpose())), bt(axis),
                           bt(R_PPl * (vector3(link.position) - parent_com)),
                           bt(frame.R_LP.transpose() * vector3(link.com)));
    }
    body_->finalizeMultiDof();
    body_->setLinearDamping(0);
    body_->setAngularDamping(0);
    body_->setUseGyroTerm(true);
    body_->setMaxCoordinateVelocity(1e30);  // it would be clipped at 100
    // A world of Bullet's adds the weights before every step; they are constant, so here it is
    // once.
    for (std::size_t i = first; i < mechanism.links.size(); ++i)
      body_->addLinkForce(static_cast<int>(i - first), weight(i));
  }

  void set_situations(const std::vector<Situation>& situations) override {
    situations_ = situations;
    bases_.clear();
    for (const Situation& s : situations)
      if (mechanism_.floating) bases_.push_back(convert(Base(s)));
  }

  void run(Algorithm algorithm) override {
    for (std::size_t k = 0; k < situations_.size(); ++k) run(algorithm, k);
  }

  // Bullet leaves the accelerations as velocities after a step: with a step of 1 s from here.
  std::vector<double> qdd(std::size_t k) override {
    set_position(k);
    set_velocity(k);
    accelerate(1);
    const btScalar* v = body_->getVelocityVector();
    const Situation& s = situations_[k];
    std::vector<double> qdd;
    if (mechanism_.floating) {
      // of the com in the world; and of the origin: a_O = a_C - alpha x c - w x (w x c)
      const Base base(s);
      const Eigen::Vector3d w = base.R * base.w_B, c = base.R * vector3(mechanism_.links[0].com);
      const Eigen::Vector3d alpha = Eigen::Vector3d(v[0], v[1], v[2]) - w;
      const Eigen::Vector3d v_C = base.v_W + w.cross(c);
      const Eigen::Vector3d a_C = Eigen::Vector3d(v[3], v[4], v[5]) - v_C;
      const Eigen::Vector3d a = a_C - alpha.cross(c) - w.cross(w.cross(c));
      const Eigen::Vector3d alpha_B = base.R.conjugate() * alpha;
      qdd = {a.x(), a.y(), a.z(), alpha_B.x(), alpha_B.y(), alpha_B.z()};
    }
    for (std::size_t j = 0; j < mechanism_.joints(); ++j)
      qdd.push_back(v[6 + j] - s.v[s.v.size() - mechanism_.joints() + j]);
    return qdd;
  }

 private:
  struct BulletBase {
    btVector3 position;
    btQuaternion world_to_base;
    btVector3 v, omega, force, torque;  // of and at the com, all world axes
  };
  BulletBase convert(const Base& base) const {
    const Eigen::Vector3d w = base.R * base.w_B, c = base.R * vector3(mechanism_.links[0].com);
    const Eigen::Quaterniond principal(frames_[0].R_LP);
    return {bt(base.p + c),
            bt((base.R * principal).conjugate()),
            bt(base.v_W + w.cross(c)),
            bt(w),
            bt(base.f_W) + weight(0),
            bt(base.R * base.t_B - c.cross(base.f_W))};
  }
  btVector3 weight(std::size_t i) const {
    return {0, 0, -standard_gravity * mechanism_.links[i].mass};
  }

  void set_position(std::size_t k) {
    if (mechanism_.floating) {
      body_->setBasePos(bases_[k].position);
      body_->setWorldToBaseRot(bases_[k].world_to_base);
    }
    const std::size_t n = mechanism_.joints();
    btScalar* q = situations_[k].q.data() + situations_[k].q.size() - n;
    for (std::size_t j = 0; j < n; ++j) body_->setJointPosMultiDof(static_cast<int>(j), q + j);
  }
  void set_velocity(std::size_t k) {
    if (mechanism_.floating) {
      body_->setBaseVel(bases_[k].v);
      body_->setBaseOmega(bases_[k].omega);
      // There is only adding to the force on the base.
      body_->addBaseForce(bases_[k].force - body_->getBaseForce());
      body_->addBaseTorque(bases_[k].torque - body_->getBaseTorque());
    }
    const std::size_t n = mechanism_.joints();
    const Situation& s = situations_[k];
    for (std::size_t j = 0; j < n; ++j) {
      body_->setJointVel(static_cast<int>(j), s.v[s.v.size() - n + j]);
      body_->getLink(static_cast<int>(j)).m_jointTorque[0] = s.tau[s.tau.size() - n + j];
    }
  }
  void accelerate(btScalar h) {
    body_->computeAccelerationsArticulatedBodyAlgorithmMultiDof(h, numbers_, vectors_, matrices_,
                                                                false, false, false);
  }
  void run(Algorithm algorithm, std::size_t k) {
    set_position(k);
    if (algorithm == Algorithm::kinematics) {
      body_->forwardKinematics(quaternions_, vectors_);
      return;
    }
    set_velocity(k);
    accelerate(step_length);  // also adds them to the velocities, which costs next to nothing
    if (algorithm == Algorithm::step) body_->stepPositionsMultiDof(step_length);
  }

  Mechanism mechanism_;
  std::vector<Principal> frames_;
  std::unique_ptr<btMultiBody> body_;
  std::vector<Situation> situations_;
  std::vector<BulletBase> bases_;
  btAlignedObjectArray<btScalar> numbers_;
  btAlignedObjectArray<btVector3> vectors_;
  btAlignedObjectArray<btMatrix3x3> matrices_;
  btAlignedObjectArray<btQuaternion> quaternions_;
};

}  // namespace

void add_bullet(Engines& engines) {
  engines.push_back(std::make_unique<Bullet>());
}

}  // namespace twinarm::speed
