#include "app/coupling/posed_couplings.h"

namespace twinarm {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

std::string kind_of(const SceneCoupling& spec) {
  const char* law = facts_of(spec.law, spec.printed).name;
  if (spec.is_linear()) return law;
  return std::string(law) + (spec.measure == SpringSpace::world ? ", world" : ", joint");
}

// Mass or inertia that a weld adds to its link at its point.
double added_inertia(const SceneCoupling& spec) {
  const bool is_weld = spec.law == CouplingSpec::Type::weld && spec.spring.b > 0;
  return is_weld ? spec.spring.b / spec.reference.damping() : 0;
}

}  // namespace

PosedCouplings::PosedCouplings(const SimulateInput& input)
    : input_(input), model_(input.robot.model), x_(input.robot.state.x), k_(model_) {
  check_dense(model_, input_.scene->description.file);
  std::ranges::fill(x_.qd, 0.0);
  forward_kinematics(model_, x_, k_);
  const Coordinates& coordinates = input_.robot.coordinates;
  P_ = coordinates.P(model_, x_).leftCols(coordinates.rows());
  all_M_ = mass_matrix(model_, x_);
  for (const NamedJoint& joint : coordinates.all())
    velocities_ = std::max(velocities_, joint.iv + joint.nv);
  for (const Mimic& mimic : model_.mimics) velocities_ = std::max(velocities_, mimic.follower + 1);
}

VectorXd PosedCouplings::gravity() const {
  Workspace<double> w(model_);
  rnea(model_, x_, std::vector<double>(model_.nv), std::vector<Force<double>>(k_.X_WL.size()), w);
  return P_.transpose() * Eigen::Map<const VectorXd>(w.tau.data(), static_cast<Index>(model_.nv));
}

MatrixXd PosedCouplings::joint_damping() const {
  const Eigen::Map<const VectorXd> damping(model_.damping.data(), static_cast<Index>(model_.nv));
  return by_rows(damping.asDiagonal());
}

// d(error of the coupling)/dq. The matched law measures in the pose of its target.
MatrixXd PosedCouplings::jacobian(std::size_t c) const {
  const SceneCoupling& spec = input_.couplings->spec(c);
  const int body = spec.spring.body;
  if (spec.is_linear()) {
    const Kinematics& k = spec.law == CouplingSpec::Type::equivalent_torsional
                              ? input_.couplings->target(c, x_.t).k
                              : k_;
    return point_jacobian(model_, k, body, k.position(body, spec.spring.p_L));
  }
  if (spec.measure == SpringSpace::world) return rotation_jacobian(model_, k_, body);
  MatrixXd row = MatrixXd::Zero(1, static_cast<Index>(model_.nv));
  row(0, static_cast<Index>(model_.iv[static_cast<std::size_t>(body)])) = 1;
  return row;
}

MatrixXd PosedCouplings::robot_inertia(const SceneCoupling& spec) const {
  const auto [first, last] = input_.scene->bodies_of_robot(spec.robot);
  MatrixXd rows = MatrixXd::Zero(all_M_.rows(), all_M_.cols());
  for (int body = first; body <= last; ++body) {
    const auto i = static_cast<std::size_t>(body);
    const auto iv = static_cast<Index>(model_.iv[i]), count = static_cast<Index>(model_.dofs(i));
    rows.middleRows(iv, count) = all_M_.middleRows(iv, count);
  }
  return by_rows(rows);
}

double PosedCouplings::apparent_inertia(std::size_t c) const {
  const MatrixXd J = jacobian(c) * P_;
  Eigen::Matrix3Xd rows = Eigen::Matrix3Xd::Zero(3, J.cols());
  rows.topRows(J.rows()) = J;
  return principal_inertias(M(), rows)[0];
}

