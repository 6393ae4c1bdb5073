#include "benchmarks/analytic/mechanisms/loop_cases.h"

#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

// D1, from 90 degrees at rest: th = 2 asin(k sn(K - w0 t)), th' = -2 k w0 cn(K - w0 t).
CaseReadings swinging(double t) {
  const Real w0 = std::sqrt(9.81L), m = 0.5L, k = std::sqrt(m);
  const special::Jacobi j = special::jacobi(special::quarter_period(m) - w0 * Real(t), m);
  const Real angle = 2 * std::asin(k * j.sn);
  return values(-std::sin(angle), -std::cos(angle), -2 * k * w0 * j.cn);
}

// D2, exact reduction: q'' = a sin q, a = c g / l, c = ((N + 1)/2 + N) / ((N + 1)/3 + N), from
// upright at 1 rad/s. With W^2 = 1 + 4 a, m = 4 a / W^2 and u = W t / 2 - K(m):
//   q = pi + 2 am(u, m),  q' = W dn u.
CaseReadings swinging_posts(int count, double t) {
  const Real n = count, c = ((n + 1) / 2 + n) / ((n + 1) / 3 + n), a = c * 9.81L;
  const Real W = std::sqrt(1 + 4 * a), m = 4 * a / (W * W);
  const special::Jacobi j = special::jacobi(W * Real(t) / 2 - special::quarter_period(m), m);
  const Real sine = -2 * j.sn * j.cn, cosine = 2 * j.sn * j.sn - 1, rate = W * j.dn;
  return values(sine, cosine, cosine * rate, -sine * rate);
}

// D7: a e^(i th2) + b e^(i th3) = d + c e^(i th4), and its derivative.
CaseReadings four_bar_closed_form() {
  constexpr Real a = 0.1L, b = 0.35L, c = 0.3L, d = 0.4L, w2 = 10;
  const Real th2 = kPi / 3;
  // From the crank's end B to the rocker's pivot D; C is at distance b from B, c from D, above BD.
  const Real x = d - a * std::cos(th2), y = -a * std::sin(th2), BD = std::hypot(x, y);
  const Real at_B = std::acos((b * b + BD * BD - c * c) / (2 * b * BD));
  const Real th3 = std::atan2(y, x) + at_B;
  const Real th4 =
      std::atan2(a * std::sin(th2) + b * std::sin(th3), a * std::cos(th2) + b * std::cos(th3) - d);
  const Real w3 = -a * w2 * std::sin(th2 - th4) / (b * std::sin(th3 - th4));
  const Real w4 = a * w2 * std::sin(th2 - th3) / (c * std::sin(th4 - th3));
  return values(th3, th4, w3, w4);
}

}  // namespace

// A body of 1 kg, 0.25 kg m^2, hinged 0.5 m from its centre of mass: equivalent to a particle at
// (I + m c^2) / (m c) = 1 m.
LoopCase pendulum_on_hinge() {
  LoopCase c{};
  ModelBuilder builder;
  builder.add_body("body", 0, "free", JointType::free, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), 0.25 * Matrix3::Identity()});
  c.set_model(builder.build());
  c.start.q[0] = -0.5;
  c.loops = {hinge_closure("pivot", 1, 0, {0.5, 0, 0}, Vector3::Zero())};
  c.read = [](const State<double>& x, const Kinematics& k) {
    return std::vector{2 * k.X_WL[1].p.x(), 2 * k.X_WL[1].p.z(), x.qd[1]};
  };
  c.readings = {"x [m]", "z [m]", "rate [rad/s]"};
  c.set_exact(swinging, {1, 2, 5, 10});
  c.tolerance = 1e-8;
  return c;
}

LoopCase pendulum_on_circle() {
  LoopCase c = pendulum_on_hinge();
  ModelBuilder builder;
  const int slide =
      builder.add_body("slide", 0, "x", JointType::prismatic, {}, Vector3::UnitX(), {});
  builder.add_body("bob", slide, "z", JointType::prismatic, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), Matrix3::Zero()});
  c.set_model(builder.build());
  c.start.q[0] = -1;
  LoopClosure rod{"rod", LoopType::distance, 2, 0};
  rod.length = 1;
  c.loops = {rod};
  c.read = [](const State<double>& x, const Kinematics&) {
    return std::vector{x.q[0], x.q[1], x.q[1] * x.qd[0] - x.q[0] * x.qd[1]};
  };
  return c;
}

LoopCase windows(int count) {
  LoopCase c{};
  ModelBuilder builder;
  std::vector<int> posts, beams;
  for (int i = 0; i <= count; ++i) {
    const std::string n = std::to_string(i);
    posts.push_back(builder.add_body("post" + n, 0, "foot" + n, JointType::revolute, at(i, 0, 0),
                                     Vector3::UnitY(), rod(1, 1, Vector3::UnitZ())));
    if (i < count)
      beams.push_back(builder.add_body("beam" + n, posts.back(), "top" + n, JointType::revolute,
                                       at(0, 0, 1), Vector3::UnitY(), rod(1, 1, Vector3::UnitX())));
  }
  c.set_model(builder.build());
  for (const int post : posts) c.start.qd[c.model.iv[static_cast<std::size_t>(post)]] = 1;
  for (const int beam : beams) c.start.qd[c.model.iv[static_cast<std::size_t>(beam)]] = -1;
  for (std::size_t i = 0; i < beams.size(); ++i)
    c.loops.push_back(hinge_closure("corner" + std::to_string(i + 1), beams[i], posts[i + 1],
                                    {1, 0, 0}, {0, 0, 1}));
  c.read = [](const State<double>& x, const Kinematics&) {
    const double s = std::sin(x.q[0]), r = std::cos(x.q[0]);
    return std::vector{s, r, r * x.qd[0], -s * x.qd[0]};
  };
  c.readings = {"x of B0 [m]", "z of B0 [m]", "vx [m/s]", "vz [m/s]"};
  c.set_exact([count](double t) { return swinging_posts(count, t); }, {1, 10});
  return c;
}

