#include "app/inspect/cross_checks.h"

#include <limits>

#include "app/inspect/force_balance.h"
#include "solver/model/convert_model.h"

namespace twinarm {
namespace {

// NaN counts as the largest error.
double as_error(double error) {
  return std::isfinite(error) ? error : std::numeric_limits<double>::max();
}

Check worst_of(const Inspection& in, const char* name, const char* meaning, const Errors& errors,
               double tolerance) {
  Check check{name, meaning, 0, tolerance, ""};
  for (std::size_t i = 1; i < errors.size(); ++i)
    if (const double error = as_error(errors[i]); error > check.error) {
      check.error = error;
      check.worst = in.model.body_name[i];
    }
  return check;
}

// Curve with the velocity and the acceleration of the motion at s = 0.
State<double> state_along_motion(const Inspection& in, double s) {
  State<double> x = in.x;
  move(in.model, in.x.qd, s, x);
  for (std::size_t k = 0; k < x.qd.size(); ++k) x.qd[k] += s * in.w.qdd[k];
  for (std::size_t i = 1; i < in.body_count(); ++i)
    if (in.model.joint[i] == JointType::prescribed) {
      double* vJ = x.prescribed.data() + in.model.ip[i];
      for (std::size_t k = 0; k < 6; ++k) vJ[k] += s * vJ[6 + k];
    }
  return x;
}

// Linear and angular momentum of each body in world axes, the latter about the position of its
// origin at s = 0.
using Momenta = std::vector<Vector6>;
Momenta momenta(const Inspection& in, double s, Workspace<double>& w) {
  kinematics(in.model, state_along_motion(in, s), w);
  Momenta all(in.body_count(), Vector6::Zero());
  for (std::size_t i = 1; i < in.body_count(); ++i) {
    const Force<double> h = in.model.I[i] * w.v[i];  // body axes, about the moving origin
    const Matrix3 R = to_eigen(w.X0[i].E).transpose();
    const Vector3 p = R * to_eigen(h.f);
    const Vector3 arm = to_eigen(w.X0[i].r) - in.k.X_WL[i].p;
    all[i] << p, R * to_eigen(h.n) + arm.cross(p);
  }
  return all;
}

// Difference step [s] in which no body rotates by more than about 0.5 rad.
double step_of(const Inspection& in) {
  std::vector<double> rate(in.body_count());
  double fastest = 0;
  for (std::size_t i = 1; i < in.body_count(); ++i) {
    rate[i] = rate[in.parent(i)];
    for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof)
      rate[i] += std::abs(in.x.qd[dof]);
    if (in.model.joint[i] == JointType::prescribed)
      for (std::size_t k = 0; k < 6; ++k) rate[i] += std::abs(in.x.prescribed[in.model.ip[i] + k]);
    fastest = std::max(fastest, rate[i]);
  }
  return std::min(0.1, 0.5 / fastest);
}

}  // namespace

Errors balance_errors(const Inspection& in) {
  Errors errors(in.body_count());
  for (std::size_t i = 1; i < in.body_count(); ++i) errors[i] = balance_of(in, i).residual;
  for (const JointBalance& joint : joint_balances(in))
    errors[joint.body] = std::max(errors[joint.body], as_error(joint.residual));
  return errors;
}