// About each revolute joint between base and point, with the inertia for the other joints locked.
void PosedCouplings::add_arms(const SceneCoupling& spec, const Vector3& offset, double h,
                              PredictedCoupling& found) const {
  const Vector3 p = k_.position(spec.spring.body, spec.spring.p_L), target = p + offset;
  for_each_dof_below(
      model_, k_, spec.spring.body,
      [&](std::size_t dof, const Vector3& w, const Vector3&, const Vector3& o) {
        if (w.norm() < 0.5) return;  // prismatic
        const auto distance = [&](const Vector3& point) { return w.cross(point - o).norm(); };
        const auto after = std::upper_bound(model_.iv.begin() + 1, model_.iv.end(), dof);
        const auto body = static_cast<std::size_t>(after - model_.iv.begin()) - 1;
        const double r = distance(p), R_K = distance(target), k = spec.spring.k;
        if (r < 1e-9 || k == 0) return;  // no torque about this joint
        const double I =
            all_M_(static_cast<Index>(dof), static_cast<Index>(dof)) + r * r * added_inertia(spec);
        found.arms.push_back({model_.joint_name[body], r, R_K,
                              max_target_radius(I, r, k, spec.spring.b, h), k * r * R_K});
      });
}

PredictedCoupling PosedCouplings::about_zero(std::size_t c) {
  const SceneCoupling& spec = input_.couplings->spec(c);
  PredictedCoupling found;
  static_cast<CouplingTraits&>(found) = spec;
  found.kind = kind_of(spec);
  const auto body = static_cast<std::size_t>(spec.spring.body);
  found.is_length = spec.is_linear() || (spec.at_joint() && is_translational(model_.joint[body]));
  found.gains = {spec.spring.k, spec.spring.b};
  const MatrixXd J = jacobian(c) * P_, square = J.transpose() * J;
  found.K = found.K_zero = spec.spring.k * square;
  // The damper as printed has no linear part.
  const bool is_printed = spec.printed && spec.law == CouplingSpec::Type::torsional;
  found.B = (is_printed ? 0 : spec.spring.b) * square;
  found.added_inertia = added_inertia(spec);
  found.M_added = found.added_inertia * square;
  if (spec.law == CouplingSpec::Type::god_object && spec.is_first_component())
    found.landing = robot_inertia(spec);
  return found;
}

PredictedCoupling PosedCouplings::coupling(std::size_t c, double h) {
  const SceneCoupling& spec = input_.couplings->spec(c);
  if (P_.cols() == 0)
    throw InputError(
        {{input_.scene->description.file.string(), 0, "coupling '" + spec.name + "'",
          "its robot has no joint to move", "name a robot with joints", "scene.nothing-to-drive"}});
  PredictedCoupling found = about_zero(c);
  const Vector3 offset = input_.couplings->ends(c, x_, k_).offset;
  found.offset = offset.norm();
  const bool matched = spec.law == CouplingSpec::Type::equivalent_torsional;  // linear in errors
  if (!matched) found.K = tangent(c);
  const SpringModes modes = spring_modes(M() + found.M_added, found.K, found.B);
  if (modes.size() > 0) {
    const Index last = modes.size() - 1;
    found.alone = {modes.omega(last), modes.zeta(last)};
  }
  if (found.is_linear() && !matched) add_arms(spec, offset, h, found);
  return found;
}

MatrixXd PosedCouplings::tangent(std::size_t c) {
  return by_rows(tangent_stiffness(
      model_, x_,
      [&](const State<double>& x, const Kinematics& k, Forces<double>& forces) {
        input_.couplings->hold_still(c, x, k, forces);
      },
      velocities_));
}

CoupledTerm joint_damper_term(const MatrixXd& damping, Integrator integrator) {
  const MatrixXd none = MatrixXd::Zero(damping.rows(), damping.cols());
  const bool implicit = facts_of(integrator).implicit_force;
  return {none, none, damping, implicit ? Discretization::semi_implicit : Discretization::explicit_,
          0};
}

CoupledTerm step_part(const PredictedCoupling& c, double h) {
  CoupledTerm part{c.K, c.K_zero, c.B, c.discretization, 0};
  if (c.rate > 0) part.hold_steps = static_cast<int>(std::lround(1 / (c.rate * h)));
  const StepLaw law = facts_of(c.law, c.printed).step_law;
  if (law != StepLaw::god_object) {
    part.law = law;
  } else if (c.landing.size() > 0) {
    part.law = law;
    part.K = c.landing;
  }
  return part;
}

}  // namespace twinarm
