// Types of loop closures: one struct per type, with g, g', gamma and J (loop_closure.h).
//
// A new type is one struct here and one line in the list of loop_closure.h. Members of a struct:
//   rows              number of rows of g
//   ends              between two bodies, between two joints, or of one joint
//   slides            whether the origins of C_a and C_b move relative to each other
//   evaluate          writes g, g', gamma and J, and the data of wrench()
//   wrench            wrench on link a from the multipliers of its rows
//   problem           error in the closure's parameters; empty if none
//   has_opposite_axes whether axes point in opposite directions although g = 0
//   g_of_pose         between bodies: g from poses only (cross-check in the inspector)
#pragma once

#include <array>
#include <cmath>

#include "solver/loops/loop_closure.h"
#include "solver/support/number_text.h"

namespace twinarm {

// Frame C of one end, its velocity, and its acceleration at qdd = 0, world axes. a_bias contains
// a_0 = -a_g at both ends, which cancels in every difference.
struct LoopSide {
  Pose X_WC;
  Vector3 w, v, alpha, a;

  LoopSide(const Kinematics& k, int body, const Pose& X_LC) {
    const auto i = static_cast<std::size_t>(body);
    const Vector3 r = k.X_WL[i].R * X_LC.p;
    X_WC = k.X_WL[i] * X_LC;
    w = k.w_WL[i];
    v = k.v_WLo[i] + k.w_WL[i].cross(r);
    alpha = k.R_WB[i] * to_eigen(k.a_bias[i].w);
    a = k.R_WB[i] * to_eigen(k.a_bias[i].v) + w.cross(v) + alpha.cross(r);
  }
};

// One loop at a state: inputs, and outputs from `row` on.
struct LoopRows {
  using Index = Eigen::Index;
  const Model<double>& model;
  const State<double>& x;
  const Kinematics& k;
  const LoopClosure& loop;
  LoopEnds& e;
  Index row;
  Eigen::VectorXd &g, &rate, &gamma;
  LoopJacobian& J;

