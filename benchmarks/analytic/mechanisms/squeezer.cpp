// D3: Andrews' squeezing mechanism (Manning 1981; Hairer and Wanner, Solving ODEs II, VII.7): seven
// bodies in the x-y plane, three loops that meet in E, a motor torque and one spring, no gravity.
//
// K1 rotates about O by beta, with F at its end; K2 rotates about F by Theta and ends in E. K3
// rotates about B by gamma and has E and the spring's end D; K5 and K7 rotate about A by delta and
// epsilon, with H and G at their ends, about which K4 and K6 rotate by Phi and Omega; both end in
// E.

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "solver/forces/spring.h"

namespace twinarm {
namespace {

constexpr double rr = 7e-3, ra = 92e-5, d = 28e-3, da = 115e-4, e = 2e-2, ea = 1421e-5, ss = 35e-3,
                 sa = 1874e-5, sb = 1043e-5, sc = 18e-3, sd = 2e-2, zt = 4e-2, ta = 2308e-5,
                 tb = 916e-5, u = 4e-2, ua = 1228e-5, ub = 449e-5, zf = 2e-2, fa = 1421e-5;
const Vector3 A(-0.06934, -0.00227, 0), B(-0.03635, 0.03273, 0), C(0.014, 0.072, 0);
constexpr double c0 = 4530, l0 = 0.07785, motor = 0.033;

// Motor on K1, spring from D on K3 to C in the world.
void add_motor_and_spring(LoopCase& c, std::size_t crank, int k3) {
  c.sources = {
      std::make_shared<ForceLaw>([=](const auto&, const Kinematics& k, Forces<double>& forces) {
        forces.tau[crank] += motor;
        const Vector3 p = k.position(k3, {sd, -sc, 0}), to_C = C - p;
        const double length = to_C.norm();
        add_point_force(k, k3, p, c0 * (length - l0) / length * to_C, forces);
      })};
  // Of the spring, and minus the work of the motor.
  c.stored = [crank, k3, model = c.model](const State<double>& x) {
    const Kinematics k = kinematics_at(model, x);
    const double stretch = (C - k.position(k3, {sd, -sc, 0})).norm() - l0;
    return c0 / 2 * stretch * stretch - motor * x.q[crank];
  };
}

BodyInertia plate(double mass, double inertia, double x, double y) {
  return {mass, {x, y, 0}, inertia * Matrix3::Identity()};
}

// The seven bodies, in the order beta, Theta, gamma, Phi, delta, Omega, epsilon.
std::array<int, 7> build_squeezer(LoopCase& c) {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  const auto add = [&](const char* name, int parent, const Vector3& p, const BodyInertia& inertia) {
    return builder.add_body(name, parent, std::string("joint_") + name, JointType::revolute,
                            {Matrix3::Identity(), p}, Vector3::UnitZ(), inertia);
  };
  const int k1 = add("K1", 0, Vector3::Zero(), plate(0.04325, 2.194e-6, ra, 0));
  const int k2 = add("K2", k1, {rr, 0, 0}, plate(0.00365, 4.410e-7, -da, 0));
  const int k3 = add("K3", 0, B, plate(0.02373, 5.255e-6, sa, -sb));
  const int k5 = add("K5", 0, A, plate(0.07050, 1.169e-5, ta, tb));
  const int k4 = add("K4", k5, {zt, 0, 0}, plate(0.00706, 5.667e-7, 0, -(e - ea)));
  const int k7 = add("K7", 0, A, plate(0.05498, 1.912e-5, ub, -ua));
  const int k6 = add("K6", k7, {0, -u, 0}, plate(0.00706, 5.667e-7, zf - fa, 0));
  c.set_model(builder.build());
  const auto loop = [&](const char* name, int body, const Vector3& E) {
    c.loops.push_back({name, LoopType::hinge, k2, body, at(-d, 0, 0), {Matrix3::Identity(), E}});
  };
  loop("E on K3", k3, {0, -ss, 0});
  loop("E on K4", k4, {0, -e, 0});
  loop("E on K6", k6, {zf, 0, 0});
  return {k1, k2, k3, k4, k5, k6, k7};
}

}  // namespace

LoopCase squeezer() {
  LoopCase c{};
  const std::array<int, 7> bodies = build_squeezer(c);
  std::vector<std::size_t> order;
  for (const int body : bodies) order.push_back(c.model.iv[static_cast<std::size_t>(body)]);
  const double q0[] = {-0.0617138900142764496, 0,
                       0.455279819163070380,   0.222668390165885885,
                       0.487364979543842550,   -0.222668390165885885,
                       1.23054744454982119};
  for (std::size_t i = 0; i < 7; ++i) c.start.q[order[i]] = q0[i];
  add_motor_and_spring(c, order[0], bodies[2]);
  c.read = [order](const State<double>& x, const Kinematics&) {
    std::vector<double> angles;
    for (const std::size_t i : order) angles.push_back(x.q[i]);
    return angles;
  };
  c.readings = {"beta [rad]",  "Theta [rad]", "gamma [rad]",  "Phi [rad]",
                "delta [rad]", "Omega [rad]", "epsilon [rad]"};
  c.reference = {
      {0.01,
       {2.1601131315315265, -1.8833642311070443, 0.15851675800122669, -0.32864107517467031,
        0.52515477479772946, 0.32864107517467031, 1.0684272046324011}},
      {0.02,
       {8.1849058896616755, -7.8905053637304495, 0.20953691338469756, -0.23832559659585125,
        0.52253691715599637, 0.23832559659585125, 1.0862751085998732}},
      {0.03,
       {15.810771195153707, -15.756371058411839, 0.040822240119645805, -0.53473011634207959,
        0.52440996587995407, 0.53473011634207959, 1.0480807410419379}},
      {0.05,
       {33.825867766954517, -33.583431517463868, 0.11339507381259902, -0.40785286560188444,
        0.52606044491699583, 0.40785286560188444, 1.0569024294349628}}};
  c.step = 2e-6;
  c.tolerance = 1e-8;
  return c;
}

}  // namespace twinarm
