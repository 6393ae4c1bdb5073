
#include <fmt/format.h>

#include "app/coupling/posed_couplings.h"
#include "app/robot/robot_output.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void name_rows(const Coordinates& coordinates, Predicted& found) {
  found.rows = row_names(coordinates);
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components())
      if (c.v >= 0) found.is_angle.push_back(c.is_angle);
}

// Force at the start of the step, with a velocity by difference.
std::optional<SteppingScheme> scheme_as_printed(Integrator integrator) {
  switch (integrator) {
    case Integrator::semi_implicit:
    case Integrator::semi_implicit_xv:
    case Integrator::implicit_euler:
      return SteppingScheme::semi_implicit_difference;
    case Integrator::euler:
      return SteppingScheme::euler_difference;
    case Integrator::dopri5:
      return {};
    default:
      return SteppingScheme::hold_difference;
  }
}

// The scheme of the table that applies to all couplings, if there is one.
std::optional<SteppingScheme> scheme_of_scene(const std::vector<PredictedCoupling>& couplings,
                                              Integrator integrator) {
  const PredictedCoupling& first = couplings.front();
  for (const PredictedCoupling& c : couplings)
    if (c.discretization != first.discretization || c.printed != first.printed || c.rate > 0 ||
        c.is_own_discretization())
      return {};
  if (first.printed) return scheme_as_printed(integrator);
  if (first.discretization == Discretization::implicit) return SteppingScheme::implicit;
  if (first.discretization == Discretization::semi_implicit) return SteppingScheme::implicit_damper;
  switch (integrator) {
    case Integrator::euler:
      return SteppingScheme::euler;
    case Integrator::semi_implicit:
    case Integrator::semi_implicit_xv:
      return SteppingScheme::semi_implicit;
    case Integrator::rk4:
      return SteppingScheme::rk4;
    default:
      return {};
  }
}

ModeErrors errors_of_mode(double omega, double zeta, const PredictTask& task) {
  const double v = task.distance / task.time;
  ModeErrors errors;
  errors.start = peak_after_jump(v, omega, zeta);
  errors.reversal = peak_after_jump(2 * v, omega, zeta);
  const auto one = [](double value) { return MatrixXd::Constant(1, 1, value); };
  const MultiJointTrackingError behind({one(1), one(omega * omega), one(2 * zeta * omega), one(0)});
  for (std::size_t i = 0; i < kSmoothMoves.size(); ++i)
    errors.smooth[i] =
        behind.behind(kSmoothMoves[i], VectorXd::Constant(1, task.distance), task.time)[0];
  errors.absolute_lag = absolute_damper_error(v, omega, zeta);
  errors.weld_lag = mocap_weld_error(v, 1 / omega);
  return errors;
}

void add_modes(const PredictTask& task, Predicted& found) {
  const SpringModes modes = spring_modes(found.M, found.K, found.B);
  for (Index i = 0; i < modes.size(); ++i) {
    PredictedMode mode;
    mode.omega = modes.omega(i);
    mode.zeta = modes.zeta(i);
    mode.shape = modes.shapes.col(i);
    Index largest = 0;
    mode.shape.cwiseAbs().maxCoeff(&largest);
    mode.shape /= double(mode.shape[largest]);
    if (mode.omega > 0) mode.errors = errors_of_mode(mode.omega, mode.zeta, task);
    if (modes.omega_squared[i] < 0)
      found.warnings.push_back(fmt::format(
          "negative stiffness along a mode, mainly of '{}': the couplings push away from their "
          "targets (a point spring acts with the sine of the angle to its target)",
          found.rows[static_cast<std::size_t>(largest)]));
    found.modes.push_back(std::move(mode));
  }
}

