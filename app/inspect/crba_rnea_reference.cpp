#include "app/inspect/crba_rnea_reference.h"

#include <algorithm>

#include "solver/dynamics/dynamics.h"

namespace twinarm {
namespace {

std::vector<double> as_list(const Eigen::VectorXd& v) {
  return {v.data(), v.data() + v.size()};
}

// Nothing moves, those of given motion neither.
State<double> at_rest(State<double> x) {
  std::ranges::fill(x.qd, 0);
  std::ranges::fill(x.prescribed, 0);
  return x;
}

}  // namespace

SecondWay::SecondWay(const Inspection& in)
    : in_(in), weightless_(in.model), rest_(at_rest(in.x)), w_(in.model) {
  weightless_.gravity = {};
  const auto nv = static_cast<Eigen::Index>(in.model.nv);
  M_.resize(nv, nv);
  crba(in.model, in.x, w_, {M_.data(), in.model.nv * in.model.nv});
  add_implicit();
}

// J of body b in its own axes has the columns X S_j of all joints below it, X from j to b.
void SecondWay::add_implicit() {
  for (std::size_t dof = 0; dof < in_.model.nv; ++dof)
    M_(static_cast<Eigen::Index>(dof), static_cast<Eigen::Index>(dof)) += in_.forces.armature[dof];
  if (!in_.forces.has_impedance) return;
  std::vector<std::pair<std::size_t, Motion<double>>> columns;
  for (std::size_t b = 1; b < in_.body_count(); ++b) {
    columns.clear();
    Transform<double> X;
    for (std::size_t j = b; j > 0; j = in_.parent(j)) {
      for (std::size_t dof = in_.model.iv[j]; dof < in_.model.iv[j] + in_.model.dofs(j); ++dof)
        columns.emplace_back(dof, X * w_.S_[dof]);
      X = X * w_.Xup[j];
    }
    for (const auto& [row, J_row] : columns)
      for (const auto& [col, J_col] : columns)
        M_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(col)) +=
            dot(J_row, in_.forces.impedance[b] * J_col);
  }
}

SecondWay::Answer SecondWay::run(const Model<double>& model, const State<double>& x,
                                 const Eigen::VectorXd& qdd,
                                 const std::vector<Force<double>>& f_ext) {
  rnea(model, x, as_list(qdd), f_ext, w_);
  Answer answer{Eigen::Map<const Eigen::VectorXd>(w_.tau.data(), qdd.size()), w_.a, w_.f};
  for (Eigen::Index k = 0; k < qdd.size(); ++k)
    answer.tau[k] += in_.forces.armature[static_cast<std::size_t>(k)] * qdd[k];
  return answer;
}

SecondWay::Answer SecondWay::inverse(const Eigen::VectorXd& qdd, std::size_t subtree) {
  Answer first = run(in_.model, in_.x, qdd, in_.forces.f_ext);
  if (subtree == 0 && !in_.forces.has_impedance) return first;
  std::vector<Force<double>> f_ext = in_.forces.f_ext;
  std::vector<Motion<double>> rigid(in_.body_count());  // of the subtree, as body i
  if (subtree > 0) {
    rigid[subtree] = first.a[subtree];
    for (std::size_t dof = in_.model.iv[subtree];
         dof < in_.model.iv[subtree] + in_.model.dofs(subtree); ++dof)
      rigid[subtree] += -qdd[static_cast<Eigen::Index>(dof)] * w_.S_[dof];
  }
  for (std::size_t b = 1; b < in_.body_count(); ++b) {
    if (subtree > 0 && b > subtree && is_below(b, subtree))
      rigid[b] = w_.Xup[b] * rigid[in_.parent(b)];
    f_ext[b] += in_.model.I[b] * rigid[b];
    if (in_.forces.has_impedance) f_ext[b] += -(in_.forces.impedance[b] * (first.a[b] - rigid[b]));
  }
  return run(in_.model, in_.x, qdd, f_ext);
}

SecondWay::Answer SecondWay::inertial(const Eigen::VectorXd& qdd) {
  const std::vector<Force<double>> none(in_.body_count());
  Answer answer = run(weightless_, rest_, qdd, none);
  if (!in_.forces.has_impedance) return answer;
  std::vector<Force<double>> implicit(in_.body_count());
  for (std::size_t b = 1; b < in_.body_count(); ++b)
    implicit[b] = -(in_.forces.impedance[b] * answer.a[b]);
  return run(weightless_, rest_, qdd, implicit);
}

bool SecondWay::is_below(std::size_t body, std::size_t ancestor) const {
  while (body > ancestor) body = in_.parent(body);
  return body == ancestor;
}

SecondWay::Rows SecondWay::rows_of(std::size_t body) const {
  Rows rows;
  for (std::size_t j = body; j < in_.body_count(); ++j) {
    if (!is_below(j, body)) continue;
    for (std::size_t dof = in_.model.iv[j]; dof < in_.model.iv[j] + in_.model.dofs(j); ++dof)
      (j == body ? rows.own : rows.below).push_back(static_cast<Eigen::Index>(dof));
  }
  return rows;
}

}  // namespace twinarm
