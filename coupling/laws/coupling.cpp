#include "coupling/laws/coupling.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "coupling/laws/coupling_spec.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {

Coupling::Coupling(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr)
    : name_(spec.name), model_(model), kvr_(kvr), springs_(spec.springs) {
  readings_.resize(springs_.size());
  DiagnosticList faults;
  for (const Spring& spring : springs_) {
    const std::string where = "coupling '" + name_ + "', spring '" + spring.name + "'";
    if (spring.body <= 0 || spring.body >= model.body_count())
      faults.add(where, "body index " + std::to_string(spring.body) + " is not a link",
                 "give an index from 1 to " + std::to_string(model.body_count() - 1),
                 "coupling.link");
    const auto check = [&](double gain, const std::string& what) {
      if (gain >= 0) return;
      faults.add(where, what + " is " + short_number_text(gain) + ", must not be negative",
                 "give a " + what + " of at least 0", "coupling.gain");
    };
    check(spring.k, "stiffness");
    check(spring.b, "damping");
    check(spring.k_rotational, "torsional stiffness");
    check(spring.b_rotational, "torsional damping");
  }
  faults.check();
}

Coupling::JointSpace Coupling::joint_space_of_joints() const {
  JointSpace sum(model_.nv);
  for (const Spring& spring : springs_) {
    const auto dof = static_cast<Eigen::Index>(model_.iv[static_cast<std::size_t>(spring.body)]);
    sum.K(dof, dof) += spring.k;
    sum.B(dof, dof) += spring.b;
  }
  return sum;
}

void Coupling::check_one_dof() const {
  DiagnosticList faults;
  for (const Spring& spring : springs_) {
    const auto i = static_cast<std::size_t>(spring.body);
    if (model_.dofs(i) == 1) continue;
    faults.add(
        "coupling '" + name_ + "', joint '" + model_.joint_name[i] + "'",
        "the joint has " + std::to_string(model_.dofs(i)) + " degrees of freedom, must have one",
        "use links on revolute, prismatic or screw joints", "coupling.degrees-of-freedom");
  }
  faults.check();
}

Coupling::JointSpace::JointSpace(std::size_t nv) {
  const auto n = static_cast<Eigen::Index>(nv);
  K = B = Eigen::MatrixXd::Zero(n, n);
}

void Coupling::JointSpace::add(double k, double b, const Eigen::Ref<const Eigen::MatrixXd>& J) {
  K += k * J.transpose() * J;
  B += b * J.transpose() * J;
}

Vector3 rotation_vector(const Matrix3& R) {
  const Eigen::Quaterniond quaternion(R);
  const double sign = quaternion.w() < 0 ? -1.0 : 1.0;  // angle <= pi
  const double s = quaternion.vec().norm();
  if (s < 1e-12) return 2 * sign * quaternion.vec();  // sin(x) = x to rounding
  return 2 * std::atan2(s, sign * quaternion.w()) / s * sign * quaternion.vec();
}

// ---- coupling_spec.h ----

const std::vector<CouplingFacts>& couplings_in_order() {
  static const std::vector<CouplingFacts> all = [] {
    std::vector<CouplingFacts> sorted = registered_couplings();
    for (CouplingFacts& facts : sorted)
      if (facts.type.name.empty()) facts.type.name = facts.name;
    std::ranges::stable_sort(sorted, {}, &CouplingFacts::order);
    return sorted;
  }();
  return all;
}

const CouplingFacts& facts_of(CouplingSpec::Type type, bool printed) {
  return *std::find_if(all_couplings.begin(), all_couplings.end(), [&](const CouplingFacts& facts) {
    return facts.type == type && facts.printed == printed;
  });
}

const CouplingFacts* find_coupling(const std::string& name) {
  for (const CouplingFacts& facts : all_couplings)
    if (facts.name == name) return &facts;
  return nullptr;
}

}  // namespace twinarm