void add_limits(const MatrixXd& joint_damping, Predicted& found) {
  const std::optional<SteppingScheme> own = scheme_of_scene(found.couplings, found.integrator);
  for (const SteppingScheme scheme : all_schemes) {
    const auto factor = [&](HoldConstant keep) {
      return max_stiffness_factor(found.M, found.K, found.B, scheme, found.step, keep);
    };
    found.limits.push_back({scheme, max_stable_step(found.M, found.K, found.B, scheme),
                            factor(HoldConstant::damping_per_stiffness),
                            factor(HoldConstant::damping_ratio), own && *own == scheme});
  }
  std::vector<CoupledTerm> parts;
  for (const PredictedCoupling& c : found.couplings) parts.push_back(step_part(c, found.step));
  parts.push_back(joint_damper_term(joint_damping, found.integrator));
  found.max_step = max_stable_step(found.M, parts, found.integrator);
  if (found.integrator != Integrator::dopri5)
    found.growth = spectral_radius(found.M, parts, found.integrator, found.step);
}

// Share of the distance by row.
VectorXd shares_of_move(const PredictTask& task, const Predicted& found) {
  if (task.along.empty()) return VectorXd::Ones(found.M.rows());
  VectorXd parts = VectorXd::Zero(found.M.rows());
  DiagnosticList faults;
  for (const auto& [name, part] : task.along) {
    const auto row = std::ranges::find(found.rows, name);
    if (row == found.rows.end())
      faults.add("--along", "there is no joint '" + name + "'",
                 name_remedy(name, found.rows, "joints"), "option.unknown-name");
    else
      parts[row - found.rows.begin()] = part;
  }
  faults.check();
  return parts;
}

// Joint damping acts on the robot's velocity, like absolute dampers.
void add_errors(const PredictTask& task, const MatrixXd& friction, Predicted& found) {
  constexpr std::size_t kMaxRows = 50;
  if (found.rows.size() > kMaxRows) return;
  MatrixXd absolute = friction, late = friction;
  for (const PredictedCoupling& c : found.couplings) {
    if (c.absolute_damper) absolute += c.B;
    late += (c.absolute_damper ? c.B : MatrixXd::Zero(c.B.rows(), c.B.cols())) + c.delay * c.K;
  }
  VectorXd distance = shares_of_move(task, found);
  for (std::size_t r = 0; r < found.rows.size(); ++r)
    distance[static_cast<Index>(r)] *= found.is_angle[r] ? task.distance : task.slide();
  const VectorXd v = distance / task.time;
  const MultiJointTrackingError behind({found.M, found.K, found.B + friction, absolute});
  RowErrors errors;
  errors.distance = distance;
  errors.start = behind.after_start(v, task.time);
  errors.reversal = behind.after_reversal(v, task.time);
  for (std::size_t i = 0; i < kSmoothMoves.size(); ++i)
    errors.smooth[i] = behind.behind(kSmoothMoves[i], distance, task.time);
  const MultiJointTrackingError delayed({found.M, found.K, found.B + friction, late});
  errors.lag = delayed.steady_state(v);
  found.errors = std::move(errors);
}

// Joints of a god object reach their targets in each step: no error, no deflection.
void clear_errors_of_god_objects(Predicted& found) {
  for (const PredictedCoupling& c : found.couplings)
    for (Index j = 0; j < c.landing.rows(); ++j) {
      if (c.landing.row(j).isZero(0)) continue;
      found.sag[j] = 0;
      if (!found.errors) continue;
      RowErrors& e = *found.errors;
      for (VectorXd* all : {&e.start, &e.reversal, &e.lag}) (*all)[j] = 0;
      for (VectorXd& smooth : e.smooth) smooth[j] = 0;
    }
}

std::string words_of_step(const Predicted& found) {
  std::vector<std::string> words;
  for (const PredictedCoupling& c : found.couplings) {
    std::string word = c.is_own_discretization() ? facts_of(c.law, c.printed).name
                       : c.printed               ? "as printed"
                                                 : name_of(c.discretization);
    if (c.rate > 0) word += fmt::format(", held at {:g} Hz", c.rate);
    if (std::ranges::find(words, word) == words.end()) words.push_back(word);
  }
  return fmt::format("{}, couplings {}", integrator_name(found.integrator), fmt::join(words, "; "));
}

