#include "app/simulate/ledger.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/energy.h"

namespace twinarm {
namespace {

// A velocity that is the rate of change of a coordinate.
bool is_rate(JointType type) {
  return type != JointType::spherical && type != JointType::free;
}

double dot(const Eigen::VectorXd& rows, const NamedJoint& joint,
           const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t c = 0; c < joint.nv; ++c)
    sum += rows[static_cast<Eigen::Index>(joint.row + c)] * values[c];
  return sum;
}

}  // namespace

Ledger::Ledger(const RobotInput& input, const std::vector<GivenWrench>& wrenches,
               Integrator integrator)
    : input_(input), wrenches_(wrenches), k_(input.model), start_(input.state.x), now_(start_) {
  find_rows(integrator);
  power_now_ = powers(start_);
}

void Ledger::find_rows(Integrator integrator) {
  const Model<double>& model = input_.model;
  const auto& joints = input_.coordinates.all();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!input_.state.has_tau[j]) continue;
    actuators_.push_back({&joints[j], is_rate(joints[j].type)});
    if (!actuators_.back().is_exact) integrals_.push_back({"actuator/" + joints[j].name});
  }
  for (std::size_t i = 0; i < wrenches_.size(); ++i)
    integrals_.push_back({"wrench/" + std::to_string(i)});
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.dofs(i) == 0) continue;
    const std::size_t iv = model.iv[i];  // the dofs of a joint are all alike
    const Friction friction{model.joint_name[i], iv, model.dofs(i)};
    if (model.damping[iv] != 0) damped_.push_back(friction);
    if (model.coulomb_plus[iv] != 0 || model.coulomb_minus[iv] != 0) rubbing_.push_back(friction);
  }
  for (const Friction& f : damped_) integrals_.push_back({"joint/" + f.joint + "/damping"});
  for (const Friction& f : rubbing_) integrals_.push_back({"joint/" + f.joint + "/friction"});

  const int order = facts_of(integrator).order;
  weights_ = {0.5, 0.5};
  if (integrals_.empty() || order < 4) return;
  nodes_ = {0.5};
  weights_ = {1.0 / 6, 4.0 / 6, 1.0 / 6};
  if (order == 4) return;
  const double a = 0.5 / std::sqrt(5.0);
  nodes_ = {0.5 - a, 0.5 + a};
  weights_ = {1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12};
}

std::vector<double> Ledger::powers(const State<double>& x) const {
  std::vector<double> powers;
  for (const Actuator& actuator : actuators_)
    if (!actuator.is_exact)
      powers.push_back(
          dot(input_.state.tau, *actuator.joint, from_solver(*actuator.joint, x, x.qd)));
  if (!wrenches_.empty()) forward_kinematics(input_.model, x, k_);
  for (const GivenWrench& wrench : wrenches_) powers.push_back(wrench.power(k_));
  const Model<double>& model = input_.model;
  for (const Friction& f : damped_) {
    double sum = 0;
    for (std::size_t i = f.iv; i < f.iv + f.nv; ++i) sum -= model.damping[i] * x.qd[i] * x.qd[i];
    powers.push_back(sum);
  }
  for (const Friction& f : rubbing_) {
    double sum = 0;
    for (std::size_t i = f.iv; i < f.iv + f.nv; ++i)
      sum -= x.qd[i] > 0 ? model.coulomb_plus[i] * x.qd[i] : -model.coulomb_minus[i] * x.qd[i];
    powers.push_back(sum);
  }
  return powers;
}

std::span<const double> Ledger::inner_nodes() const {
  return nodes_;
}

void Ledger::add_step(double h, const std::vector<State<double>>& inner, const State<double>& end) {
  const auto add = [&](const std::vector<double>& power, double weight) {
    for (std::size_t i = 0; i < integrals_.size(); ++i) integrals_[i].work += weight * h * power[i];
  };
  add(power_now_, weights_.front());
  for (std::size_t s = 0; s < inner.size(); ++s) add(powers(inner[s]), weights_[s + 1]);
  power_now_ = powers(end);
  add(power_now_, weights_.back());
  now_ = end;
}

std::vector<LedgerRow> Ledger::rows() const {
  const Model<double>& model = input_.model;
  std::vector<LedgerRow> rows{
      {"gravity", potential_energy(model, start_) - potential_energy(model, now_)}};
  auto integral = integrals_.begin();
  for (const Actuator& actuator : actuators_) {
    if (!actuator.is_exact) {
      rows.push_back(*integral++);
      continue;
    }
    const NamedJoint& joint = *actuator.joint;
    std::vector<double> way = coordinates_of(joint, now_);
    for (std::size_t c = 0; c < joint.nq; ++c) way[c] -= start_.q[joint.iq + c];
    rows.push_back({"actuator/" + joint.name, dot(input_.state.tau, joint, way)});
  }
  rows.insert(rows.end(), integral, integrals_.end());
  double rest = kinetic_energy(model, now_) - kinetic_energy(model, start_);
  for (const LedgerRow& row : rows) rest -= row.work;
  rows.push_back({"numerical", rest});
  return rows;
}

}  // namespace twinarm
