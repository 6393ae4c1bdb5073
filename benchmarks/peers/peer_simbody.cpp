// Simbody, with three of its integrators. Its contacts are compliant laws, between which and the
// rigid scenes there is nothing to compare: none are set up.
#include <SimTKsimbody.h>

#include "benchmarks/peers/peer.h"

namespace twinarm::peers {
namespace {

SimTK::Rotation rotation_of(const double* q) {
  return SimTK::Rotation(SimTK::Quaternion(SimTK::Vec4(q[0], q[1], q[2], q[3])));
}
SimTK::Vec3 vec3(const Numbers3& v) {
  return {v[0], v[1], v[2]};
}

struct SimbodyRun {
  explicit SimbodyRun(const Scene& scene) : gravity(forces, matter, vec3(scene.gravity)) {
    for (const Body& b : scene.bodies) links.push_back(add(b));
    system.realizeTopology();
  }
  SimTK::MobilizedBody add(const Body& b) {
    const auto& [xx, yy, zz, xy, xz, yz] = b.inertia;
    const SimTK::Vec3 com = vec3(b.com);
    const SimTK::Inertia about_com(xx, yy, zz, xy, xz, yz);
    const SimTK::Body::Rigid body(
        SimTK::MassProperties(b.mass, com, about_com.shiftFromMassCenter(com, b.mass)));
    SimTK::MobilizedBody& parent = b.parent < 0
                                       ? static_cast<SimTK::MobilizedBody&>(matter.Ground())
                                       : links[static_cast<std::size_t>(b.parent)];
    const SimTK::Transform place(rotation_of(b.turn.data()), vec3(b.position)), origin;
    if (b.joint == Joint::hinge) return SimTK::MobilizedBody::Pin(parent, place, body, origin);
    if (b.joint == Joint::ball) return SimTK::MobilizedBody::Ball(parent, place, body, origin);
    return SimTK::MobilizedBody::Free(parent, place, body, origin);
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::Force::Gravity gravity;
  std::vector<SimTK::MobilizedBody> links;
};

class Simbody final : public Peer {
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
    run_ = std::make_unique<SimbodyRun>(scene);
    SimTK::State state = run_->system.getDefaultState();
    write(state);
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
  // Said to be an event, or a state between two steps is interpolated.
  void advance(double t) override {
    while (integrator_->getTime() < t - 1e-12) integrator_->stepTo(t, t);
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    const SimTK::State& state = integrator_->getState();
    q.clear(), v.clear();
    for (std::size_t i = 0; i < run_->links.size(); ++i) {
      const SimTK::MobilizedBody& link = run_->links[i];
      const Joint joint = scene_.bodies[i].joint;
      if (joint == Joint::hinge) {
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

 private:
  // Of a ball or a free body the quaternion comes first, and velocities are in the parent's axes.
  void write(SimTK::State& state) const {
    const double *q = scene_.q.data(), *v = scene_.v.data();
    for (std::size_t i = 0; i < run_->links.size(); ++i) {
      const SimTK::MobilizedBody& link = run_->links[i];
      const Joint joint = scene_.bodies[i].joint;
      if (joint == Joint::hinge) {
        link.setOneQ(state, 0, q[0]), link.setOneU(state, 0, v[0]);
      } else {
        const double* turn = joint == Joint::free ? q + 3 : q;
        const SimTK::Vec3 w = rotation_of(turn) * SimTK::Vec3(v[0], v[1], v[2]);
        for (int k = 0; k < 4; ++k) link.setOneQ(state, k, turn[k]);
        for (int k = 0; k < 3; ++k) link.setOneU(state, k, w[k]);
        for (int k = 0; joint == Joint::free && k < 3; ++k)
          link.setOneQ(state, 4 + k, q[k]), link.setOneU(state, 3 + k, v[3 + k]);
      }
      q += coordinates_of(joint), v += velocities_of(joint);
    }
  }

  Scene scene_;
  std::unique_ptr<SimbodyRun> run_;
  std::unique_ptr<SimTK::Integrator> integrator_;
};

}  // namespace

void add_simbody(Peers& peers) {
  peers.push_back(std::make_unique<Simbody>());
}

}  // namespace twinarm::peers
