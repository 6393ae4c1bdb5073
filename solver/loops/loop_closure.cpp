#include "solver/loops/loop_closure.h"

#include <utility>

#include "solver/loops/loop_checks.h"

namespace twinarm {
namespace {

using Eigen::Index;

// Entries of J that are smaller than this part of the velocities that they are the difference of
// are rounding. They are made zero, so that a row that moves nothing (out of the plane of a planar
// mechanism) is empty, and is not taken for a small but true one.
constexpr double kEntryRounding = 1e-9;

Index index(std::size_t i) {
  return static_cast<Index>(i);
}
double cleaned(double entry, double size) {
  return std::abs(entry) <= kEntryRounding * size ? 0 : entry;
}
std::size_t last_shared_body(const Model<double>& model, int a, int b) {
  while (a != b) (a > b ? a : b) = model.parent[static_cast<std::size_t>(a > b ? a : b)];
  return static_cast<std::size_t>(a);
}
// Which axes of C_a and C_b are to stay at right angles, and with which sign, so that the couples
// of the rows are about x, y, z of C where the loop is closed.
struct AxisRow {
  int of_a, of_b;
  double sign;
};
constexpr std::array<AxisRow, 3> kWeld{{{1, 2, 1}, {2, 0, 1}, {0, 1, 1}}};
constexpr std::array<AxisRow, 2> kHinge{{{1, 2, 1}, {0, 2, -1}}};

}  // namespace

// Of one end: C, and how it moves at qdd = 0, in world axes. Gravity stands in a_bias as a_0 = -g,
// at both ends alike, and drops out of every difference.
struct LoopClosures::Side {
  Pose X_WC;
  Vector3 w, v, alpha, a;
};

LoopClosures::LoopClosures(const Model<double>& model, std::vector<LoopClosure> loops)
    : model_(&model), loops_(std::move(loops)), ends_(loops_.size()) {
  check_loops(model, loops_);
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    const LoopClosure& loop = loops_[l];
    Ends& e = ends_[l];
    e.first_row = loop_of_row_.size();
    loop_of_row_.insert(loop_of_row_.end(), facts_of(loop.type).rows, l);
    const auto a = static_cast<std::size_t>(loop.body_a), b = static_cast<std::size_t>(loop.body_b);
    if (loop.type == LoopType::gear) {
      e.dofs = {model.iv[a], model.iv[b]};
    } else if (loop.type == LoopType::locked) {
      e.dofs = {model.iv[a]};
    } else {
      const std::size_t shared = last_shared_body(model, loop.body_a, loop.body_b);
      e.shared = shared == 0 ? 0 : model.iv[shared] + model.dofs(shared);
      for (const std::size_t end : {a, b})
        for (std::size_t i = end; i > shared; i = static_cast<std::size_t>(model.parent[i]))
          for (std::size_t d = model.iv[i]; d < model.iv[i] + model.dofs(i); ++d)
            e.dofs.push_back(d);
    }
  }
  g_ = rate_ = gamma_ = Eigen::VectorXd::Zero(index(rows()));
  J_.setZero(index(rows()), index(model.nv));
}

LoopClosures::Side LoopClosures::side(const Kinematics& k, int body, const Pose& X_LC) const {
  const auto i = static_cast<std::size_t>(body);
  const Vector3 r = k.X_WL[i].R * X_LC.p;
  Side s{k.X_WL[i] * X_LC, k.w_WL[i], k.v_WLo[i] + k.w_WL[i].cross(r), {}, {}};
  s.alpha = k.R_WB[i] * to_eigen(k.a_bias[i].w);
  s.a = k.R_WB[i] * to_eigen(k.a_bias[i].v) + s.w.cross(s.v) + s.alpha.cross(r);
  return s;
}

void LoopClosures::evaluate(const State<double>& x, const Kinematics& k) noexcept {
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    const LoopClosure& loop = loops_[l];
    if (loop.type == LoopType::gear || loop.type == LoopType::locked) {
      evaluate_joints(x, ends_[l], loop);
      continue;
    }
    const Side a = side(k, loop.body_a, loop.X_LaC), b = side(k, loop.body_b, loop.X_LbC);
    if (loop.type == LoopType::distance) {
      evaluate_distance(k, ends_[l], loop, a, b);
    } else {
      evaluate_points(k, ends_[l], loop, a, b);
      if (loop.type != LoopType::ball) evaluate_axes(k, ends_[l], loop, a, b);
    }
  }
}

// With s = p_b - p_a, seen from a: g = -R^T s, R the axes of C_a, R' = [w_a]x R. Then
//   g'  = -R^T (s' - w_a x s)  = R^T (velocity of a's point at p_b - that of b's)
//   g'' = -R^T (s'' - alpha_a x s - 2 w_a x s' + w_a x (w_a x s)).
void LoopClosures::evaluate_points(const Kinematics& k, Ends& e, const LoopClosure& loop,
                                   const Side& a, const Side& b) {
  const Matrix3 R_CW = a.X_WC.R.transpose();
  const Vector3& p = b.X_WC.p;
  const Vector3 s = p - a.X_WC.p, s_rate = b.v - a.v, turned = a.w.cross(s);
  const Index row = index(e.first_row);
  e.R_WC = a.X_WC.R;
  e.p_WC = p;
  g_.segment<3>(row) = -(R_CW * s);
  rate_.segment<3>(row) = R_CW * (turned - s_rate);
  gamma_.segment<3>(row) =
      R_CW * (a.a - b.a + a.alpha.cross(s) + 2 * a.w.cross(s_rate) - a.w.cross(turned));
  for (const double sign : {1.0, -1.0})
    for_each_dof_below(*model_, k, sign > 0 ? loop.body_a : loop.body_b,
                       [&](std::size_t d, const Vector3& w, const Vector3& v, const Vector3& o) {
                         if (d < e.shared) return;
                         const Vector3 entry = sign * (R_CW * (v + w.cross(p - o)));
                         const double size = v.norm() + w.norm() * (p - o).norm();
                         for (Index c = 0; c < 3; ++c)
                           J_(row + c, index(d)) = cleaned(entry[c], size);
                       });
}