void add_warnings(const SceneModel& scene, Predicted& found) {
  const auto warn = [&](std::string text) { found.warnings.push_back(std::move(text)); };
  constexpr double kRounding = 1e-9;
  if (found.growth > 1 + kRounding && found.max_step > 0)
    warn(fmt::format(
        "unstable: the scene's step of {:g} s exceeds the stability limit {:.4g} s (spectral "
        "radius {:.3g}); use a shorter --step, a smaller stiffness, or discretization = "
        "\"implicit\"",
        found.step, found.max_step, found.growth));
  else if (found.growth > 1 + kRounding)
    warn(fmt::format(
        "unstable at any step (spectral radius {:.6g} at {:g} s); use another --integrator, more "
        "damping, or discretization = \"implicit\"",
        found.growth, found.step));
  for (const SceneCoupling& spec : scene.couplings)
    if (spec.delay > 0)
      warn(
          fmt::format("'{}' has a target delay of {:g} s: at a velocity v it adds a tracking error "
                      "of delay times v, at any gains",
                      spec.name, spec.delay));
  for (const PredictedCoupling& c : found.couplings) {
    if (c.law == CouplingSpec::Type::god_object)
      warn(fmt::format(
          "'{}' is a constraint: it has no stiffness, frequency or stability limit; each step it "
          "reaches its target unless blocked by a contact",
          c.name));
    if (c.printed && !c.is_linear())
      warn(fmt::format("'{}': the torsional damper as printed has no linear part and is left out",
                       c.name));
    if (c.absolute_damper && c.gains.b > 0)
      warn(
          fmt::format("'{}' has an absolute damper: its tracking error at constant velocity is in "
                      "the column 'absolute lag'",
                      c.name));
    for (const SpringArm& arm : c.arms)
      if (c.discretization == Discretization::implicit && arm.target_radius > arm.max_target_radius)
        warn(fmt::format(
            "'{}', about '{}': unstable: target {:.4g} m from the axis, an implicit point spring "
            "is stable up to {:.4g} m at this step",
            c.name, arm.joint, arm.target_radius, arm.max_target_radius));
  }
  if (!scene.constraints.empty()) warn("constraints are left out");
  if (!scene.springs.empty()) warn("springs are left out");
  if (scene.may_touch()) warn("contacts are left out");
}

}  // namespace

Predicted predict_couplings(SimulatePlan& prepared, const PredictTask& task) {
  SimulateInput& input = prepared.input;
  const SceneModel& scene = *input.scene;
  PosedCouplings posed(input);
  Predicted found;
  name_rows(input.robot.coordinates, found);
  found.warnings = input.robot.warnings;
  found.integrator = prepared.run.integrator;
  found.step = prepared.run.step;
  found.M = posed.M();
  found.K = MatrixXd::Zero(found.M.rows(), found.M.cols());
  found.B = found.K;
  for (std::size_t c = 0; c < input.couplings->size(); ++c) {
    if (input.couplings->spec(c).soft_limits)
      continue;  // soft limits are inactive in the nominal pose
    found.couplings.push_back(posed.coupling(c, found.step));
    PredictedCoupling& coupling = found.couplings.back();
    if (task.wall && coupling.is_linear())
      coupling.with_wall = series_stiffness(coupling.gains.k, *task.wall);
    found.K += coupling.K;
    found.B += coupling.B;
    found.M += coupling.M_added;
  }
  if (found.couplings.empty())
    throw InputError({{scene.description.file.string(), 0, "scene",
                       "all couplings are soft limits, which do not act between their bounds",
                       "add a [[coupling]] without 'outside' (docs/reference/scene_file.md)",
                       "scene.only-stops"}});
  if (!found.K.allFinite() || !found.M.allFinite())
    throw InputError({{scene.description.file.string(), 0, "",
                       "stiffness or inertia is not finite in this state", "give smaller numbers",
                       "state.not-finite"}});
  found.stepped = words_of_step(found);
  add_modes(task, found);
  const MatrixXd friction = posed.joint_damping();
  add_limits(friction, found);
  found.sag = chain_sag(found.K, posed.gravity());
  add_errors(task, friction, found);
  clear_errors_of_god_objects(found);
  add_warnings(scene, found);
  return found;
}

}  // namespace twinarm
