// D5: stiff flyball governor. A shaft rotates about z; two rods of 1 m are hinged to it at height 1
// m, 0.05 m from its axis, with 5 kg at their ends; couplers of 0.5 m connect their centres with
// the sides of a slider on the shaft at height s. Start: rods 30 degrees below the horizontal, s =
// 0.5 m, 2 pi rad/s. Rods and shaft are bars of 1 x 0.01 x 0.01 m, the slider a cube of 0.1 m, 3000
// kg/m^3.

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "solver/forces/spring.h"

namespace twinarm {
namespace {

constexpr double k_coupler = 8e5, b_coupler = 4e4, rest_length = 0.5;
const Vector3 kRodMiddle(0.5, 0, 0);  // in link axes
constexpr double kSide = 0.05;        // of slider and hinges from the axis

// Both couplers as forces along the lines between their ends.
std::shared_ptr<ForceSource> coupler_forces(const std::array<int, 2>& rods, int slider) {
  return std::make_shared<ForceLaw>([=](const auto&, const Kinematics& k, Forces<double>& forces) {
    for (const int body : rods) {
      const Vector3 to = k.position(slider, {body == rods[0] ? kSide : -kSide, 0, 0});
      const Vector3 from = k.position(body, kRodMiddle), line = to - from;
      const double length = line.norm();
      const Vector3 n = line / length;
      const double rate = n.dot(k.velocity(slider, to) - k.velocity(body, from));
      const Vector3 f = (k_coupler * (length - rest_length) + b_coupler * rate) * n;
      add_point_force(k, body, from, f, forces);
      add_point_force(k, slider, to, -f, forces);
    }
  });
}

// Both as struts with a prismatic joint whose force is evaluated at the end of the step:
// F = -k (x + h v') - b v', v' = v + h qdd: h b + h^2 k is an added armature
// (solver/forces/spring.h).
struct StrutSprings final : ForceSource {
  std::array<std::size_t, 2> dofs;
  double h = 0;
  explicit StrutSprings(std::array<std::size_t, 2> strut_dofs) : dofs(strut_dofs) {}
  void begin_step(const Kinematics&, double, double step) noexcept override { h = step; }
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    for (const std::size_t d : dofs) {
      forces.tau[d] -= k_coupler * (x.q[d] + h * x.qd[d]) + b_coupler * x.qd[d];
      forces.armature[d] += h * b_coupler + h * h * k_coupler;
    }
  }
  bool needs_semi_implicit() const override { return true; }
};

// A bar of 1 m along x with 5 kg at its end.
BodyInertia rod_and_ball() {
  constexpr double bar = 0.3, ball = 5, mass = bar + ball;
  const double com = (bar * 0.5 + ball) / mass;
  const double across =
      bar * (1 + 1e-4) / 12 + bar * (com - 0.5) * (com - 0.5) + ball * (1 - com) * (1 - com);
  return {mass, {com, 0, 0}, Vector3(bar * 2e-4 / 12, across, across).asDiagonal()};
}

void set_reference(LoopCase& c, Couplers couplers) {
  c.readings = {"s [m]"};
  c.reference = {{0.1, {0.5238364755695755}}, {0.25, {0.6220927215961464}},
                 {0.5, {0.7432494247863226}}, {1, {0.5014209223795681}},
                 {2, {0.5059092942967035}},   {5, {0.535563103721643}},
                 {10, {0.6196229170613594}}};
  if (couplers == Couplers::rods) c.reference = {{10, {0.6196414445946037}}};
}

}  // namespace

LoopCase governor(Couplers couplers) {
  constexpr double angle = std::numbers::pi / 6, omega = 2 * std::numbers::pi;
  LoopCase c{};
  ModelBuilder builder;
  const double axial = 0.3 * 2e-4 / 12;
  const int shaft =
      builder.add_body("shaft", 0, "bearing", JointType::revolute, {}, Vector3::UnitZ(),
                       {0.3,
                        {0, 0, 0.5},
                        Vector3(0.3 * (1 + 1e-4) / 12, 0.3 * (1 + 1e-4) / 12, axial).asDiagonal()});
  const int slider =
      builder.add_body("slider", shaft, "slide", JointType::prismatic, {}, Vector3::UnitZ(),
                       {3, Vector3::Zero(), 0.005 * Matrix3::Identity()});
  std::array<int, 2> rods{};
  std::array<std::size_t, 2> struts{};
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string n = side == 0 ? "_right" : "_left";
    Pose top = at(side == 0 ? kSide : -kSide, 0, 1);
    if (side == 1) top.R = Vector3(-1, -1, 1).asDiagonal();
    rods[side] = builder.add_body("rod" + n, shaft, "hinge" + n, JointType::revolute, top,
                                  Vector3::UnitY(), rod_and_ball());
    if (couplers == Couplers::springs) continue;
    LoopClosure end{"coupler" + n, LoopType::distance, rods[side], slider, {{}, kRodMiddle}, {}};
    end.X_LaC.R.setIdentity();
    end.X_LbC.p.x() = side == 0 ? kSide : -kSide;
    end.length = rest_length;
    if (couplers == Couplers::implicit_struts) {
      // Rotated so that its x points to the slider when rod and strut are 30 degrees below and
      // above the horizontal.
      const BodyInertia light{1e-6, Vector3::Zero(), 1e-6 * Matrix3::Identity()};
      const int pin = builder.add_body("pin" + n, rods[side], "pin" + n, JointType::revolute,
                                       at(0.5, 0, 0), Vector3::UnitY(), light);
      const int tip = builder.add_body("strut" + n, pin, "strut" + n, JointType::prismatic,
                                       at(-rest_length, 0, 0), -Vector3::UnitX(), light);
      struts[side] = static_cast<std::size_t>(tip);
      end = {"end" + n, LoopType::ball, tip, slider, {}, end.X_LbC};
    }
    c.loops.push_back(end);
  }
  c.set_model(builder.build());
  const auto iv = [&](int body) { return c.model.iv[static_cast<std::size_t>(body)]; };
  c.start.q[iv(slider)] = 0.5;
  c.start.qd[iv(shaft)] = omega;
  for (std::size_t side = 0; side < 2; ++side) {
    c.start.q[iv(rods[side])] = angle;
    if (couplers != Couplers::implicit_struts) continue;
    struts[side] = c.model.iv[struts[side]];
    c.start.q[struts[side] - 1] = -2 * angle;
  }
  if (couplers == Couplers::springs) c.sources = {coupler_forces(rods, slider)};
  if (couplers == Couplers::implicit_struts) c.sources = {std::make_shared<StrutSprings>(struts)};
  c.read = [i = iv(slider)](const State<double>& x, const Kinematics&) {
    return std::vector{x.q[i]};
  };
  set_reference(c, couplers);
  c.step = couplers == Couplers::springs ? 1e-4 : 1e-3;
  c.tolerance = 1e-8;
  return c;
}

}  // namespace twinarm
