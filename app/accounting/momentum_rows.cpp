// Rows from the sums of momentum_balance.cpp.
#include "app/accounting/momentum_balance.h"

namespace twinarm {
namespace {

std::string name_of_limits(const Model<double>& model, const SceneContacts* contacts) {
  if (!contacts || !contacts->limits() || contacts->limits()->limits().size() != 1)
    return "joint/limits/stabilisation";
  const int body = contacts->limits()->limits().front().body;
  return "joint/" + model.joint_name[static_cast<std::size_t>(body)] + "/limit/stabilisation";
}

}  // namespace

std::vector<EnergyRow> MomentumBalance::energy_rows(const Simulation& simulation,
                                                    const SceneContacts* contacts) const {
  std::vector<EnergyRow> rows;
  const std::vector<LoopClosure>& loops =
      simulation.mechanism().dynamics.bilateral().loops().loops();
  for (std::size_t l = 0; l < loop_count_; ++l) {
    rows.push_back({EnergyRowKind::constraint, "constraint/" + loops[l].name, sums_[loop(l)].work});
    rows.push_back({EnergyRowKind::constraint_stabilisation,
                    "constraint/" + loops[l].name + "/stabilisation", stabilisation_[l].work});
  }
  const Model<double>& model = input_.model;
  for (std::size_t m = 0; m < mimics_.size(); ++m)
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      if (model.dofs(i) > 0 && model.iv[i] == model.mimics[m].follower && mimics_[m] != 0)
        rows.push_back(
            {EnergyRowKind::joint_mimic, "joint/" + model.joint_name[i] + "/mimic", mimics_[m]});
  if (separation_.work != 0)
    rows.push_back(
        {EnergyRowKind::contact_stabilisation, "contact/stabilisation", separation_.work});
  if (limit_separation_.work != 0)
    rows.push_back({EnergyRowKind::limit_stabilisation, name_of_limits(model, contacts),
                    limit_separation_.work});
  if (sleep_.work != 0) rows.push_back({EnergyRowKind::sleep, "sleep", sleep_.work});
  return rows;
}

// External forces on a body are subtracted from the force through the joint of its tree.
void MomentumBalance::subtract_from_trees(const EnergyMomentum& e, int body, double sign,
                                          std::vector<EnergyMomentum>& of_trees) const {
  for (std::size_t t = 0; t < trees_.size(); ++t)
    if (trees_[t].bodies[static_cast<std::size_t>(body)]) of_trees[t] += -sign * e;
}

std::vector<MomentumRow> MomentumBalance::rows(const Simulation& simulation,
                                               const SceneContacts* contacts,
                                               const OutsideForce* outside) const {
  std::vector<MomentumRow> rows;
  std::vector<EnergyMomentum> through(sums_.begin() + static_cast<std::ptrdiff_t>(tree(0)),
                                      sums_.end());
  if (rule_ == Rule::located)
    for (std::size_t t = 0; t < trees_.size(); ++t)
      through[t] += contents(trees_[t].bodies, now_) - contents(trees_[t].bodies, start_);
  const auto add = [&](EnergyRowKind kind, const std::string& name, const EnergyMomentum& e) {
    rows.push_back({kind, name, e.impulse, e.moment});
  };
  const auto moves = [&](int body) { return moved_[static_cast<std::size_t>(body)] != 0; };
  // Impulse on b from a; a row if exactly one of them can move.
  const auto between = [&](EnergyRowKind kind, const std::string& name, const EnergyMomentum& on_b,
                           int a, int b) {
    subtract_from_trees(on_b, b, 1, through);
    subtract_from_trees(on_b, a, -1, through);
    if (moves(a) != moves(b)) add(kind, name, (moves(b) ? 1.0 : -1.0) * on_b);
  };
  add(EnergyRowKind::gravity, "gravity", sums_[0]);
  for (std::size_t i = 0; i < given_.wrenches().size(); ++i)
    between(EnergyRowKind::wrench, "wrench/" + std::to_string(i), sums_[wrench(i)], 0,
            static_cast<int>(given_.wrenches()[i].body()));
  for (std::size_t i = 0; i < input_.springs.size(); ++i) {
    const PointSpring& spec = input_.springs[i];
    between(EnergyRowKind::spring, "spring/" + spec.name, sums_[spring(i)], spec.a.body,
            spec.b.body);
  }
  for (std::size_t c = 0; c < coupling_count_; ++c) {
    const SceneCoupling& spec = couplings_->spec(c);
    if (spec.is_external())
      between(EnergyRowKind::coupling_other, "coupling/" + spec.name, sums_[coupling(c)], 0,
              spec.spring.body);
  }
  if (contacts && contacts->contacts())
    for (const ContactWork& pair : contacts->work_by_names()) {
      const ContactGeometry &a = contacts->contacts()->bodies().geometry(pair.a),
                            &b = contacts->contacts()->bodies().geometry(pair.b);
      const bool has_row = moves(a.body) != moves(b.body);
      between(EnergyRowKind::contact, has_row ? "contact/" + a.name + "-" + b.name : "",
              {0, pair.impulse_W, pair.moment_W}, a.body, b.body);
    }
  if (outside && outside->has_acted()) {
    for (const OutsideForce::Given& part : outside->given())
      subtract_from_trees(part.exchange, part.body, 1, through);
    add(EnergyRowKind::outside, outside->name(), outside->total());
  }
  const std::vector<LoopClosure>& loops =
      simulation.mechanism().dynamics.bilateral().loops().loops();
  for (std::size_t l = 0; l < loop_count_; ++l)
    if (facts_of(loops[l].type).ends == LoopBetween::bodies)
      between(EnergyRowKind::constraint, "constraint/" + loops[l].name, sums_[loop(l)],
              loops[l].body_b, loops[l].body_a);
  for (std::size_t l = 0; l < loop_count_; ++l)
    add(EnergyRowKind::constraint_stabilisation, "constraint/" + loops[l].name + "/stabilisation",
        stabilisation_[l]);
  if (!separation_.impulse.isZero(0) || !separation_.moment.isZero(0))
    add(EnergyRowKind::contact_stabilisation, "contact/stabilisation", separation_);
  if (!limit_separation_.impulse.isZero(0) || !limit_separation_.moment.isZero(0))
    add(EnergyRowKind::limit_stabilisation, name_of_limits(input_.model, contacts),
        limit_separation_);
  if (!sleep_.impulse.isZero(0) || !sleep_.moment.isZero(0))
    add(EnergyRowKind::sleep, "sleep", sleep_);
  for (std::size_t t = 0; t < trees_.size(); ++t)
    add(EnergyRowKind::tree, "joint/" + trees_[t].joint, through[t]);
  EnergyMomentum residual = contents(moved_, now_) - at_start_;
  for (const MomentumRow& row : rows) residual += EnergyMomentum{0, -row.linear, -row.angular};
  add(EnergyRowKind::numerical, kNumericalRow, residual);
  return rows;
}

}  // namespace twinarm
