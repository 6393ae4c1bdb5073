// Closed loops, gears and mimic joints: the acceleration keeps them closed.
//
// A constraint is g(q, t) = 0, so along the motion g'' = J qdd + gamma = 0. J and gamma are not
// used: g is evaluated from poses along a curve with the velocity and acceleration of the motion,
//   g'' = (g(s) - 2 g(0) + g(-s)) / s^2 + series in s^2,
// with Richardson extrapolation to order 8. g as in solver/loops/loop_closure.h, by the pose of C_b
// in C_a; of a distance, half of its square over it, with the same g'' where g = g' = 0 and without
// a square root. Errors are relative to the largest of: accelerations of both ends, gravity, and
// forces over the mass they act on. Cost O(n) a loop.

#include "app/inspect/cross_checks.h"

namespace twinarm {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

bool is_of_joints(const LoopClosure& loop) {
  return facts_of(loop.type).ends != LoopBetween::bodies;
}

// Poses accurate to second order in s.
State<double> poses_along_motion(const Inspection& in, double s) {
  State<double> x = in.x;
  std::vector<double> mean = in.x.qd;
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += 0.5 * s * in.w.qdd[k];
  for (std::size_t i = 1; i < in.body_count(); ++i)
    if (in.model.joint[i] == JointType::prescribed) {
      // (w; v) and its rate in rotating body axes: p'' = R (v' + w x v).
      double* vJ = x.prescribed.data() + in.model.ip[i];
      const Vec3<double> w_x_v =
          cross(Vec3<double>{vJ[0], vJ[1], vJ[2]}, Vec3<double>{vJ[3], vJ[4], vJ[5]});
      for (std::size_t k = 0; k < 6; ++k) vJ[k] += 0.5 * s * vJ[6 + k];
      vJ[3] += 0.5 * s * w_x_v.x, vJ[4] += 0.5 * s * w_x_v.y, vJ[5] += 0.5 * s * w_x_v.z;
    }
  move(in.model, mean, s, x);
  return x;
}

// g, then positions and axes of both ends.
VectorXd rows_and_ends(const Inspection& in, const LoopClosure& loop, double s, double distance,
                       Kinematics& k) {
  const State<double> x = poses_along_motion(in, s);
  const auto a = static_cast<std::size_t>(loop.body_a), b = static_cast<std::size_t>(loop.body_b);
  if (is_of_joints(loop)) {
    VectorXd all(3);
    all[1] = x.q[in.model.iq[a]];
    all[2] = loop.type == LoopType::gear ? loop.ratio * x.q[in.model.iq[b]] : 0;
    all[0] = all[1] - all[2] - loop.offset_at(in.x.t + s);
    return all;
  }
  forward_kinematics(in.model, x, k);
  const Pose X_WCa = k.X_WL[a] * loop.X_LaC, X_WCb = k.X_WL[b] * loop.X_LbC;
  const Pose X_CaCb = X_WCa.inverse() * X_WCb;
  const VectorXd rows = facts_of(loop.type).g_of_pose(X_CaCb, distance);
  VectorXd all(rows.size() + 24);
  all << rows, X_WCa.p, X_WCb.p, X_WCa.R.reshaped(), X_WCb.R.reshaped();
  return all;
}

// Difference step [s] in which neither end moves far; for constraints between joints only these
// joints count. 0: no motion.
double step_of_loop(const Inspection& in, const LoopClosure& loop) {
  double fastest = 0;
  for (const int end : {loop.body_a, loop.body_b}) {
    double rate = 0, acceleration = 0;
    for (auto i = static_cast<std::size_t>(end); i > 0; i = is_of_joints(loop) ? 0 : in.parent(i)) {
      for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof)
        rate += std::abs(in.x.qd[dof]), acceleration += std::abs(in.w.qdd[dof]);
      if (in.model.joint[i] != JointType::prescribed) continue;
      const double* vJ = in.x.prescribed.data() + in.model.ip[i];
      for (std::size_t k = 0; k < 6; ++k)
        rate += std::abs(vJ[k]), acceleration += std::abs(vJ[k + 6]);
    }
    fastest = std::max({fastest, rate, std::sqrt(acceleration)});
  }
  // Where the ends slide past each other, g is a product of what moves with both.
  const double part = facts_of(loop.type).slides ? 0.25 : 0.5;
  return fastest > 0 ? part / fastest : 0;
}

// Largest of gravity and force over mass [m/s^2]: the scale of the error.
double max_specific_force(const Inspection& in) {
  double largest = std::max(to_eigen(in.model.gravity).norm(), 1e-300);
  for (const AppliedForce& actor : in.actors)
    for (const AppliedForce::OnBody& on : actor.bodies)
      if (const double m = in.model.I[on.body].m; m > 0)
        largest = std::max(largest, to_eigen(in.force_of(on).f).norm() / m);
  return largest;
}

double loop_error(const Inspection& in, const LoopClosure& loop, double scale, Kinematics& k) {
  const double first = step_of_loop(in, loop);
  if (first == 0) return 0;
  const Vector3 gap = k.X_WL[static_cast<std::size_t>(loop.body_a)] * loop.X_LaC.p -
                      k.X_WL[static_cast<std::size_t>(loop.body_b)] * loop.X_LbC.p;
  const double distance = std::max(gap.norm(), 1e-300);
  const VectorXd now = rows_and_ends(in, loop, 0, distance, k);
  const VectorXd second = extrapolated<4>([&](std::size_t level) {
    const double s = std::ldexp(first, -static_cast<int>(level));
    return VectorXd((rows_and_ends(in, loop, s, distance, k) - 2 * now +
                     rows_and_ends(in, loop, -s, distance, k)) /
                    (s * s));
  });
  forward_kinematics(in.model, in.x, k);
  const auto rows = static_cast<Index>(facts_of(loop.type).rows);
  return second.head(rows).lpNorm<Eigen::Infinity>() /
         std::max(scale, second.tail(second.size() - rows).lpNorm<Eigen::Infinity>());
}

// A mimic joint is a gear with the joint that it mimics.
std::vector<LoopClosure> with_mimics(const Model<double>& model, std::vector<LoopClosure> loops) {
  const auto body_of = [&](std::size_t dof) {
    int body = 1;
    while (model.dofs(static_cast<std::size_t>(body)) == 0 ||
           model.iv[static_cast<std::size_t>(body)] != dof)
      ++body;
    return body;
  };
  for (const Mimic& mimic : model.mimics) {
    const int follower = body_of(mimic.follower);
    loops.push_back({.name = model.joint_name[static_cast<std::size_t>(follower)],
                     .type = LoopType::gear,
                     .body_a = follower,
                     .body_b = body_of(mimic.leader),
                     .ratio = mimic.ratio});
  }
  return loops;
}

}  // namespace

std::vector<std::pair<std::string, double>> loop_errors(const Inspection& in) {
  std::vector<std::pair<std::string, double>> errors;
  const std::vector<LoopClosure> loops = with_mimics(in.model, in.loops);
  if (loops.empty()) return errors;
  const double scale = max_specific_force(in);
  Kinematics k = in.k;
  for (const LoopClosure& loop : loops)
    errors.emplace_back(loop.name, loop_error(in, loop, scale, k));
  return errors;
}

}  // namespace twinarm
