// twinarm itself: the step that any program calls, with every integrator; contacts by the rigid
// response, as they come and with impacts located in time.
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "benchmarks/peers/peer.h"
#include "collision/contact/contact_constraints.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace twinarm::peers {
namespace {

constexpr const char* kLocated = "located";  // the scheme of contacts whose events are located

Vector3 vector3(const Numbers3& v) {
  return {v[0], v[1], v[2]};
}
JointType type_of(Joint joint) {
  return joint == Joint::hinge  ? JointType::revolute
         : joint == Joint::ball ? JointType::spherical
                                : JointType::free;
}
Shape shape_of(const Body& b) {
  if (b.form == Form::sphere) return Sphere{b.half[0]};
  return Box{2 * vector3(b.half)};
}
Model<double> model_of(const Scene& scene) {
  ModelBuilder builder;
  builder.set_gravity(vector3(scene.gravity));
  int number = 0;
  for (const Body& b : scene.bodies) {
    const auto& [xx, yy, zz, xy, xz, yz] = b.inertia;
    BodyInertia inertia{b.mass, vector3(b.com), {}};
    inertia.inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    const Eigen::Quaterniond turn(b.turn[0], b.turn[1], b.turn[2], b.turn[3]);
    const std::string name = std::to_string(++number);
    builder.add_body(name, b.parent + 1, "joint " + name, type_of(b.joint),
                     {turn.toRotationMatrix(), vector3(b.position)}, Vector3::UnitZ(), inertia);
  }
  return builder.build();
}

// The constant forces on the bodies that have one; these have their com in their origin.
class Pushes final : public ForceSource {
 public:
  explicit Pushes(const Scene& scene) : scene_(scene) {}
  void add_forces(const State<double>&, const Kinematics& k, Forces<double>& f) noexcept override {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const Vector3 F_B = k.R_WB[i + 1].transpose() * vector3(scene_.bodies[i].push);
      f.f_ext[i + 1].f += from_eigen(F_B);
    }
  }

 private:
  const Scene& scene_;
};

struct Run {
  Run(const Scene& s, const Scheme& scheme, double h)
      : scene(s), model(model_of(s)), simulation(model, start()), pushes(scene) {
    if (scene.has_contacts()) {
      contacts.emplace(model, ContactResponse::rigid);
      add_shapes();
      simulation.add(*contacts);
      if (scheme.name == kLocated) simulation.locate_events();
    } else {
      simulation.set_integrator(find_integrator(scheme.name).value());
      if (scheme.adaptive) simulation.set_tolerance(h);
    }
    if (std::ranges::any_of(scene.bodies, [](const Body& b) { return b.push != Numbers3{}; }))
      simulation.add(pushes);
  }
  State<double> start() const {
    State<double> x(model);
    x.q = scene.q, x.qd = scene.v;
    return x;
  }
  // A pair takes the geometric mean of the frictions and the product of the restitutions.
  void add_shapes() {
    ContactSurface body, floor;
    body.friction = scene.friction;
    floor.friction =
        scene.friction > 0 ? scene.floor_friction * scene.floor_friction / scene.friction : 0;
    body.restitution = floor.restitution = std::sqrt(scene.restitution);
    contacts->add({"floor", 0, {}, HalfSpace{}, floor});
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Body& b = scene.bodies[i];
      contacts->add({"body", static_cast<int>(i) + 1, {}, shape_of(b), body});
    }
  }

  Scene scene;
  Model<double> model;
  Simulation simulation;
  Pushes pushes;
  std::optional<ContactConstraints> contacts;
};

class Twinarm final : public Peer {
 public:
  std::string name() const override { return "twinarm"; }
  std::vector<Scheme> schemes(const Scene& scene) const override {
    constexpr std::size_t kMostLocated = 50;  // bodies; a pile has more impacts than can be located
    if (scene.has_contacts() && scene.bodies.size() > kMostLocated) return {{"semi-implicit"}};
    if (scene.has_contacts()) return {{"semi-implicit"}, {kLocated}};
    std::vector<Scheme> all{{"semi-implicit"}};
    for (const IntegratorFacts& facts : all_integrators)
      if (facts.integrator != Integrator::semi_implicit)
        all.push_back({facts.name, facts.integrator == Integrator::dopri5});
    return all;
  }
  void load(const Scene& scene, const Scheme& scheme, double h) override {
    run_.reset();
    run_.emplace(scene, scheme, h);
    scheme_ = scheme, h_ = h, steps_ = 0, until_ = 0;
  }
  void step() override {
    const double longest = scheme_.adaptive ? 0.1 : h_;
    const StepReport report = scheme_.adaptive
                                  ? run_->simulation.substep(std::min(longest, until_ - t()))
                                  : run_->simulation.step(longest);
    if (!report.ok()) throw std::runtime_error("the run stopped by itself");
    ++steps_;
  }
  void advance(double t_end) override {
    until_ = t_end;
    if (scheme_.adaptive)
      while (until_ - t() > 1e-10) step();
    else
      while (t_end - static_cast<double>(steps_) * h_ > 0.5 * h_) step();
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q = run_->simulation.state().q, v = run_->simulation.state().qd;
  }

 private:
  double t() const { return run_->simulation.state().t; }
  std::optional<Run> run_;
  Scheme scheme_;
  double h_ = 0, until_ = 0;
  long steps_ = 0;
};

}  // namespace

void add_twinarm(Peers& peers) {
  peers.push_back(std::make_unique<Twinarm>());
}

}  // namespace twinarm::peers
