#include <algorithm>

#include "app/study/findings/variants.h"
#include "collision/contact/contact_force.h"
#include "collision/geometry/convex_hull.h"
#include "collision/import/robot/robot_model.h"

namespace twinarm {
namespace {

// Collision hulls of all links but the base, and the box.
void add_geometry(const StudyInputs& inputs, const Model<double>& model, ContactForce& contact) {
  for (const LinkDescription& link : inputs.s103.links) {
    const int body = model.find_body(link.name);
    if (link.name == inputs.s103.root) continue;
    for (const CollisionPart& part : link.collisions) {
      const auto* mesh = std::get_if<MeshGeometry>(&part.geometry);
      if (!mesh) continue;
      contact.add(body, part.X_LG(), link.name + "/" + part.name,
                  convex_hull(load_mesh(*mesh).vertices));
    }
  }
  const StudySettings::Obstacle& box = inputs.settings.obstacle;
  contact.add(0, {Matrix3::Identity(), box.position}, "obstacle", Box{box.size});
}

// Depth of the KVR's copy of a contact point behind the face that stops the DVR.
double beyond_face(const ContactReading& reading, const Kinematics& k_D, const Kinematics& k_K) {
  const auto i = static_cast<std::size_t>(reading.body);
  const Vector3 p_L = k_D.X_WL[i].inverse() * reading.p_W;
  return -(k_K.X_WL[i] * p_L - reading.p_W).dot(reading.normal_W);
}

// Updates the spring and joint whose target radius is closest to its limit.
void watch_target_radius(const Coupling& coupling, const Model<double>& model,
                         const State<double>& x, const Kinematics& k, double h, ObstacleRun& result,
                         double& nearest) {
  const Eigen::MatrixXd M = mass_matrix(model, x);
  for (std::size_t s = 0; s < coupling.springs().size(); ++s) {
    const Spring& spring = coupling.springs()[s];
    const SpringState& reading = coupling.readings()[s];
    for (int body = spring.body; body > 1; body = model.parent[static_cast<std::size_t>(body)]) {
      const auto i = static_cast<std::size_t>(body);
      const auto dof = static_cast<Eigen::Index>(model.iv[i]);
      const Vector3 o = k.X_WL[i].p;
      const double r = (reading.p_D - o).head<2>().norm();
      const double R_K = (reading.p_K - o).head<2>().norm();
      const double limit = max_target_radius(M(dof, dof), r, spring.k, spring.b, h);
      result.target_radius_ratio = std::max(result.target_radius_ratio, R_K / r);
      if (R_K / limit <= nearest) continue;
      nearest = R_K / limit;
      result.target_radius_limit = limit / r;
    }
  }
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

ObstacleRun run_obstacle(const StudyInputs& inputs, const StudyRobot& robot,
                         CouplingSpec::Type type) {
  const StudySettings::Obstacle& o = inputs.settings.obstacle;
  const Model<double>& model = robot.dvr_model(type);
  const bool linear = type == CouplingSpec::Type::linear;
  ObstacleRun result;
  RunSpec& spec = result.spec;
  spec.coupling.name = linear ? "linear" : "torsional";
  spec.coupling.type = type;
  spec.coupling.discretization = Discretization::implicit;
  spec.name = "obstacle_" + spec.coupling.name;
  spec.title = spec.coupling.name + ", automatic, with a box";
  spec.gains =
      gains_from_frequency(robot, spec.coupling, o.coupling_frequency_hz, o.coupling_damping_ratio);
  spec.rate = o.rate_hz;

  const AutomaticMotion hand{OperatorMapping{}};
  TrackingSystem system(tracking_setup(robot, hand, spec));
  JointStops stops("stops", model, robot.stops());
  system.simulation().add(stops);
  ContactForce contact(model, {o.contact_stiffness, o.contact_dissipation, o.friction, 1e-3});
  add_geometry(inputs, model, contact);
  system.simulation().add(contact);

  double nearest = 0;
  const TrackingSeries series = system.run([&](double t) {
    const Kinematics& k = system.simulation().kinematics();
    double force = 0, beyond = 0, coupling = 0;
    for (const ContactReading& reading : contact.readings()) {
      if (reading.normal_force <= 0) continue;
      force += reading.normal_force;
      beyond = std::max(beyond, beyond_face(reading, k, system.kvr().at(t).k));
    }
    for (const SpringState& reading : system.coupling(0).readings())
      coupling = std::max(coupling, reading.size);
    result.coupling.push_back(coupling);
    result.contact_force.push_back(force);
    result.beyond.push_back(beyond);
    result.penetration.push_back(contact.deepest(k));
    if (linear && t > 0)
      watch_target_radius(system.coupling(0), model, system.simulation().state(), k, spec.step(),
                          result, nearest);
  });
  result.t = series.t;
  for (std::size_t j = 0; j < 2; ++j) {
    result.q_K_deg[j] = in_degrees(series.q_K[j]);
    result.q_D_deg[j] = in_degrees(series.q_D[j]);
  }
  const auto largest = [](const std::vector<double>& v) {
    return *std::max_element(v.begin(), v.end());
  };
  result.max_penetration = largest(result.penetration);
  result.max_beyond = largest(result.beyond);
  result.max_coupling = largest(result.coupling);
  result.max_force = largest(result.contact_force);
  double longest = 0;
  for (const auto& [begin, end] : contact_intervals(result, 1.5 * spec.step())) {
    if (end - begin <= longest) continue;
    longest = end - begin;
    result.contact_begin = begin;
    result.contact_end = end;
  }
  return result;
}

}  // namespace twinarm
