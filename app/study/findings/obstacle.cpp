
#include "app/study/findings/findings.h"
#include "collision/contact/contact_constraints.h"

namespace twinarm {
namespace {

// Contacts of the box with the collision hulls of all links but the base, as of the scene of the
// run (study_run.h).
class BoxContacts {
 public:
  BoxContacts(const StudyInputs& inputs, const Model<double>& model,
              const StudySettings::Obstacle& box)
      : contacts_(model, ContactResponse::compliant) {
    const StudySettings& s = inputs.settings;
    ContactBodies& bodies = contacts_.bodies();
    for (const LinkDescription& link : inputs.s103.links) {
      if (link.name == inputs.s103.root) continue;
      for (const CollisionPart& part : link.collisions)
        if (const auto* mesh = std::get_if<MeshGeometry>(&part.geometry))
          bodies.add({link.name + "/" + part.name,
                      model.find_body(link.name),
                      part.X_LG(),
                      convex_hull(load_mesh(*mesh).vertices),
                      {},
                      kLinks});
    }
    box_ = bodies.add({"box", 0, {Matrix3::Identity(), box.position}, Box{box.size}, {}, 0});
    for (int link = 0; link < box_; ++link)
      bodies.set_pair(link, box_,
                      {s.contact_friction, 0, 0, 0, s.contact_stiffness, s.contact_dissipation});
  }
  ContactConstraints& source() { return contacts_; }

  // Appends the last step's sums to the result.
  void read(const Kinematics& k_D, const Kinematics& k_K, ObstacleRun& result) const {
    double force = 0, beyond = 0, depth = 0;
    for (const ContactPoint& point : contacts_.points()) {
      const Contact& c = point.contact;
      depth = std::max(depth, c.depth);
      const double N = point.force_W.dot(c.n_W);
      if (N <= 0) continue;
      force += N;
      beyond = std::max(beyond, beyond_face(c, k_D, k_K));
    }
    result.contact_force.push_back(force);
    result.beyond.push_back(beyond);
    result.penetration.push_back(depth);
  }

 private:
  static constexpr int kLinks = 1;  // group

  // Depth of the KVR's copy of a contact point behind the face that stops the DVR.
  double beyond_face(const Contact& c, const Kinematics& k_D, const Kinematics& k_K) const {
    const int body = contacts_.bodies().geometry(c.b == box_ ? c.a : c.b).body;
    const auto i = static_cast<std::size_t>(body);
    const Vector3 p_W = contacts_.bodies().application_point(c, body);
    const Vector3 out_of_box = c.b == box_ ? Vector3(-c.n_W) : c.n_W;
    return (p_W - k_K.X_WL[i] * (k_D.X_WL[i].inverse() * p_W)).dot(out_of_box);
  }

  ContactConstraints contacts_;
  int box_ = 0;
};

// Implicit point springs: R_K / r and its limit where they come nearest to each other.
void watch_target_radius(TrackingSystem& system, double t, const RunSpec& spec,
                         ObstacleRun& result) {
  const Simulation& dvr = system.simulation();
  for (const Spring& spring : system.coupling(0).springs()) {
    const TargetRadius radius =
        nearest_target_radius(dvr.mechanism().model(), dvr.state(), dvr.kinematics(),
                              system.kvr().at(t).k, spring, spec.step());
    if (radius.ratio() > 1 && result.exceeded_at < 0) result.exceeded_at = t;
    const double nearest = result.target_radius_limit > 0
                               ? result.target_radius_ratio / result.target_radius_limit
                               : 0;
    if (radius.ratio() <= nearest) continue;
    result.target_radius_ratio = radius.R_K / radius.r;
    result.target_radius_limit = radius.largest / radius.r;
  }
}

ObstacleRun run_obstacle(const StudyInputs& inputs, const StudyRobot& robot,
                         const StudySettings::Obstacle& box, RunSpec spec, const char* name) {
  ObstacleRun result;
  result.obstacle = &box;
  spec.coupling.name = name;
  spec.name = std::string("obstacle_") + name;
  result.spec = spec;
  const Model<double>& model = robot.dvr_model(spec.coupling.type);
  const bool has_limit = spec.coupling.type == CouplingSpec::Type::linear &&
                         spec.coupling.discretization == Discretization::implicit;

  const AutomaticMotion hand{OperatorMapping{}};
  TrackingSystem system(tracking_setup(robot, hand, spec));
  JointStops stops("stops", model, robot.stops());
  system.simulation().add(stops);
  BoxContacts contacts(inputs, model, box);
  system.simulation().add(contacts.source());

  const TrackingSeries series = system.run([&](double t) {
    double coupling = 0;
    for (const SpringState& reading : system.coupling(0).readings())
      coupling = std::max(coupling, reading.size);
    result.coupling.push_back(coupling);
    contacts.read(system.simulation().kinematics(), system.kvr().at(t).k, result);
    if (has_limit && t > 0) watch_target_radius(system, t, spec, result);
  });
  result.finite = series.finite;
  result.t = series.t;
  for (std::size_t j = 0; j < 2; ++j) {
    result.q_K_deg[j] = in_degrees(series.q_K[j]);
    result.q_D_deg[j] = in_degrees(series.q_D[j]);
  }
  result.max_penetration = std::ranges::max(result.penetration);
  result.max_beyond = std::ranges::max(result.beyond);
  result.max_coupling = std::ranges::max(result.coupling);
  result.max_force = std::ranges::max(result.contact_force);
  double longest = 0;
  for (const auto& [begin, end] : contact_intervals(result, 1.5 * spec.step())) {
    if (end - begin <= longest) continue;
    longest = end - begin;
    result.contact_begin = begin;
    result.contact_end = end;
  }
  return result;
}

}  // namespace

std::vector<std::pair<double, double>> contact_intervals(const ObstacleRun& run, double gap) {
  std::vector<std::pair<double, double>> intervals;
  for (std::size_t n = 0; n < run.t.size(); ++n) {
    if (run.contact_force[n] <= 0) continue;
    if (!intervals.empty() && run.t[n] - intervals.back().second < gap)
      intervals.back().second = run.t[n];
    else
      intervals.emplace_back(run.t[n], run.t[n]);
  }
  return intervals;
}

std::vector<ObstacleRun> run_obstacles(const StudyInputs& inputs, const StudyRobot& robot,
                                       const Calibration& calibration) {
  const StudySettings& s = inputs.settings;
  const std::vector<RunSpec> paper = reproduction_specs(calibration);
  RunSpec linear = paper.at(3), torsional = paper.at(2), far;
  linear.title = "linear coupling of E4, with a box";
  torsional.title = "torsional coupling of E3, with a box";
  far.title = "stiff implicit linear coupling, with a box that lets the target get far";
  far.coupling.type = CouplingSpec::Type::linear;
  far.coupling.discretization = Discretization::implicit;
  far.rate = s.far_target.rate_hz;
  far.gains = gains_from_frequency(robot, far.coupling, s.far_target.frequency_hz,
                                   s.far_target.damping_ratio);
  return {run_obstacle(inputs, robot, s.obstacle, linear, "linear"),
          run_obstacle(inputs, robot, s.obstacle, torsional, "torsional"),
          run_obstacle(inputs, robot, s.far_target.obstacle, far, "far")};
}

}  // namespace twinarm
