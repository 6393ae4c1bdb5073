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
#include "benchmarks/scenes/eigen.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm::bench {
namespace {

SimTK::Vec3 vec3(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
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

struct SimbodySystem {
  explicit SimbodySystem(const Scene& scene)
      : gravity(forces, matter, vec3(vector3(scene.gravity))), applied(forces, matter) {
    for (const Body& b : scene.bodies) links.push_back(add(b));
    system.realizeTopology();
  }
  SimTK::MobilizedBody add(const Body& b) {
    const auto& [xx, yy, zz, xy, xz, yz] = b.inertia;
    const SimTK::Vec3 com = vec3(vector3(b.com));
    const SimTK::Inertia about_com(xx, yy, zz, xy, xz, yz);
    const SimTK::Body::Rigid body(
        SimTK::MassProperties(b.mass, com, about_com.shiftFromMassCenter(com, b.mass)));
    SimTK::MobilizedBody& parent =
        b.parent < 0 ? static_cast<SimTK::MobilizedBody&>(matter.Ground()) : links[index(b.parent)];
    // a pin rotates about z: frames with z along the body's axis
    const Eigen::Matrix3d to_axis = b.joint == Joint::revolute
                                        ? rotation_taking_z_to(axis_of(b))
                                        : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const SimTK::Transform place(rotation_of(matrix3(b.rotation) * to_axis),
                                 vec3(vector3(b.position)));
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

class Simbody final : public Engine {
 public:
  std::string name() const override { return "simbody"; }
  std::vector<Scheme> schemes(const Scene& scene) const override {
    if (!refusal(scene).empty()) return {};
    return {{"RungeKuttaMerson", true}, {"Verlet"}, {"SemiExplicitEuler"}};
  }
  std::string refusal(const Scene& scene) const override {
    return scene.has_contacts() ? "Simbody's contacts are compliant, the scene's are rigid" : "";
  }

  void load(const Scene& scene, const Scheme& scheme, double h) override {
    scene_ = scene;
    integrator_.reset();
    run_ = std::make_unique<SimbodySystem>(scene);
    SimTK::State state = run_->system.getDefaultState();
    write(scene.q.data(), scene.v.data(), state);
    if (scheme.adaptive) {
      integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(run_->system);
      integrator_->setAccuracy(h);
    } else if (scheme.name == "Verlet") {
      integrator_ = std::make_unique<SimTK::VerletIntegrator>(run_->system);
      integrator_->setFixedStepSize(h);
    } else {
      integrator_ = std::make_unique<SimTK::SemiExplicitEulerIntegrator>(run_->system, h);
    }
    integrator_->initialize(state);
  }
  void step() override { integrator_->stepBy(SimTK::Infinity); }
  // Declared as an event; otherwise a state between two steps is interpolated.
  void advance(double t) override {
    while (integrator_->getTime() < t - 1e-12) integrator_->stepTo(t, t);
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    const SimTK::State& state = integrator_->getState();
    q.clear(), v.clear();
    for (std::size_t i = 0; i < run_->links.size(); ++i) {
      const SimTK::MobilizedBody& link = run_->links[i];
      const Joint joint = scene_.bodies[i].joint;
      if (joint == Joint::revolute) {
        q.push_back(link.getOneQ(state, 0)), v.push_back(link.getOneU(state, 0));
        continue;
      }
      const int free = joint == Joint::free ? 3 : 0;
      for (int k = 0; k < free; ++k) q.push_back(link.getOneQ(state, 4 + k));
      const SimTK::Vec4 turn = SimTK::Vec4(link.getOneQ(state, 0), link.getOneQ(state, 1),
                                           link.getOneQ(state, 2), link.getOneQ(state, 3))
                                   .normalize();
      for (int k = 0; k < 4; ++k) q.push_back(turn[k]);
      const SimTK::Vec3 w(link.getOneU(state, 0), link.getOneU(state, 1), link.getOneU(state, 2));
      const SimTK::Vec3 in_body = ~rotation_of(&turn[0]) * w;
      for (int k = 0; k < 3; ++k) v.push_back(in_body[k]);
      for (int k = 0; k < free; ++k) v.push_back(link.getOneU(state, 3 + k));
    }
  }

  bool has(Algorithm) const override { return true; }
  void load_mechanism(const Scene& mechanism) override {
    scene_ = mechanism;
    run_ = std::make_unique<SimbodySystem>(mechanism);
    state_ = run_->system.getDefaultState();
    run_->system.realizeModel(state_);
    run_->system.realize(state_, SimTK::Stage::Instance);
  }
  void set_situations(const std::vector<Situation>& situations) override {
    situations_ = situations;
    states_.clear();
    for (const Situation& s : situations) states_.push_back(convert(s));
  }
  void run(Algorithm algorithm) override {
    for (const Converted& s : states_) run(algorithm, s);
  }
  std::vector<double> qdd(std::size_t k) override {
    run(Algorithm::forward_dynamics, states_[k]);
    std::vector<double> qdd;
    for (int i = 0; i < state_.getNU(); ++i) qdd.push_back(state_.getUDot()[i]);
    if (scene_.floats()) {  // angular acceleration, world axes
      const Eigen::Vector3d alpha =
          Base(situations_[k]).R.conjugate() * Eigen::Vector3d(qdd.data());
      std::copy_n(alpha.data(), 3, qdd.begin());
    }
    return qdd;
  }
  std::vector<double> tau(std::size_t k) override {
    run(Algorithm::inverse_dynamics, states_[k]);
    std::vector<double> tau;
    for (int i = 0; i < residual_.size(); ++i) tau.push_back(residual_[i]);
    return tau;
  }

 private:
  // Simbody's coordinates: of a base the quaternion and position; velocities and forces in world
  // axes, angular part first.
  struct Converted {
    SimTK::Vector q, u, tau, udot;
  };

  // Spherical and free joints: quaternion first, velocities in parent axes.
  void write(const double* q, const double* v, SimTK::State& state) const {
    for (std::size_t i = 0; i < run_->links.size(); ++i) {
      const SimTK::MobilizedBody& link = run_->links[i];
      const Joint joint = scene_.bodies[i].joint;
      if (joint == Joint::revolute) {
        link.setOneQ(state, 0, q[0]), link.setOneU(state, 0, v[0]);
      } else {
        const double* turn = joint == Joint::free ? q + 3 : q;
        const SimTK::Vec3 w = rotation_of(turn) * vec3(v);
        for (int k = 0; k < 4; ++k) link.setOneQ(state, k, turn[k]);
        for (int k = 0; k < 3; ++k) link.setOneU(state, k, w[k]);
        for (int k = 0; joint == Joint::free && k < 3; ++k)
          link.setOneQ(state, 4 + k, q[k]), link.setOneU(state, 3 + k, v[3 + k]);
      }
      q += coordinates_of(joint), v += velocities_of(joint);
    }
  }

  Converted convert(const Situation& s) const {
    Converted c{vector_of(s.q), vector_of(s.v), vector_of(s.tau), vector_of(s.qdd)};
    if (!scene_.floats()) return c;
    const Base base(s);
    const Eigen::Vector3d w_W = base.R * base.w_B, t_W = base.R * base.t_B;
    const Eigen::Vector3d alpha_W = base.R * Eigen::Vector3d(s.qdd.data());
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

  void run(Algorithm algorithm, const Converted& s) {
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
      case Algorithm::forward_dynamics:
      case Algorithm::step:
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

  Scene scene_;
  std::unique_ptr<SimbodySystem> run_;
  std::unique_ptr<SimTK::Integrator> integrator_;
  SimTK::State state_;
  std::vector<Situation> situations_;
  std::vector<Converted> states_;
  SimTK::Vector no_forces_, residual_;
  SimTK::Matrix M_;
};

}  // namespace
}  // namespace twinarm::bench

namespace twinarm {

bench::EngineKind simbody_engine() {
  return {"simbody", 4, bench::one_engine<bench::Simbody>};
}

}  // namespace twinarm
