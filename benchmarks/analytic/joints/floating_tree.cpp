// A5, a floating tree of four links with joints of four types. Without gravity, momentum P and
// angular momentum H about the origin are constant for any joint torques; under gravity
//   P(t) = P0 + m g t,   H(t) = H0 + (m c0 t + P0 t^2 / 2) x g,   c0 the initial centre of mass,
// and energy is constant without joint damping. A body that falls under semi-implicit steps of h
// deviates from the parabola by -g h t / 2, and its energy by -m g^2 h t / 2 (its recurrence,
// exact).
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {
namespace {

const Vector3 kG(0.3, -0.2, -kGravity);

Model<double> tree(const Vector3& gravity) {
  ModelBuilder builder;
  builder.set_gravity(gravity);
  const auto inertia = [](double mass, double a, double b, double c) {
    return BodyInertia{mass, {0.1, -0.05, 0.2}, Vector3(a, b, c).asDiagonal()};
  };
  const auto at = [](double x, double y, double z) {
    return Pose{Eigen::AngleAxisd(x + y, Vector3(1, 2, 3).normalized()).toRotationMatrix(),
                {x, y, z}};
  };
  const int trunk = builder.add_body("trunk", 0, "float", JointType::free, {}, Vector3::UnitZ(),
                                     inertia(3, 0.2, 0.3, 0.4));
  const int arm = builder.add_body("arm", trunk, "shoulder", JointType::spherical, at(0.2, 0.3, 0),
                                   Vector3::UnitZ(), inertia(1, 0.05, 0.06, 0.04));
  builder.add_body("hand", arm, "wrist", JointType::universal, at(0, 0.1, 0.4), Vector3::UnitX(),
                   inertia(0.5, 0.02, 0.03, 0.02));
  builder.add_body("leg", trunk, "hip", JointType::revolute, at(-0.2, 0.1, -0.3), {1, 1, 0},
                   inertia(1.5, 0.05, 0.04, 0.06));
  return builder.build();
}

CaseScene tumbling(const Vector3& gravity) {
  CaseScene scene = at_rest(tree(gravity));
  const double rates[] = {0.5, -0.3, 0.8, 0.4, -0.2, 0.3, 0.6, -0.7, 0.5, 0.4, -0.6, 0.9};
  scene.start.qd.assign(std::begin(rates), std::end(rates));
  return scene;
}

struct TreeMomenta {
  Vector3 P, H, com;
  double mass;
};
TreeMomenta momenta_of(ModelRef model, StateRef x) {
  Workspace<double> w(model);
  kinematics(model, x, w);
  const Force<double> all = momentum(model, w);
  const MassAndCom<double> total = mass_and_com(model, w);
  return {to_eigen(all.f), to_eigen(all.n), to_eigen(total.com), total.mass};
}
CaseReadings observe_momenta(ModelRef model, StateRef x) {
  const TreeMomenta all = momenta_of(model, x);
  return {all.P.x(), all.P.y(), all.P.z(), all.H.x(), all.H.y(), all.H.z()};
}
CaseReadings momenta_after(double t, const Vector3& gravity) {
  static const TreeMomenta start = [] {
    const CaseScene scene = tumbling(Vector3::Zero());
    return momenta_of(scene.model, scene.start);
  }();
  const Vector3 P = start.P + start.mass * t * gravity;
  const Vector3 H = start.H + (start.mass * t * start.com + t * t / 2 * start.P).cross(gravity);
  return {P.x(), P.y(), P.z(), H.x(), H.y(), H.z()};
}
// max(|dP| / |P|, |dH| / |H|).
double momenta_error(const CaseReadings& seen, const CaseReadings& exact) {
  const Eigen::Map<const Eigen::VectorXd> a(seen.data(), 6), b(exact.data(), 6);
  return nan_max((a - b).head<3>().norm() / b.head<3>().norm(),
                 (a - b).tail<3>().norm() / b.tail<3>().norm());
}

TrajectoryCase momenta() {
  CaseScene scene = not_conserving(tumbling(Vector3::Zero()));
  for (const std::size_t dof : {6, 9, 11})
    scene.sources.push_back(
        joint_effort([](double t, double) { return 0.1 * std::cos(2 * t); }, dof));
  return {
      .scene = fixed(scene),
      .times = {2, 5, 10},
      .readings = {"Px [N s]", "Py [N s]", "Pz [N s]", "Hx [N m s]", "Hy [N m s]", "Hz [N m s]"},
      .observe = observe_momenta,
      .reference = [](double t) { return momenta_after(t, Vector3::Zero()); },
      .measure = momenta_error,
      .mutant = more_inertia};
}

TrajectoryCase falling() {
  TrajectoryCase c = momenta();
  c.scene = [] { return tumbling(kG); };
  c.reference = [](double t) { return momenta_after(t, kG); };
  c.mutant = more_gravity;
  return c;
}

TrajectoryCase energy() {
  TrajectoryCase c = falling();
  c.readings = {"energy [J]"};
  c.observe = observe_energy;
  c.reference = [](double) {
    static const double at_start = [] {
      const CaseScene scene = tumbling(kG);
      return kinetic_energy(scene.model, scene.start) + potential_energy(scene.model, scene.start);
    }();
    return values(at_start);
  };
  c.measure = relative_to_largest;
  return c;
}

TrajectoryCase ballistic() {
  Model<double> model = free_body(2, {0.1, 0.2, 0.25});
  model.gravity = {0, 0, -kGravity};
  return {.scene = fixed(not_conserving(at_rest(std::move(model)))),
          .times = {0.5, 1, 2},
          .readings = {"energy [J]"},
          .observe = observe_energy,
          .reference = [](double t) { return values(-2 * kGravity * kGravity * 1e-3 * t / 2); },
          .integration = {Integrator::semi_implicit, 1e-3},
          .needs_its_integrator = true};
}

}  // namespace

CaseFamily floating_tree_cases() {
  return {40,
          {{"A5-momentum", 1e-9, momenta()},
           {"A5-gravity", 1e-9, falling()},
           {"A5-energy", 1e-9, energy()},
           {"A5-ballistic", 1e-9, ballistic()}}};
}

}  // namespace twinarm