// Axes u of C_a and z of C_b at right angles: g = u . z, with n = u x z
//   g' = (w_a x u) . z + u . (w_b x z) = n . (w_a - w_b)
//   g'' = n . (alpha_a - alpha_b) + n' . (w_a - w_b),   n' = (w_a x u) x z + u x (w_b x z).
void LoopClosures::evaluate_axes(const Kinematics& k, Ends& e, const LoopClosure& loop,
                                 const Side& a, const Side& b) {
  const bool weld = loop.type == LoopType::weld;
  const std::size_t count = weld ? 3 : 2;
  const Vector3 w = a.w - b.w, alpha = a.alpha - b.alpha;
  for (std::size_t r = 0; r < count; ++r) {
    const AxisRow& axes = weld ? kWeld[r] : kHinge[r];
    const Vector3 u = axes.sign * a.X_WC.R.col(axes.of_a), z = b.X_WC.R.col(axes.of_b);
    const Vector3 n_rate = a.w.cross(u).cross(z) + u.cross(b.w.cross(z));
    e.n[r] = u.cross(z);
    const Index row = index(e.first_row + 3 + r);
    g_[row] = u.dot(z);
    rate_[row] = e.n[r].dot(w);
    gamma_[row] = e.n[r].dot(alpha) + n_rate.dot(w);
  }
  for (const double sign : {1.0, -1.0})
    for_each_dof_below(*model_, k, sign > 0 ? loop.body_a : loop.body_b,
                       [&](std::size_t d, const Vector3& turn, const Vector3&, const Vector3&) {
                         if (d < e.shared) return;
                         for (std::size_t r = 0; r < count; ++r)
                           J_(index(e.first_row + 3 + r), index(d)) =
                               cleaned(sign * e.n[r].dot(turn), turn.norm());
                       });
}

// With d = p_a - p_b and n = d / |d|: g' = n . d',  g'' = n . d'' + (|d'|^2 - g'^2) / |d|.
void LoopClosures::evaluate_distance(const Kinematics& k, Ends& e, const LoopClosure& loop,
                                     const Side& a, const Side& b) {
  const Vector3 d = a.X_WC.p - b.X_WC.p, d_rate = a.v - b.v;
  const double length = d.norm();
  const Vector3 n = d / length;
  const Index row = index(e.first_row);
  e.n[0] = n;
  e.p_WC = b.X_WC.p;
  g_[row] = length - loop.length;
  rate_[row] = n.dot(d_rate);
  gamma_[row] = n.dot(a.a - b.a) + (d_rate.squaredNorm() - rate_[row] * rate_[row]) / length;
  for (const double sign : {1.0, -1.0}) {
    const Vector3& p = sign > 0 ? a.X_WC.p : b.X_WC.p;
    for_each_dof_below(*model_, k, sign > 0 ? loop.body_a : loop.body_b,
                       [&](std::size_t dof, const Vector3& w, const Vector3& v, const Vector3& o) {
                         if (dof < e.shared) return;
                         const double entry = sign * n.dot(v + w.cross(p - o));
                         J_(row, index(dof)) = cleaned(entry, v.norm() + w.norm() * (p - o).norm());
                       });
  }
}

void LoopClosures::evaluate_joints(const State<double>& x, const Ends& e, const LoopClosure& loop) {
  const std::size_t a = model_->iq[static_cast<std::size_t>(loop.body_a)], va = e.dofs[0];
  const Index row = index(e.first_row);
  g_[row] = x.q[a] - loop.offset;
  rate_[row] = x.qd[va];
  gamma_[row] = 0;
  J_(row, index(va)) = 1;
  if (loop.type == LoopType::locked) return;
  const std::size_t b = model_->iq[static_cast<std::size_t>(loop.body_b)], vb = e.dofs[1];
  g_[row] -= loop.ratio * x.q[b];
  rate_[row] -= loop.ratio * x.qd[vb];
  J_(row, index(vb)) = -loop.ratio;
}

LoopWrench LoopClosures::wrench(std::size_t loop, const Eigen::VectorXd& lambda) const {
  const Ends& e = ends_[loop];
  const Index row = index(e.first_row);
  LoopWrench on_a;
  switch (loops_[loop].type) {
    case LoopType::weld:
    case LoopType::hinge:
      for (std::size_t r = 0; r < facts_of(loops_[loop].type).rows - 3; ++r)
        on_a.couple += lambda[row + 3 + index(r)] * e.n[r];
      [[fallthrough]];
    case LoopType::ball:
      on_a.force = e.R_WC * lambda.segment<3>(row);
      break;
    case LoopType::distance:
      on_a.force = lambda[row] * e.n[0];
      break;
    case LoopType::gear:
    case LoopType::locked:
      break;  // a torque on joints, lambda itself
  }
  return on_a;
}

}  // namespace twinarm
