#include "tests/soak/soak_episode.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/scene/model/scene_model.h"
#include "collision/contact/contact_constraints.h"
#include "solver/constraints/joint_limits.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/stepping/simulation.h"
#include "tests/soak/soak_energy.h"

namespace twinarm::soak {
namespace {

constexpr double kMassOfLink = 2;  // as shoves take it [kg]

std::vector<double> masses_of(const SceneModel& scene) {
  const Model<double>& model = scene.model;
  std::vector<double> masses(model.parent.size());
  for (std::size_t i = 1; i < masses.size(); ++i) {
    if (static_cast<int>(i) <= scene.robot_bodies) {
      masses[i] = model.dofs(i) > 0 ? kMassOfLink : 0;
      continue;
    }
    State<double> x(model);
    x.qd[model.iv[i] + 3] = 1;
    masses[i] = 2 * kinetic_energy(model, x);
  }
  return masses;
}

class Episode {
 public:
  Episode(const std::string& name, std::uint64_t seed, long episode)
      : chance_(1000003 * seed + static_cast<std::uint64_t>(episode)),
        made_(make_scene(name, chance_)),
        scene_(build_scene(made_.description)),
        couplings_(scene_, made_.description.step),
        sim_(scene_.model, scene_.start, {.enable_constraint_work = true}),
        contacts_(scene_.model, ContactResponse::rigid),
        limits_(scene_.model),
        shoves_(masses_of(scene_), made_.push, chance_),
        books_(scene_, couplings_, shoves_) {
    sim_.add(shoves_);
    for (std::size_t c = 0; c < couplings_.size(); ++c)
      if (ForceSource* source = couplings_.source(c)) sim_.add(*source);
    add_contacts();
    add_limits();
    books_.begin(sim_.state());
  }

  EpisodeResult run(double seconds, const std::function<bool()>& go_on) {
    const double h = made_.description.step;
    const auto steps = static_cast<long>(std::round(seconds / h));
    while (result_.steps < steps && result_.fault.empty()) {
      const StepReport report = sim_.step(h);
      ++result_.steps;
      result_.seconds = static_cast<double>(result_.steps) * h;
      if (!report.finite) {
        fault("a number is not finite", 0);
        break;
      }
      books_.add_step(sim_.state(), sim_.constraints().velocities_after_impacts(),
                      sim_.mechanism().account->separation().work, h);
      look_at_solver(report);
      look_at_contacts();
      look_at_energy();
      look_at_places();
      if (result_.steps % 100 == 0 && !go_on()) break;
    }
    result_.work = books_.work();
    return result_;
  }

 private:
  void add_contacts() {
    for (const SceneGeometry& g : scene_.geometries)
      contacts_.bodies().add({g.name, g.body, g.X_LG, collision_shape(g.shape), g, 0});
    contacts_.bodies().world().set_pair_filter(
        [this](int a, int b) { return scene_.is_apart(a, b); });
    sim_.add(contacts_);
  }
  void add_limits() {
    for (const RobotInScene& robot : scene_.description.robots)
      for (const JointDescription& joint : robot.description.joints)
        if (joint.is_limited())
          limits_.add(scene_.model.find_joint(joint.name), joint.lower, joint.upper);
    if (!limits_.limits().empty()) sim_.add(limits_);
  }

  void fault(const std::string& what, double value) {
    if (!result_.fault.empty()) return;
    char text[64];
    std::snprintf(text, sizeof text, " (%.3g) at t = %.3f s", value, result_.seconds);
    result_.fault = what + text;
  }

  void look_at_solver(const StepReport& report) {
    const ConstraintReport& solved = sim_.constraints().report();
    const double residual = std::max(solved.step.residual, solved.impact.residual);
    if (residual > result_.residual)
      result_.residual = residual, result_.residual_at = result_.seconds;
    result_.unconverged += report.converged ? 0 : 1;
    result_.infeasible_impacts += solved.infeasible_impacts;
    result_.above += residual > EpisodeResult::kResidual ? 1 : 0;
    if (!(residual <= bounds_.residual)) fault("a law of contact is broken, m/s", residual);
    if (solved.impact_loss < -bounds_.created * books_.scale())
      fault("an impact gained energy, J", -solved.impact_loss);
  }

  void look_at_contacts() {
    int pressing = 0;
    bool deep = false;
    for (const ContactPoint& point : contacts_.points()) {
      const Vector3& n = point.contact.n_W;
      const double normal = point.force_W.dot(n), slack = 1e-6 * (1 + point.force_W.norm());
      const double across = (point.force_W - normal * n).norm();
      pressing += normal > 0 ? 1 : 0;
      deep = deep || point.contact.depth > ContactConstraints::kSlop;
      result_.depth = std::max(result_.depth, point.contact.depth);
      if (!(normal >= -slack)) fault("a contact pulls, N", normal);
      if (!(across <= point.friction * normal + slack))
        fault("friction is beyond its cone, N", across - point.friction * normal);
      if (!(point.contact.depth <= bounds_.depth))
        fault(pair(point) + " penetrate each other, m", point.contact.depth);
    }
    result_.contacts = std::max(result_.contacts, pressing);
    result_.deep += deep ? 1 : 0;
  }
  std::string pair(const ContactPoint& point) const {
    return contacts_.bodies().geometry(point.contact.a).name + " and " +
           contacts_.bodies().geometry(point.contact.b).name;
  }

  void look_at_energy() {
    const double scale = books_.scale();
    result_.created = std::max(result_.created, books_.created() / scale);
    if (!(books_.created() <= bounds_.created * scale))
      fault("constraints created energy, J", books_.created());
    result_.apart = std::max(result_.apart, books_.apart() / scale);
    result_.excess = std::max(result_.excess, books_.excess() / scale);
    if (!(books_.excess() <= bounds_.excess * scale))
      fault("there is more energy than was put in, J", books_.excess());
    if (scene_.robot_bodies > 0) return;
    result_.given = result_.steps == 1 ? books_.given() / scale
                                       : std::max(result_.given, books_.given() / scale);
    if (!(books_.given() <= bounds_.created * scale))
      fault("a step gave energy, J", books_.given());
  }

  void look_at_places() {
    for (int body = scene_.robot_bodies + 1; body < scene_.model.body_count(); ++body) {
      const Vector3& p = sim_.kinematics().X_WL[static_cast<std::size_t>(body)].p;
      if (!((p - made_.low).minCoeff() >= 0 && (made_.high - p).minCoeff() >= 0))
        fault(scene_.model.body_name[static_cast<std::size_t>(body)] + " is lost, height in m",
              p.z());
    }
  }

  Bounds bounds_;
  Chance chance_;
  SoakScene made_;
  SceneModel scene_;
  SceneCouplings couplings_;
  Simulation sim_;
  ContactConstraints contacts_;
  JointLimits limits_;
  Shoves shoves_;
  EnergyBooks books_;
  EpisodeResult result_;
};

}  // namespace

EpisodeResult run_episode(const std::string& scene, std::uint64_t seed, long episode,
                          double seconds, const std::function<bool()>& go_on) {
  return Episode(scene, seed, episode).run(seconds, go_on);
}

}  // namespace twinarm::soak