  LoopSide side_a() const { return {k, loop.body_a, loop.X_LaC}; }
  LoopSide side_b() const { return {k, loop.body_b, loop.X_LbC}; }
  // f(sign, dof, angular part, linear part, joint's origin) for the dofs that move only one end:
  // sign 1 for a, -1 for b.
  template <class F>
  void for_each_dof(F&& f) const {
    for (const double sign : {1.0, -1.0})
      for_each_dof_between(model, k, e.shared, sign > 0 ? loop.body_a : loop.body_b,
                           [&](std::size_t dof, const Vector3& w, const Vector3& v,
                               const Vector3& o) { f(sign, static_cast<Index>(dof), w, v, o); });
  }
};

// Sets entries of J to zero that are rounding of the velocities they are the difference of. Rows
// without effect (out of plane in a planar mechanism) are then empty instead of small.
inline double without_rounding(double entry, double size) {
  constexpr double kEntryRounding = 1e-9;
  return std::abs(entry) <= kEntryRounding * size ? 0 : entry;
}

struct LoopProblem {
  std::string problem, fix;
};

// Defaults.
struct AnyLoop {
  static constexpr LoopBetween ends = LoopBetween::bodies;
  static constexpr bool slides = false;
  static LoopWrench wrench(const LoopEnds&, const double*) { return {}; }
  static LoopProblem problem(const LoopClosure&) { return {}; }
  static bool has_opposite_axes(const Matrix3&) { return false; }
  static Eigen::VectorXd g_of_pose(const Pose&, double) { return {}; }
};

// ---- frames: the origins of C_a and C_b agree along some axes of C_a, and some of their axes ----

// Axes of C_a and C_b that stay perpendicular, and the sign for which the couples of the rows are
// about x, y, z of C in the closed loop.
struct AxisRow {
  int of_a, of_b, sign;
};

// Axes of C_a along which the origins agree.
inline constexpr std::array kAllAxes{0, 1, 2};
inline constexpr std::array kAcrossZ{0, 1};
inline constexpr std::array kAlongZ{2};

// With s = p_b - p_a and R the axes of C_a, R' = [w_a]x R: g = -R^T s,
//   g'  = -R^T (s' - w_a x s)  = R^T (velocity of a's point at p_b - that of b's)
//   g'' = -R^T (s'' - alpha_a x s - 2 w_a x s' + w_a x (w_a x s)).
template <auto points>
void evaluate_points(const LoopRows& out, const LoopSide& a, const LoopSide& b) {
  const Matrix3 R_CW = a.X_WC.R.transpose();
  const Vector3& p = b.X_WC.p;
  const Vector3 s = p - a.X_WC.p, s_rate = b.v - a.v, turned = a.w.cross(s);
  out.e.R_WC = a.X_WC.R;
  out.e.p_WC = p;
  const Vector3 g = -(R_CW * s), rate = R_CW * (turned - s_rate);
  const Vector3 gamma =
      R_CW * (a.a - b.a + a.alpha.cross(s) + 2 * a.w.cross(s_rate) - a.w.cross(turned));
  for (std::size_t r = 0; r < points.size(); ++r) {
    const Eigen::Index row = out.row + static_cast<Eigen::Index>(r);
    out.g[row] = g[points[r]];
    out.rate[row] = rate[points[r]];
    out.gamma[row] = gamma[points[r]];
  }
  out.for_each_dof([&](double sign, Eigen::Index dof, const Vector3& w, const Vector3& v,
                       const Vector3& o) {
    const Vector3 entry = sign * (R_CW * (v + w.cross(p - o)));
    const double size = v.norm() + w.norm() * (p - o).norm();
    for (std::size_t r = 0; r < points.size(); ++r)
      out.J(out.row + static_cast<Eigen::Index>(r), dof) = without_rounding(entry[points[r]], size);
  });
}

// Perpendicular axes u of C_a and z of C_b: g = u . z, with n = u x z
//   g' = (w_a x u) . z + u . (w_b x z) = n . (w_a - w_b)
//   g'' = n . (alpha_a - alpha_b) + n' . (w_a - w_b),   n' = (w_a x u) x z + u x (w_b x z).
template <std::size_t count>
void evaluate_axes(const LoopRows& out, Eigen::Index first, const std::array<AxisRow, count>& axes,
                   const LoopSide& a, const LoopSide& b) {
  const Vector3 w = a.w - b.w, alpha = a.alpha - b.alpha;
  for (std::size_t r = 0; r < count; ++r) {
    const Vector3 u = double(axes[r].sign) * a.X_WC.R.col(axes[r].of_a);
    const Vector3 z = b.X_WC.R.col(axes[r].of_b);
    const Vector3 n_rate = a.w.cross(u).cross(z) + u.cross(b.w.cross(z));
    out.e.n[r] = u.cross(z);
    const Eigen::Index row = first + static_cast<Eigen::Index>(r);
    out.g[row] = u.dot(z);
    out.rate[row] = out.e.n[r].dot(w);
    out.gamma[row] = out.e.n[r].dot(alpha) + n_rate.dot(w);
  }
  out.for_each_dof(
      [&](double sign, Eigen::Index dof, const Vector3& angular, const Vector3&, const Vector3&) {
        for (std::size_t r = 0; r < count; ++r)
          out.J(first + static_cast<Eigen::Index>(r), dof) =
              without_rounding(sign * out.e.n[r].dot(angular), angular.norm());
      });
}

template <auto points, AxisRow... axes>
struct FrameLoop : AnyLoop {
  static constexpr std::size_t rows = points.size() + sizeof...(axes);
  static constexpr bool slides = points.size() < 3;
  static void evaluate(const LoopRows& out) {
    const LoopSide a = out.side_a(), b = out.side_b();
    evaluate_points<points>(out, a, b);
    if constexpr (sizeof...(axes) > 0)
      evaluate_axes(out, out.row + static_cast<Eigen::Index>(points.size()),
                    std::array<AxisRow, sizeof...(axes)>{axes...}, a, b);
  }
  static LoopWrench wrench(const LoopEnds& e, const double* lambda) {
    LoopWrench on_a;
    Vector3 force_C = Vector3::Zero();
    for (std::size_t r = 0; r < points.size(); ++r) force_C[points[r]] = lambda[r];
    for (std::size_t r = 0; r < sizeof...(axes); ++r)
      on_a.couple += lambda[points.size() + r] * e.n[r];
    on_a.force = e.R_WC * force_C;
    return on_a;
  }
  // Two rows make the z axes parallel, three all axes.
  static bool has_opposite_axes(const Matrix3& R_CaCb) {
    return (sizeof...(axes) == 2 && R_CaCb(2, 2) < 0) ||
           (sizeof...(axes) == 3 && (R_CaCb.diagonal().array() < 0).any());
  }
  static Eigen::VectorXd g_of_pose(const Pose& X_CaCb, double) {
    Eigen::VectorXd g(rows);
    for (std::size_t r = 0; r < points.size(); ++r)
      g[static_cast<Eigen::Index>(r)] = X_CaCb.p[points[r]];
    auto row = static_cast<Eigen::Index>(points.size());
    ((g[row++] = X_CaCb.R(axes.of_a, axes.of_b)), ...);
    return g;
  }
};
struct SphericalLoop : FrameLoop<kAllAxes> {};
struct RevoluteLoop : FrameLoop<kAllAxes, AxisRow{1, 2, 1}, AxisRow{0, 2, -1}> {};
struct WeldLoop : FrameLoop<kAllAxes, AxisRow{1, 2, 1}, AxisRow{2, 0, 1}, AxisRow{0, 1, 1}> {};
struct PrismaticLoop : FrameLoop<kAcrossZ, AxisRow{1, 2, 1}, AxisRow{2, 0, 1}, AxisRow{0, 1, 1}> {};
struct CylindricalLoop : FrameLoop<kAcrossZ, AxisRow{1, 2, 1}, AxisRow{0, 2, -1}> {};
struct UniversalLoop : FrameLoop<kAllAxes, AxisRow{2, 1, -1}> {};
struct PointOnLineLoop : FrameLoop<kAcrossZ> {};
struct PointOnPlaneLoop : FrameLoop<kAlongZ> {};

// ---- distance ----

// With d = p_a - p_b and n = d / |d|: g' = n . d',  g'' = n . d'' + (|d'|^2 - g'^2) / |d|.
struct DistanceLoop : AnyLoop {
  static constexpr std::size_t rows = 1;
  static constexpr bool slides = true;
  static void evaluate(const LoopRows& out) {
    const LoopSide a = out.side_a(), b = out.side_b();
    const Vector3 d = a.X_WC.p - b.X_WC.p, d_rate = a.v - b.v;
    const double length = d.norm();
    const Vector3 n = d / length;
    const Eigen::Index row = out.row;
    out.e.n[0] = n;
    out.e.p_WC = b.X_WC.p;
    out.g[row] = length - out.loop.length;
    out.rate[row] = n.dot(d_rate);
    out.gamma[row] =
        n.dot(a.a - b.a) + (d_rate.squaredNorm() - out.rate[row] * out.rate[row]) / length;
    out.for_each_dof(
        [&](double sign, Eigen::Index dof, const Vector3& w, const Vector3& v, const Vector3& o) {
          const Vector3& p = sign > 0 ? a.X_WC.p : b.X_WC.p;
          const double entry = sign * n.dot(v + w.cross(p - o));
          out.J(row, dof) = without_rounding(entry, v.norm() + w.norm() * (p - o).norm());
        });
  }
  static LoopWrench wrench(const LoopEnds& e, const double* lambda) {
    LoopWrench on_a;
    on_a.force = lambda[0] * e.n[0];
    return on_a;
  }
  static LoopProblem problem(const LoopClosure& loop) {
    if (loop.length > 0 && std::isfinite(loop.length)) return {};
    return {"length is " + short_number_text(loop.length) + " m, must be positive and finite",
            "give the distance of the two points, or use a ball"};
  }
  // d^2 / (2 length): smooth in the pose, unlike |d|.
  static Eigen::VectorXd g_of_pose(const Pose& X_CaCb, double length) {
    return Eigen::VectorXd::Constant(1, X_CaCb.p.squaredNorm() / (2 * length));
  }
};

// ---- joints with one degree of freedom; the multiplier is the joint force on a ----

struct LockedLoop : AnyLoop {
  static constexpr std::size_t rows = 1;
  static constexpr LoopBetween ends = LoopBetween::one_joint;
  static void evaluate(const LoopRows& out) {
    const std::size_t q = out.model.iq[static_cast<std::size_t>(out.loop.body_a)];
    const std::size_t v = out.e.dofs[0];
    out.g[out.row] = out.x.q[q] - out.e.offset[0];
    out.rate[out.row] = out.x.qd[v] - out.e.offset[1];
    out.gamma[out.row] = -out.e.offset[2];
    out.J(out.row, static_cast<Eigen::Index>(v)) = 1;
  }
  static LoopProblem problem(const LoopClosure& loop) {
    if (std::isfinite(loop.ratio) && std::isfinite(loop.offset)) return {};
    return {"ratio and offset must be finite", "give numbers"};
  }
};

struct GearLoop : LockedLoop {
  static constexpr LoopBetween ends = LoopBetween::joints;
  static void evaluate(const LoopRows& out) {
    LockedLoop::evaluate(out);
    const std::size_t q = out.model.iq[static_cast<std::size_t>(out.loop.body_b)];
    const std::size_t v = out.e.dofs[1];
    out.g[out.row] -= out.loop.ratio * out.x.q[q];
    out.rate[out.row] -= out.loop.ratio * out.x.qd[v];
    out.J(out.row, static_cast<Eigen::Index>(v)) = -out.loop.ratio;
  }
};

// Calls f with the struct of the type, e.g. f(WeldLoop{}).
template <class F>
decltype(auto) visit_loop(LoopType type, F&& f) {
  switch (type) {
#define TWINARM_CASE(name, Loop) \
  case LoopType::name:           \
    return f(Loop{});
    TWINARM_LOOPS(TWINARM_CASE)
#undef TWINARM_CASE
  }
  return f(SphericalLoop{});  // not reached
}

}  // namespace twinarm
