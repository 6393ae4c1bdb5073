// Virtual walls of the device alone, by rate, delay and damping, and in the plane of K and B;
// stiffness of a wall through a virtual coupling: a link pressed against it by its target robot.

#include "app/zwidth/zwidth.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "coupling/device/device_motion.h"
#include "coupling/device/force_feedback.h"
#include "solver/dynamics/model_builder.h"
#include "solver/forces/force_source.h"
#include "solver/forces/spring.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

WallRow wall_row(const SampledDevice& device, double wall_damping) {
  WallRow row;
  row.device = device;
  row.wall_damping = wall_damping;
  SampledDevice smooth = device;  // linear device of the other laws
  smooth.friction = smooth.resolution = 0;
  row.stable = max_stable_stiffness(smooth, wall_damping);
  row.stable_law = uncoupled_stiffness(smooth, wall_damping);
  row.passive = max_passive_stiffness(smooth, 0);
  row.passive_law = colgate_stiffness(smooth, 0);
  row.passive_damping = max_passive_damping(smooth, 0);
  row.quantized = row.quantized_law = std::numeric_limits<double>::quiet_NaN();
  if (device.resolution > 0 && device.delay == 0) {
    row.quantized = max_passive_stiffness(device, 0);
    row.quantized_law = abbott_okamura_stiffness(device);
  }
  return row;
}

constexpr double kLink = 0.4, kLinkMass = 1;  // of the link [m], [kg]

Model<double> pressed_link() {
  const double I = kLinkMass * kLink * kLink / 12;
  ModelBuilder builder;
  builder.add_body("link", 0, "joint", JointType::revolute, {}, Vector3::UnitZ(),
                   {kLinkMass, {kLink / 2, 0, 0}, Vector3(0.01 * I, I, I).asDiagonal()});
  return builder.build();
}

DeviceMotion motion_at(double angle) {
  DeviceStep step{0, 1, {}};
  OperatorMapping{}.set_robot_angle(step.sample, 0, angle, 0);
  DeviceMotion motion(1);
  motion.set(step);
  return motion;
}

// Force on the device at the link's end, at rest [N].
double force_at_rest(double k_c, double k_e, double angle) {
  const Model<double> model = pressed_link();
  const DeviceMotion hand = motion_at(angle);
  TargetRobot kvr(model, hand, OperatorMapping{}, {{"joint"}, "", 0, 0});
  CouplingSpec spec;
  spec.type = CouplingSpec::Type::linear;
  spec.discretization = Discretization::implicit;
  spec.springs = {{"end", 1, {kLink, 0, 0}, k_c, 2 * std::sqrt((k_c + k_e) * kLinkMass / 3)}};
  const auto coupling = make_coupling(spec, model, kvr);
  // The wall acts on the link's end for y > 0.
  ForceLaw wall([k_e](const State<double>&, const Kinematics& K, Forces<double>& forces) {
    const Vector3 p = K.position(1, {kLink, 0, 0});
    if (p.y() > 0) add_point_force(K, 1, p, Vector3(0, -k_e * p.y(), 0), forces);
  });
  Simulation simulation(model, State<double>(model));
  simulation.add(*coupling);
  simulation.add(wall);
  CouplingReaction reaction(model, {1});
  reaction.add(spec, *coupling);
  constexpr double h = 1e-3;
  double torque = 0;
  for (int n = 0; n < 3000; ++n) {
    simulation.step(h);
    torque = reaction.after_step(kvr.end(), simulation.state(), simulation.kinematics(), h)[0];
  }
  return torque / kLink;
}

}  // namespace

std::vector<WallRow> measure_walls(const SampledDevice& device, double wall_damping,
                                   const Tell& tell) {
  std::vector<SampledDevice> devices{device};
  const auto with = [&](auto change) {
    devices.push_back(device);
    change(devices.back());
  };
  for (const int more : {1, 2, 5}) with([&](SampledDevice& d) { d.delay += more; });
  for (const double factor : {0.5, 2.0, 4.0}) with([&](SampledDevice& d) { d.rate *= factor; });
  for (const double factor : {5.0, 20.0, 50.0})
    with([&](SampledDevice& d) { d.damping *= factor; });
  std::vector<WallRow> rows;
  for (const SampledDevice& d : devices) {
    rows.push_back(wall_row(d, wall_damping));
    tell(static_cast<double>(rows.size()) / static_cast<double>(devices.size()));
  }
  return rows;
}

WallPlane measure_plane(const SampledDevice& device, const Tell& tell) {
  WallPlane plane;
  plane.device = device;
  plane.device.friction = plane.device.resolution = 0;
  constexpr int kPoints = 16;
  const double b = device.damping, max_B = device.mass / device.tick();
  const double min_B = 0.02 * (b > 0 ? b : 1);
  for (int n = 0; n < kPoints; ++n) {
    const double part = n / (kPoints - 1.0);
    plane.stable_B.push_back(min_B * std::pow(max_B / min_B, part));
    plane.stable_K.push_back(max_stable_stiffness(plane.device, plane.stable_B.back()));
    if (b > 0 && n % 2 == 0) {
      plane.passive_B.push_back(min_B * std::pow(0.97 * b / min_B, part));
      plane.passive_K.push_back(max_passive_stiffness(plane.device, plane.passive_B.back()));
    }
    tell((n + 1.0) / kPoints);
  }
  return plane;
}

std::vector<SeriesRow> measure_series(const Tell& tell) {
  std::vector<SeriesRow> rows;
  for (const double k_c : {200.0, 1000.0, 5000.0})
    for (const double k_e : {500.0, 2000.0, 20000.0}) {
      const double near = 0.001 / kLink, far = 0.003 / kLink;  // 1 and 3 mm of the device
      const double rise = force_at_rest(k_c, k_e, far) - force_at_rest(k_c, k_e, near);
      rows.push_back({k_c, k_e, -rise / (kLink * (far - near)), series_stiffness(k_c, k_e)});
      tell(static_cast<double>(rows.size()) / 9);
    }
  return rows;
}

}  // namespace twinarm
