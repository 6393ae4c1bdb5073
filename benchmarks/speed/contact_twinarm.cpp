// twinarm's contact scenes: the step that any program calls, with the rigid response.
#include <optional>

#include "benchmarks/speed/contact_engine.h"
#include "benchmarks/speed/eigen.h"
#include "collision/contact/contact_constraints.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace twinarm::speed {
namespace {

Model<double> boxes(std::size_t count) {
  ModelBuilder builder;
  builder.set_gravity({0, 0, -standard_gravity});
  const BodyInertia uniform{box_mass, Vector3::Zero(),
                            box_mass * box_edge * box_edge / 6 * Matrix3::Identity()};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    builder.add_body("box" + number, 0, "free" + number, JointType::free, {}, Vector3::UnitZ(),
                     uniform);
  }
  return builder.build();
}

Model<double> arm() {
  ModelBuilder builder;
  builder.set_gravity({0, 0, -standard_gravity});
  const Mechanism scara = scara3();
  for (std::size_t i = 0; i < scara.links.size(); ++i) {
    const Link& link = scara.links[i];
    const std::string number = std::to_string(i);
    builder.add_body("link" + number, link.parent + 1, "joint" + number, JointType::revolute,
                     {matrix3(link.rotation), vector3(link.position)},
                     Vector3::Unit(static_cast<Eigen::Index>(link.axis)),
                     {link.mass, vector3(link.com), matrix3(link.inertia)});
  }
  return builder.build();
}

class Control final : public ForceSource {
 public:
  void add_forces(const State<double>& x, const Kinematics&, Forces<double>& f) noexcept override {
    for (std::size_t j = 0; j < 3; ++j) f.tau[j] += push_.torque(j, x.q[j], x.qd[j]);
  }

 private:
  Push push_;
};

// Contacts with clocks around their detection and around what the solver does between add and take.
class WatchedContacts final : public ConstraintSource {
 public:
  explicit WatchedContacts(ContactConstraints& contacts) : contacts_(contacts) {}
  bool watched = false;
  double detection = 0, solver = 0;  // since they were set to 0 [s]

  void begin_step(const Kinematics& k, const State<double>& x, double h) noexcept override {
    const double start = now();
    contacts_.begin_step(k, x, h);
    detection += now() - start;
  }
  bool closes(const ConstraintFrame& frame) noexcept override { return contacts_.closes(frame); }
  bool wants_separation() const noexcept override { return contacts_.wants_separation(); }
  void add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override {
    contacts_.add(frame, problem);
    added_ = now();
  }
  void take(const ConstraintFrame& frame, const ImpulseProblem& problem,
            std::size_t first) noexcept override {
    solver += now() - added_;
    contacts_.take(frame, problem, first);
  }

 private:
  double now() const { return watched ? thread_seconds() : 0; }
  ContactConstraints& contacts_;
  double added_ = 0;
};

struct Run {
  explicit Run(const ContactScene& scene)
      : model(scene.has_arm() ? arm() : boxes(scene.boxes.size())),
        simulation(model, start(scene)),
        contacts(model, ContactResponse::rigid),
        watch(contacts) {
    const Box box{{box_edge, box_edge, box_edge}};
    ContactSurface surface;
    surface.friction = contact_friction;
    if (scene.has_arm()) {
      const Push push;
      contacts.add({"obstacle", 0, {Matrix3::Identity(), vector3(push.obstacle)}, box, surface, 0});
      contacts.add(
          {"tip", 3, {Matrix3::Identity(), vector3(push.tip)}, Sphere{push.radius}, surface, 0});
      simulation.add(control);
    } else {
      contacts.add({"floor", 0, {}, HalfSpace{}, surface, 0});
      for (std::size_t i = 0; i < scene.boxes.size(); ++i)
        contacts.add({"box" + std::to_string(i), static_cast<int>(i) + 1, {}, box, surface, 0});
    }
    simulation.add(watch);
  }
  State<double> start(const ContactScene& scene) const {
    State<double> x(model);
    for (std::size_t i = 0; i < scene.boxes.size(); ++i)
      std::copy(scene.boxes[i].begin(), scene.boxes[i].end(),
                x.q.begin() + static_cast<std::ptrdiff_t>(model.iq[i + 1]));
    return x;
  }

  Model<double> model;
  Simulation simulation;
  ContactConstraints contacts;
  WatchedContacts watch;
  Control control;
};

class Twinarm final : public ContactEngine {
 public:
  std::string name() const override { return "twinarm double"; }
  void load(const ContactScene& scene) override {
    scene_ = scene;
    run_.reset();
    run_.emplace(scene);
  }
  void step() override { run_->simulation.step(scene_.h); }
  std::optional<SolverReading> watched_step() override {
    run_->watch.watched = true;
    run_->watch.detection = run_->watch.solver = 0;
    const double start = thread_seconds();
    step();
    const double whole = thread_seconds() - start;
    run_->watch.watched = false;
    const ImpulseReport& report = run_->simulation.constraints().report().step;
    return SolverReading{report.residual, report.converged, run_->watch.detection,
                         run_->watch.solver, whole};
  }
  std::vector<Placed> bodies() const override {
    const Kinematics& k = run_->simulation.kinematics();
    if (scene_.has_arm()) {
      const Vector3 p = k.position(3, vector3(Push{}.tip));
      return {{{p.x(), p.y(), p.z()}, {1, 0, 0, 0}}};
    }
    std::vector<Placed> all;
    for (std::size_t i = 0; i < scene_.boxes.size(); ++i) {
      const Pose& X = k.X_WL[i + 1];
      const Eigen::Quaterniond q(X.R);
      all.push_back({{X.p.x(), X.p.y(), X.p.z()}, {q.w(), q.x(), q.y(), q.z()}});
    }
    return all;
  }

 private:
  ContactScene scene_;
  std::optional<Run> run_;
};

}  // namespace

void add_twinarm(ContactEngines& engines) {
  engines.push_back(std::make_unique<Twinarm>());
}

}  // namespace twinarm::speed