// Joint axes y, z, x, y, z, x at the corners of a path along a cube's edges; the last closes the
// loop.
LoopCase bricard() {
  LoopCase c{};
  ModelBuilder builder;
  builder.set_gravity({0, -9.81, 0});
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  const Vector3 axes[] = {y, z, x, y, z}, along[] = {x, -y, z, -x, y};
  int parent = 0;
  for (int i = 0; i < 5; ++i) {
    BodyInertia bar = rod(1, 1, along[i]);
    const Matrix3 axial = along[i] * along[i].transpose();
    bar.inertia = (1.01 / 12) * (Matrix3::Identity() - axial) + (0.02 / 12) * axial;
    const Pose joint{Matrix3::Identity(), i == 0 ? Vector3(0, 0, 0) : along[i - 1]};
    parent =
        builder.add_body("bar" + std::to_string(i + 1), parent, "joint" + std::to_string(i + 1),
                         JointType::revolute, joint, axes[i], bar);
  }
  c.set_model(builder.build());
  Matrix3 z_along_x;
  z_along_x << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  c.loops = {{"joint6", LoopType::hinge, 5, 0, {z_along_x, y}, {z_along_x, z}}};
  c.read = [](const State<double>&, const Kinematics& k) {
    const Vector3 p = k.X_WL[3].p;
    return std::vector{p.x(), p.y(), p.z()};
  };
  c.readings = {"x of P3 [m]", "y of P3 [m]", "z of P3 [m]"};
  c.reference = {{0.5, {0.7747178080392342, -0.9798150476556691, -0.19990615895344244}},
                 {1, {0.2744813192646237, -0.8867079387346718, -0.4623300026873756}},
                 {1.25, {-0.0023061004440242663, -0.8660269389820145, -0.4999973409503708}},
                 {2, {-0.7781353730332895, -0.9803526834432564, -0.19725267061717183}},
                 {5, {0.9999327423021112, -0.999999997738353, -6.725543608968683e-05}},
                 {10, {0.9997309873038307, -0.9999999638258174, -0.00026897651225403556}}};
  return c;
}

// Crank 0.1 m, 1 kg; rod 0.3 m, 2 kg; piston 1.5 kg on the x axis. Angles rotate x to z.
LoopCase slider_crank() {
  LoopCase c{};
  ModelBuilder builder;
  const int crank = add_rod(builder, "crank", 0, "bearing", 0, 1, 0.1);
  const int link = add_rod(builder, "rod", crank, "pin", 0.1, 2, 0.3);
  const int piston = builder.add_body("piston", 0, "slide", JointType::prismatic, {},
                                      Vector3::UnitX(), {1.5, Vector3::Zero(), Matrix3::Zero()});
  c.set_model(builder.build());
  c.start.q[2] = 0.4;
  c.start.qd = {5, -5 - 5 / 3.0, 0};  // the rod's end has no velocity along z
  c.loops = {hinge_closure("wrist", link, piston, {0.3, 0, 0}, Vector3::Zero())};
  c.read = [](const State<double>& x, const Kinematics&) {
    return std::vector{x.q[0], x.qd[0], x.q[2]};
  };
  c.readings = {"crank [rad]", "crank rate [rad/s]", "piston [m]"};
  c.reference = {{1, {-0.8469973614518336, -8.6334328688464898, 0.35671553542042059}},
                 {2, {-2.4662097865640883, -11.262911846678523, 0.21536642130893208}},
                 {5, {0.077378762080233428, 1.4792680585608234, 0.39960116696003938}},
                 {10, {0.071953580882247739, -1.9366283060128149, 0.39965509358798561}}};
  return c;
}

// Crank 0.1, coupler 0.35, rocker 0.3, ground 0.4 m; the crank at 60 degrees and 10 rad/s. The
// start is an open state nearby; one sample at t = 0, after assembly.
LoopCase four_bar() {
  LoopCase c{};
  ModelBuilder builder;
  const int crank = add_rod(builder, "crank", 0, "A", 0, 1, 0.1);
  const int coupler = add_rod(builder, "coupler", crank, "B", 0.1, 1, 0.35);
  const int rocker = add_rod(builder, "rocker", 0, "D", 0.4, 1, 0.3);
  c.set_model(builder.build());
  c.start.q = {1.0, -0.4, 1.8};
  LoopClosure input{"input", LoopType::locked, crank};
  input.offset = std::numbers::pi / 3;
  c.loops = {hinge_closure("C", coupler, rocker, {0.35, 0, 0}, {0.3, 0, 0}), input};
  c.read = [](const State<double>& x, const Kinematics&) {
    return std::vector{x.q[0] + x.q[1], x.q[2], x.qd[0] + x.qd[1], x.qd[2]};
  };
  c.readings = {"coupler [rad]", "rocker [rad]", "coupler rate [rad/s]", "rocker rate [rad/s]"};
  c.reference = {{0, four_bar_closed_form()}};
  c.tolerance = 1e-12;
  return c;
}

}  // namespace twinarm