std::vector<Check> run_checks(const Inspection& in, const CheckTolerances& tolerances) {
  const ReferenceErrors reference = reference_errors(in);
  std::vector<Check> checks;
  const auto add = [&](const char* name, const char* meaning, const Errors& errors,
                       double tolerance) {
    checks.push_back(worst_of(in, name, meaning, errors, tolerance));
  };
  const double algebra = tolerances.algebra;
  add("v", "rate of the poses, by dual numbers", velocity_errors(in), algebra);
  add("D", "Schur complement of M: descendants free (CRBA)", reference.D, algebra);
  add("U", "wrench for unit qdd, descendants free (CRBA, RNEA)", reference.U, algebra);
  add("pA", "wrench for a = 0, descendants free (CRBA, RNEA)", reference.pA, algebra);
  add("u", "net joint force for a = 0 (CRBA, RNEA)", reference.u, algebra);
  add("qdd", "M qdd + h = tau (CRBA, RNEA)", reference.qdd, algebra);
  add("a", "accelerations from qdd (RNEA)", reference.a, algebra);
  add("tau", "joint forces from qdd (RNEA)", reference.tau, algebra);
  add("f", "wrenches through joints, IA a + pA (RNEA)", reference.f, algebra);
  add("balance", "sum of the wrenches on each body is zero", balance_errors(in), algebra);
  add("momentum", "rate of momentum of each body, by differences", momentum_errors(in),
      tolerances.momentum);
  const auto loops = loop_errors(in);
  if (loops.empty()) return checks;
  Check closed{"loops", "loop closure g'' = 0, by differences of poses", 0, tolerances.loops, ""};
  for (const auto& [name, error] : loops)
    if (as_error(error) > closed.error) closed.error = as_error(error), closed.worst = name;
  checks.push_back(std::move(closed));
  return checks;
}

Errors velocity_errors(const Inspection& in) {
  using D = Dual<8>;
  const Model<D> model = convert<D>(in.model);
  State<D> x = convert<D>(in.x);
  D along(0);
  along.d[0] = 1;
  move(model, convert_all<D>(in.x.qd), along, x);
  Workspace<D> w(model);
  kinematics(model, x, w);

  const auto value = [](const Vec3<D>& a) { return Vector3(a.x.value, a.y.value, a.z.value); };
  const auto rate = [](const Vec3<D>& a) { return Vector3(a.x.d[0], a.y.d[0], a.z.d[0]); };
  Errors errors(in.body_count());
  for (std::size_t i = 1; i < in.body_count(); ++i) {
    Matrix3 E, E_rate;
    const Mat3<D>& of = w.X0[i].E;
    E << value(of.r0).transpose(), value(of.r1).transpose(), value(of.r2).transpose();
    E_rate << rate(of.r0).transpose(), rate(of.r1).transpose(), rate(of.r2).transpose();
    const Matrix3 cross = -E_rate * E.transpose();  // [w]x in body axes
    const Vector3 angular(cross(2, 1), cross(0, 2), cross(1, 0)), linear = E * rate(w.X0[i].r);
    const Vector3 w_i = to_eigen(in.w.v[i].w), v_i = to_eigen(in.w.v[i].v);
    const double size = std::max({angular.norm(), linear.norm(), 1e-300});
    const double error = std::max((angular - w_i).norm(), (linear - v_i).norm());
    errors[i] = error == 0 ? 0 : error / size;
  }
  return errors;
}

Errors momentum_errors(const Inspection& in) {
  constexpr std::size_t kLevels = 4;
  Workspace<double> w(in.model);
  std::array<Momenta, kLevels> rate;
  double s = step_of(in);
  for (Momenta& level : rate) {
    level = momenta(in, s, w);
    const Momenta before = momenta(in, -s, w);
    for (std::size_t i = 1; i < in.body_count(); ++i) level[i] = (level[i] - before[i]) / (2 * s);
    s /= 2;
  }
  for (std::size_t i = 1; i < in.body_count(); ++i)
    rate[0][i] = extrapolated<kLevels>([&](std::size_t level) { return rate[level][i]; });

  Errors errors(in.body_count());
  for (std::size_t i = 1; i < in.body_count(); ++i) {
    const BodyBalance balance = balance_of(in, i);
    Vector6 sum = Vector6::Zero();
    for (std::size_t k = 0; k + 1 < balance.wrenches.size(); ++k) {  // without inertia
      sum.head<3>() += balance.wrenches[k].force;
      sum.tail<3>() += balance.wrenches[k].torque;
    }
    const double error = (sum - rate[0][i]).lpNorm<Eigen::Infinity>();
    errors[i] = error == 0 ? 0 : error / std::max(balance.largest, gyroscopic_load(in, i));
  }
  return errors;
}

}  // namespace twinarm
