#include "app/accounting/energy_balance.h"

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {
namespace {

double dot(const Eigen::VectorXd& rows, const NamedJoint& joint,
           const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t c = 0; c < joint.nv; ++c)
    sum += rows[static_cast<Eigen::Index>(joint.row + c)] * values[c];
  return sum;
}

using ThirdRow = SceneCoupling::ThirdRow;

const char* name_of(ThirdRow row) {
  return row == ThirdRow::drive ? "drive" : row == ThirdRow::implicit ? "implicit" : "as_printed";
}

}  // namespace

EnergyBalance::EnergyBalance(const RobotInput& input, GivenForces& given, SceneCouplings* couplings,
                             Integrator integrator, bool others_want_inner, PosedStates& poses)
    : input_(input),
      given_(given),
      couplings_(couplings),
      poses_(poses),
      w_(input.model),
      start_(input.state.x),
      now_(start_),
      at_start_(energies(start_)) {
  find_rows(integrator, others_want_inner);
  power_now_ = powers(start_, Side::after);
}

void EnergyBalance::find_rows(Integrator integrator, bool others_want_inner) {
  const Model<double>& model = input_.model;
  const auto& joints = input_.coordinates.all();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!input_.state.has_tau[j]) continue;
    actuators_.push_back(
        {&joints[j], facts_of(joints[j].type).quaternion < 0 && !input_.state.tau_varies});
    if (!actuators_.back().is_exact)
      integrals_.push_back({EnergyRowKind::actuator, "actuator/" + joints[j].name});
  }
  for (std::size_t i = 0; i < given_.wrenches().size(); ++i)
    integrals_.push_back({EnergyRowKind::wrench, "wrench/" + std::to_string(i)});
  for (const PointSpring& spring : input_.springs) {
    if (spring.damping != 0)
      integrals_.push_back({EnergyRowKind::spring, "spring/" + spring.name + "/damper"});
    if (spring.law) integrals_.push_back({EnergyRowKind::spring, "spring/" + spring.name + "/law"});
  }
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.dofs(i) == 0) continue;
    const std::size_t iv = model.iv[i];  // all dofs of a joint have equal friction
    const Friction friction{model.joint_name[i], iv, model.dofs(i)};
    if (model.damping[iv] != 0) damped_.push_back(friction);
    if (model.coulomb_plus[iv] != 0 || model.coulomb_minus[iv] != 0) friction_.push_back(friction);
  }
  for (const Friction& f : damped_)
    integrals_.push_back({EnergyRowKind::joint_damping, "joint/" + f.joint + "/damping"});
  for (const Friction& f : friction_)
    integrals_.push_back({EnergyRowKind::joint_friction, "joint/" + f.joint + "/friction"});
  for (std::size_t c = 0; c < coupling_count(); ++c)
    for (const auto& [kind, part] :
         {std::pair{EnergyRowKind::coupling_spring, "/spring"},
          std::pair{EnergyRowKind::coupling_damper, "/damper"},
          std::pair{EnergyRowKind::coupling_other, "/operator_on_damper"}})
      integrals_.push_back({kind, "coupling/" + couplings_->spec(c).name + part});
  implicit_.assign(coupling_count(), 0);

  const int order = facts_of(integrator).order;
  weights_ = {0.5, 0.5};
  if ((integrals_.empty() && !others_want_inner) || order < 4) return;
  nodes_ = {0.5};
  weights_ = {1.0 / 6, 4.0 / 6, 1.0 / 6};
  if (order == 4) return;
  const double a = 0.5 / std::sqrt(5.0);
  nodes_ = {0.5 - a, 0.5 + a};
  weights_ = {1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12};
}

std::vector<double> EnergyBalance::powers(const State<double>& x, Side side) const {
  std::vector<double> powers;
  for (const Actuator& actuator : actuators_)
    if (!actuator.is_exact)
      powers.push_back(
          dot(input_.state.tau, *actuator.joint, from_solver(*actuator.joint, x, x.qd)));
  for (const GivenWrench& wrench : given_.wrenches()) powers.push_back(wrench.power(poses_.at(x)));
  for (std::size_t i = 0; i < input_.springs.size(); ++i) {
    const PointSprings::Reading now = given_.springs().reading(i, x, poses_.at(x));
    if (input_.springs[i].damping != 0) powers.push_back(-now.damping * now.rate);
    if (input_.springs[i].law) powers.push_back(-now.law * now.rate);
  }
  const Model<double>& model = input_.model;
  for (const Friction& f : damped_) {
    double sum = 0;
    for (std::size_t i = f.iv; i < f.iv + f.nv; ++i) sum -= model.damping[i] * x.qd[i] * x.qd[i];
    powers.push_back(sum);
  }
  for (const Friction& f : friction_) {
    double sum = 0;
    for (std::size_t i = f.iv; i < f.iv + f.nv; ++i)
      sum -= x.qd[i] > 0 ? model.coulomb_plus[i] * x.qd[i] : -model.coulomb_minus[i] * x.qd[i];
    powers.push_back(sum);
  }
  for (std::size_t c = 0; c < coupling_count(); ++c) {
    const SceneCoupling& spec = couplings_->spec(c);
    const CouplingEnds ends = couplings_->ends(c, x, poses_.at(x), side);
    const Vector3 damped = spec.absolute_damper ? Vector3(Vector3::Zero()) : ends.target_velocity;
    const Vector3 spring = spec.spring.k * ends.offset;
    const Vector3 damper = spec.spring.b * (damped - ends.velocity);
    powers.insert(powers.end(), {spring.dot(ends.target_velocity), damper.dot(ends.velocity),
                                 damper.dot(damped)});
  }
  return powers;
}

