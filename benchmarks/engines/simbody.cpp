// Simbody. Debian's library is built without -DNDEBUG, which changes its classes; so is this file.
// Its headers are C++17, not 20.
//
// header: SimTKsimbody.h
// libraries: SimTKsimbody SimTKmath SimTKcommon
// options: -UNDEBUG
// standard: 17
//
// Scenes: three of its integrators. Its contact laws are compliant and not comparable with the
// rigid scenes, so no contacts are set up. Algorithms: gravity is a Force::Gravity, as usual in
// Simbody; forward dynamics realises the stages up to acceleration.
#include <SimTKsimbody.h>

#include <algorithm>

#include "benchmarks/engines/engine.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm::bench {
namespace {

SimTK::Vec3 vec3(const double* v) {
  return {v[0], v[1], v[2]};
}
SimTK::Rotation rotation_of(const double* q) {
  return SimTK::Rotation(SimTK::Quaternion(SimTK::Vec4(q[0], q[1], q[2], q[3])));
}
SimTK::Rotation rotation_of(const Eigen::Matrix3d& R) {
  return SimTK::Rotation(
      SimTK::Mat33(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      true);
}
SimTK::Vector vector_of(const std::vector<double>& v) {
  return SimTK::Vector(static_cast<int>(v.size()), v.data());
}
std::vector<double> numbers_of(const SimTK::Vector& v) {
  std::vector<double> numbers;
  for (int i = 0; i < v.size(); ++i) numbers.push_back(v[i]);
  return numbers;
}

struct SimbodySystem {
  explicit SimbodySystem(const Scene& scene)
      : gravity(forces, matter, vec3(scene.gravity.data())), applied(forces, matter) {
    for (const Body& b : scene.bodies) links.push_back(add(b));
    system.realizeTopology();
  }
  SimTK::MobilizedBody add(const Body& b) {
    const auto& [xx, yy, zz, xy, xz, yz] = b.inertia;
    const SimTK::Vec3 com = vec3(b.com.data());
    const SimTK::Inertia about_com(xx, yy, zz, xy, xz, yz);
    const SimTK::Body::Rigid body(
        SimTK::MassProperties(b.mass, com, about_com.shiftFromMassCenter(com, b.mass)));
    SimTK::MobilizedBody& parent =
        b.parent < 0 ? static_cast<SimTK::MobilizedBody&>(matter.Ground()) : links[index(b.parent)];
    // a pin rotates about z: frames with z along the body's axis
    const Eigen::Matrix3d to_axis = b.joint == Joint::revolute
                                        ? rotation_taking_z_to(axis_of(b))
                                        : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const SimTK::Transform place(rotation_of(b.rotation * to_axis), vec3(b.position.data()));
    const SimTK::Transform in_body(rotation_of(to_axis));
    if (b.joint == Joint::revolute) return SimTK::MobilizedBody::Pin(parent, place, body, in_body);
    if (b.joint == Joint::spherical)
      return SimTK::MobilizedBody::Ball(parent, place, body, in_body);
    return SimTK::MobilizedBody::Free(parent, place, body, in_body);
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::Force::Gravity gravity;
  SimTK::Force::DiscreteForces applied;
  std::vector<SimTK::MobilizedBody> links;
};

// Simbody's coordinates: of a base the quaternion and position; velocities and forces in world
// axes, angular part first.
struct SimbodyState {
  SimTK::Vector q, u, tau, udot;
};

class Simbody final : public PeerEngine<SimbodyState> {
 public:
  std::string name() const override { return "simbody"; }
  std::vector<Scheme> schemes(const Scene&) const override {
    return {{"RungeKuttaMerson", true}, {"Verlet"}, {"SemiExplicitEuler"}};
  }
  std::string refusal(const Scene& scene) const override {
    return scene.has_contacts() ? "Simbody's contacts are compliant, the scene's are rigid" : "";
  }

  void load(const Scene& scene, const Scheme& scheme, double h) override {
    begin(scene, h);
    integrator_.reset();
    run_ = std::make_unique<SimbodySystem>(scene);
    state_ = run_->system.getDefaultState();
    set_joints();
    if (scheme.adaptive) {
      integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(run_->system);
      integrator_->setAccuracy(h);
    } else if (scheme.name == "Verlet") {
      integrator_ = std::make_unique<SimTK::VerletIntegrator>(run_->system);
      integrator_->setFixedStepSize(h);
    } else {
      integrator_ = std::make_unique<SimTK::SemiExplicitEulerIntegrator>(run_->system, h);
    }
    integrator_->initialize(state_);
  }
  void step() override { integrator_->stepBy(SimTK::Infinity); }
  // Declared as an event; otherwise a state between two steps is interpolated.
  void advance(double t) override {
    while (integrator_->getTime() < t - 1e-12) integrator_->stepTo(t, t);
  }

  void load_mechanism(const Scene& mechanism) override {
    scene_ = mechanism;
    run_ = std::make_unique<SimbodySystem>(mechanism);
    state_ = run_->system.getDefaultState();
    run_->system.realizeModel(state_);
    run_->system.realize(state_, SimTK::Stage::Instance);
  }
  std::vector<double> qdd(std::size_t k) override {
    run_one(Algorithm::forward_dynamics, converted_[k]);
    std::vector<double> qdd = numbers_of(state_.getUDot());
    if (scene_.floats()) {  // angular acceleration, world axes
      const Vector3d alpha = Base(situations_[k]).R.conjugate() * Vector3d(qdd.data());
      std::copy_n(alpha.data(), 3, qdd.begin());
    }
    return qdd;
  }
  std::vector<double> tau(std::size_t k) override {
    run_one(Algorithm::inverse_dynamics, converted_[k]);
    return numbers_of(residual_);
  }

 private:
  // Spherical and free joints: quaternion first, velocities in parent axes.
  void set_joint(std::size_t i, const double* q, const double* v) override {
    const SimTK::MobilizedBody& link = run_->links[i];
    const Joint joint = scene_.bodies[i].joint;
    if (joint == Joint::revolute) {
      link.setOneQ(state_, 0, q[0]), link.setOneU(state_, 0, v[0]);
      return;
    }
    const double* turn = joint == Joint::free ? q + 3 : q;
    const SimTK::Vec3 w = rotation_of(turn) * vec3(v);
    for (int k = 0; k < 4; ++k) link.setOneQ(state_, k, turn[k]);
    for (int k = 0; k < 3; ++k) link.setOneU(state_, k, w[k]);
    for (int k = 0; joint == Joint::free && k < 3; ++k)
      link.setOneQ(state_, 4 + k, q[k]), link.setOneU(state_, 3 + k, v[3 + k]);
  }
  void read_joint(std::size_t i, double* q, double* v) override {
    const SimTK::State& state = integrator_->getState();
    const SimTK::MobilizedBody& link = run_->links[i];
    const Joint joint = scene_.bodies[i].joint;
    if (joint == Joint::revolute) {
      q[0] = link.getOneQ(state, 0), v[0] = link.getOneU(state, 0);
      return;
    }
    SimTK::Vec4 turn;
    SimTK::Vec3 w;
    for (int k = 0; k < 4; ++k) turn[k] = link.getOneQ(state, k);
    for (int k = 0; k < 3; ++k) w[k] = link.getOneU(state, k);
    turn = turn.normalize();
    w = ~rotation_of(&turn[0]) * w;
    for (int k = 0; joint == Joint::free && k < 3; ++k)
      *q++ = link.getOneQ(state, 4 + k), v[3 + k] = link.getOneU(state, 3 + k);
    std::copy_n(&turn[0], 4, q), std::copy_n(&w[0], 3, v);
  }

  SimbodyState convert(const Situation& s) const override {
    SimbodyState c{vector_of(s.q), vector_of(s.v), vector_of(s.tau), vector_of(s.qdd)};
    if (!scene_.floats()) return c;
    const Base base(s);
    const Vector3d w_W = base.R * base.w_B, t_W = base.R * base.t_B;
    const Vector3d alpha_W = base.R * Vector3d(s.qdd.data());
    for (int k = 0; k < 3; ++k) {
      c.q[k] = s.q[static_cast<std::size_t>(3 + k)];
      c.q[4 + k] = base.p[k];
      c.u[k] = w_W[k];
      c.tau[k] = t_W[k];
      c.udot[k] = alpha_W[k];
    }
    c.q[3] = s.q[6];
    return c;
  }

  void run_one(Algorithm algorithm, const SimbodyState& s) override {
    using SimTK::Stage;
    const SimTK::MultibodySystem& system = run_->system;
    state_.updQ() = s.q;
    switch (algorithm) {
      case Algorithm::kinematics:
        system.realize(state_, Stage::Position);
        return;
      case Algorithm::mass_matrix:
        system.realize(state_, Stage::Position);
        run_->matter.calcM(state_, M_);
        return;
      case Algorithm::inverse_dynamics:
        state_.updU() = s.u;
        system.realize(state_, Stage::Velocity);
        run_->matter.calcResidualForceIgnoringConstraints(
            state_, no_forces_, run_->gravity.getBodyForces(state_), s.udot, residual_);
        return;
      default:  // forward dynamics, step
        state_.updU() = s.u;
        run_->applied.setAllMobilityForces(state_, s.tau);
        system.realize(state_, Stage::Acceleration);
        if (algorithm == Algorithm::forward_dynamics) return;
        state_.updU() += step_length * state_.getUDot();
        system.realize(state_, Stage::Velocity);
        state_.updQ() += step_length * state_.getQDot();
        // the quaternion of a free base is normalised at the next realisation
    }
  }

  std::unique_ptr<SimbodySystem> run_;
  std::unique_ptr<SimTK::Integrator> integrator_;
  SimTK::State state_;
  SimTK::Vector no_forces_, residual_;
  SimTK::Matrix M_;
};

}  // namespace

EngineKind simbody_engine() {
  return {"simbody", 4, one_engine<Simbody>};
}

}  // namespace twinarm::bench
