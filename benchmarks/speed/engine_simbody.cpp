// Simbody. Debian's library is built without -DNDEBUG, which changes its classes: this file is too.
//
// The weights are a Force::Gravity, as in any program with Simbody; forward dynamics is realising
// the stages up to the accelerations.
#include <SimTKsimbody.h>

#include <algorithm>

#include "benchmarks/speed/eigen.h"
#include "benchmarks/speed/engine.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm::speed {
namespace {

SimTK::Vec3 vec(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
SimTK::Rotation rotation(const Eigen::Matrix3d& R) {
  return SimTK::Rotation(
      SimTK::Mat33(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      true);
}
SimTK::Vector vector(const std::vector<double>& v) {
  return SimTK::Vector(static_cast<int>(v.size()), v.data());
}

class Simbody : public Engine {
 public:
  std::string name() const override { return "simbody"; }
  bool has(Algorithm) const override { return true; }

  void load(const Mechanism& mechanism) override {
    mechanism_ = mechanism;
    links_.clear();
    for (std::size_t i = 0; i < mechanism.links.size(); ++i) links_.push_back(add(i));
    system_.realizeTopology();
    state_ = system_.getDefaultState();
    system_.realizeModel(state_);
    system_.realize(state_, SimTK::Stage::Instance);
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
    if (mechanism_.floating) {  // (alpha; a of the origin), both in world axes
      const Base base(situations_[k]);
      const Eigen::Vector3d alpha = base.R.conjugate() * Eigen::Vector3d(qdd.data());
      std::copy_n(qdd.begin() + 3, 3, qdd.begin());
      std::copy_n(alpha.data(), 3, qdd.begin() + 3);
    }
    return qdd;
  }
  std::vector<double> tau(std::size_t k) override {
    run(Algorithm::inverse_dynamics, states_[k]);
    std::vector<double> tau;
    for (int i = 0; i < residual_.size(); ++i) tau.push_back(residual_[i]);
    return joints_of(mechanism_, tau);
  }

 private:
  // In Simbody's coordinates: of the base its quaternion and position; velocities and forces
  // angular part first, all in world axes.
  struct Converted {
    SimTK::Vector q, u, tau, udot;
  };

  SimTK::MobilizedBody add(std::size_t i) {
    const Link& link = mechanism_.links[i];
    const Numbers9& I = link.inertia;
    const SimTK::Inertia about_com(I[0], I[4], I[8], I[1], I[2], I[5]);
    const SimTK::Vec3 com = vec(vector3(link.com));
    const SimTK::Body::Rigid body(
        SimTK::MassProperties(link.mass, com, about_com.shiftFromMassCenter(com, link.mass)));
    SimTK::MobilizedBody& parent = link.parent < 0
                                       ? static_cast<SimTK::MobilizedBody&>(matter_.Ground())
                                       : links_[static_cast<std::size_t>(link.parent)];
    if (i < mechanism_.first_joint())
      return SimTK::MobilizedBody::Free(parent, SimTK::Transform(), body, SimTK::Transform());
    // its pin turns about z: frames whose z is the link's axis
    const Eigen::Matrix3d to_axis =
        turn_z_to(Eigen::Vector3d::Unit(static_cast<Eigen::Index>(link.axis)));
    const SimTK::Transform in_parent(rotation(matrix3(link.rotation) * to_axis),
                                     vec(vector3(link.position)));
    return SimTK::MobilizedBody::Pin(parent, in_parent, body, SimTK::Transform(rotation(to_axis)));
  }

  Converted convert(const Situation& s) const {
    Converted c{vector(s.q), vector(s.v), vector(s.tau), vector(s.qdd)};
    if (!mechanism_.floating) return c;
    const Base base(s);
    const Eigen::Vector3d w_W = base.R * base.w_B, t_W = base.R * base.t_B;
    const Eigen::Vector3d alpha_W = base.R * Eigen::Vector3d(s.qdd.data() + 3);
    for (int k = 0; k < 3; ++k) {
      c.q[k] = s.q[static_cast<std::size_t>(3 + k)];
      c.q[4 + k] = base.p[k];
      c.u[k] = w_W[k];
      c.u[3 + k] = base.v_W[k];
      c.tau[k] = t_W[k];
      c.tau[3 + k] = base.f_W[k];
      c.udot[k] = alpha_W[k];
      c.udot[3 + k] = s.qdd[static_cast<std::size_t>(k)];
    }
    c.q[3] = s.q[6];
    return c;
  }

  void run(Algorithm algorithm, const Converted& s) {
    using SimTK::Stage;
    state_.updQ() = s.q;
    switch (algorithm) {
      case Algorithm::kinematics:
        system_.realize(state_, Stage::Position);
        return;
      case Algorithm::mass_matrix:
        system_.realize(state_, Stage::Position);
        matter_.calcM(state_, M_);
        return;
      case Algorithm::inverse_dynamics:
        state_.updU() = s.u;
        system_.realize(state_, Stage::Velocity);
        matter_.calcResidualForceIgnoringConstraints(
            state_, no_forces_, gravity_.getBodyForces(state_), s.udot, residual_);
        return;
      case Algorithm::forward_dynamics:
      case Algorithm::step:
        state_.updU() = s.u;
        applied_.setAllMobilityForces(state_, s.tau);
        system_.realize(state_, Stage::Acceleration);
        if (algorithm == Algorithm::forward_dynamics) return;
        state_.updU() += step_length * state_.getUDot();
        system_.realize(state_, Stage::Velocity);
        state_.updQ() += step_length * state_.getQDot();
        // the quaternion of a free base is projected back to length 1 on the next realisation
    }
  }

  Mechanism mechanism_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  SimTK::Force::Gravity gravity_{forces_, matter_, SimTK::Vec3(0, 0, -standard_gravity)};
  SimTK::Force::DiscreteForces applied_{forces_, matter_};
  std::vector<SimTK::MobilizedBody> links_;
  SimTK::State state_;
  std::vector<Situation> situations_;
  std::vector<Converted> states_;
  SimTK::Vector no_forces_, residual_;
  SimTK::Matrix M_;
};

}  // namespace

void add_simbody(Engines& engines) {
  engines.push_back(std::make_unique<Simbody>());
}

}  // namespace twinarm::speed