void EnergyBalance::add_step(double h, const std::vector<State<double>>& inner,
                             const State<double>& end) {
  const auto add = [&](const std::vector<double>& power, double weight) {
    for (std::size_t i = 0; i < integrals_.size(); ++i) integrals_[i].work += weight * h * power[i];
  };
  // Recomputed: target velocity or torques may have been set since the last step.
  if (couplings_ || input_.state.tau_varies) power_now_ = powers(now_, Side::after);
  add(power_now_, weights_.front());
  for (std::size_t s = 0; s < inner.size(); ++s)
    add(powers(inner[s], Side::after), weights_[s + 1]);
  power_now_ = powers(end, Side::before);
  add(power_now_, weights_.back());
  add_implicit(h, end);
  now_ = end;
}

// (force h - m* (v' - v)) . (v + v')/2; rows() subtracts the work of spring and damper.
void EnergyBalance::add_implicit(double h, const State<double>& end) {
  for (std::size_t c = 0; c < coupling_count(); ++c) {
    if (couplings_->spec(c).third_row() == ThirdRow::none) continue;
    const double m_star = couplings_->m_star(c);
    const CouplingEnds before = couplings_->ends(c, now_, poses_.at(now_));
    const CouplingEnds after = couplings_->ends(c, end, poses_.at(end), Side::before);
    const Vector3 mean = 0.5 * (before.velocity + after.velocity);
    implicit_[c] +=
        (h * couplings_->force(c) - m_star * (after.velocity - before.velocity)).dot(mean);
  }
}

void EnergyBalance::serialize(StateArchive& memory) {
  for (State<double>* x : {&start_, &now_}) visit_state(memory, input_.model, *x);
  for (EnergyRow& row : integrals_) memory.visit(row.work);
  memory.visit_fixed(implicit_);
  if (!memory.reads()) return;
  // Recomputed: the gains of a branch may differ.
  power_now_ = powers(now_, Side::after);
  at_start_ = energies(start_);
}

double EnergyBalance::elastic_energy(std::size_t c, const State<double>& x) const {
  const Vector3 offset = couplings_->ends(c, x, poses_.at(x)).offset;
  return 0.5 * couplings_->spec(c).spring.k * offset.squaredNorm();
}

double EnergyBalance::spring_energy(std::size_t i, const State<double>& x) const {
  const PointSprings::Reading now = given_.springs().reading(i, x, poses_.at(x));
  const PointSpring& spring = input_.springs[i];
  return 0.5 * now.elastic * (now.length - spring.rest_length);
}

std::vector<EnergyRow> EnergyBalance::input_work() const {
  std::vector<EnergyRow> rows;
  const std::size_t first = integrals_.size() - 3 * coupling_count();
  for (std::size_t c = 0; c < coupling_count(); ++c)
    rows.push_back({EnergyRowKind::coupling_other, couplings_->spec(c).name,
                    integrals_[first + 3 * c].work + integrals_[first + 3 * c + 2].work});
  return rows;
}

EnergyBalance::Energies EnergyBalance::energies(const State<double>& x) const {
  kinematics(input_.model, x, w_);
  return {kinetic_energy(input_.model, x, w_), potential_energy(input_.model, w_)};
}

std::vector<EnergyRow> EnergyBalance::rows() const {
  const Energies now = energies(now_);
  std::vector<EnergyRow> rows{
      {EnergyRowKind::gravity, "gravity", at_start_.potential - now.potential}};
  auto integral = integrals_.begin();
  for (const Actuator& actuator : actuators_) {
    if (!actuator.is_exact) {
      rows.push_back(*integral++);
      continue;
    }
    const NamedJoint& joint = *actuator.joint;
    std::vector<double> change = coordinates_of(joint, now_);
    for (std::size_t c = 0; c < joint.nq; ++c) change[c] -= start_.q[joint.iq + c];
    rows.push_back(
        {EnergyRowKind::actuator, "actuator/" + joint.name, dot(input_.state.tau, joint, change)});
  }
  for (std::size_t i = 0; i < input_.springs.size(); ++i)
    if (input_.springs[i].stiffness != 0)
      rows.push_back({EnergyRowKind::spring, "spring/" + input_.springs[i].name,
                      spring_energy(i, start_) - spring_energy(i, now_)});
  const auto couplings = integrals_.end() - static_cast<std::ptrdiff_t>(3 * coupling_count());
  rows.insert(rows.end(), integral, couplings);
  for (std::size_t c = 0; c < coupling_count(); ++c) {
    const auto target = couplings + static_cast<std::ptrdiff_t>(3 * c), damper = target + 1;
    const double spring = target->work - (elastic_energy(c, now_) - elastic_energy(c, start_));
    rows.push_back({EnergyRowKind::coupling_spring, target->name, spring});
    rows.push_back(*damper);
    const SceneCoupling& spec = couplings_->spec(c);
    if (const ThirdRow third = spec.third_row(); third != ThirdRow::none)
      rows.push_back({third == ThirdRow::implicit ? EnergyRowKind::coupling_implicit
                                                  : EnergyRowKind::coupling_other,
                      "coupling/" + spec.name + "/" + name_of(third),
                      implicit_[c] - spring - damper->work});
  }
  double residual = now.kinetic - at_start_.kinetic;
  for (const EnergyRow& row : rows) residual -= row.work;
  rows.push_back({EnergyRowKind::numerical, kNumericalRow, residual});
  return rows;
}

}  // namespace twinarm
