// Operator, device, network, remote robot: positions go one way, forces come back, both delayed.
//
//   operator (arm impedance about a wanted position) - device - network - KVR = coupling = DVR -
//   wall
//
// The coupling's reaction goes back. The operator pushes to 20 mm beyond the wall, stays, and
// returns. Energy put in by the operator: E_n = E_n-1 - F (x_n - x_n-1), never negative for a
// passive robot.
#include <deque>
#include <random>
#include <utility>

#include "app/zwidth/zwidth.h"
#include "coupling/device/device_motion.h"
#include "coupling/device/force_feedback.h"
#include "coupling/device/omni.h"
#include "solver/dynamics/model_builder.h"
#include "solver/forces/force_source.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

constexpr double kRobotMass = 1, kCoupling = 150, kWall = 2000;  // [kg], [N/m], [N/m]
constexpr double kArmMass = 0.3, kArmSpring = 300,
                 kArmDamper = 5;  // of the operator's arm; assumed
constexpr double kRunTime = 8;    // [s]

// Delays and loses packets; its output is the newest packet that has arrived.
class Network {
 public:
  Network(const DelayRow& row, unsigned seed) : row_(row), engine_(seed) {}
  double pass(double now, double value) {
    std::uniform_real_distribution<double> any(0, 1);
    const double late = row_.delay + row_.jitter * any(engine_);
    if (any(engine_) >= row_.loss) packets_.push_back({now, now + late, value});
    for (auto packet = packets_.begin(); packet != packets_.end();) {
      if (packet->arrives > now + 1e-12) {
        ++packet;
        continue;
      }
      if (packet->sent >= newest_) {
        newest_ = packet->sent;
        value_ = packet->value;
      }
      packet = packets_.erase(packet);
    }
    return value_;
  }

 private:
  struct Packet {
    double sent, arrives, value;
  };
  DelayRow row_;
  std::mt19937 engine_;
  std::deque<Packet> packets_;
  double newest_ = -1, value_ = 0;
};

Model<double> rail_robot() {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body("robot", 0, "rail", JointType::prismatic, {}, Vector3::UnitX(),
                   {kRobotMass, Vector3::Zero(), Matrix3::Identity()});
  return builder.build();
}

struct RemoteRobot {
  Model<double> model = rail_robot();
  DeviceMotion hand{1};  // from the position received a tick ago to that received now
  double received;
  TargetRobot kvr;
  std::unique_ptr<Coupling> coupling;
  ForceLaw wall{[](const State<double>& x, const Kinematics&, Forces<double>& forces) {
    if (x.q[0] > 0) forces.tau[0] -= kWall * x.q[0] + 5 * x.qd[0];
  }};
  Simulation simulation;
  CouplingReaction reaction{model, {1}};

  explicit RemoteRobot(double start)
      : received(start),
        kvr(model, hand, OperatorMapping{}, {{"rail"}, "", 0, 0}),
        simulation(model, [&] {
          State<double> x(model);
          x.q[0] = start;
          return x;
        }()) {
    hand.set({{start}, {0}, false}, 0, 0);
    kvr.set_pose(simulation.state());
    CouplingSpec spec;
    spec.discretization = Discretization::implicit;
    spec.measure = SpringSpace::joint;
    spec.springs = {{"rail", 1, {}, kCoupling, 2 * std::sqrt(kCoupling * kRobotMass)}};
    coupling = make_coupling(spec, model, kvr);
    reaction.add(spec, *coupling);
    simulation.add(*coupling);
    simulation.add(wall);
  }
  double follow(double position, double h) {  // returns the force on the operator [N]
    const double before = std::exchange(received, position);
    hand.set({{before}, {(position - before) / h}, false}, simulation.state().t, h);
    simulation.step(h);
    return reaction.after_step(kvr.end(), simulation.state(), simulation.kinematics(), h)[0];
  }
};

// One second to 20 mm beyond the wall, four there, one back.
double wanted_position(double t) {
  const double s = t < 1 ? t : t > 5 ? std::max(0.0, 6 - t) : 1.0;
  return -0.02 + 0.04 * s * s * s * (10 - 15 * s + 6 * s * s);
}

void run_delay(const SampledDevice& device, unsigned seed, DelayRow& row) {
  const double h = device.tick(), m = device.mass + kArmMass, start = wanted_position(0);
  const OmniParameters omni;
  Network there(row, seed), back(row, seed + 1);
  RemoteRobot robot(start);
  // Speed of at most 1 m/s; damping limited by the device's mass.
  PassivityControl passivity(omni.peak_force * h, 0.5 * device.mass / (h * h));
  double x = start, v = 0, E = 0, farthest = 0, low = 0, high = 0, force = 0;
  long pressed = 0;
  constexpr int kParts = 10;
  for (long n = 0; static_cast<double>(n) * h < kRunTime; ++n) {
    const double t = static_cast<double>(n) * h;
    const double arrived = n == 0 ? start : there.pass(t, x - start) + start;
    const double wanted = back.pass(t, robot.follow(arrived, h));
    const double F = row.control ? passivity.tick({x, 0, 0}, {wanted, 0, 0}, omni.peak_force).x()
                                 : std::clamp(wanted, -omni.peak_force, omni.peak_force);
    const double before = x;
    for (int part = 0; part < kParts; ++part) {
      const double arm = kArmSpring * (wanted_position(t) - x) - (kArmDamper + device.damping) * v;
      v += h / kParts * (arm + F) / m;
      x += h / kParts * v;
    }
    E -= F * (x - before);
    row.lowest = std::min(row.lowest, E);
    farthest = std::max(farthest, std::abs(x - before));
    if (t > 2 && t < 5) force -= F, ++pressed;
    if (t > kRunTime - 1) low = std::min(low, x - start), high = std::max(high, x - start);
    if (n % std::max(1L, std::lround(0.01 / h)) == 0) {
      row.t.push_back(t);
      row.energy.push_back(E);
      row.position.push_back(x);
    }
  }
  row.end = E;
  row.tick_work = omni.peak_force * farthest;
  row.amplitude = high - low;
  row.force = pressed ? force / static_cast<double>(pressed) : 0;
}

}  // namespace

std::vector<DelayRow> measure_delays(const SampledDevice& device, unsigned seed, const Tell& tell) {
  const DelayRow links[] = {
      {.name = "none"},
      {.name = "10 ms", .delay = 0.01},
      {.name = "50 ms", .delay = 0.05},
      {.name = "100 ms", .delay = 0.1},
      {.name = "jitter", .delay = 0.08, .jitter = 0.04},
      {.name = "loss", .delay = 0.1, .loss = 0.3},
      {.name = "jitter and loss", .delay = 0.08, .jitter = 0.04, .loss = 0.3}};
  std::vector<DelayRow> rows;
  for (const DelayRow& link : links)
    for (const bool control : {false, true}) {
      DelayRow& row = rows.emplace_back(link);
      row.control = control;
      run_delay(device, seed, row);
      tell(static_cast<double>(rows.size()) / 14);
    }
  return rows;
}

}  // namespace twinarm
