#include "app/coupling/predicted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/coupling/posed_couplings.h"

namespace twinarm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void name_rows(const Coordinates& coordinates, Predicted& found) {
  found.rows.resize(static_cast<std::size_t>(coordinates.rows()));
  found.is_angle.resize(found.rows.size());
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components()) {
      if (c.v < 0) continue;
      const bool is_base = coordinates.floating() && joint.body == coordinates.base().body;
      const std::string name = is_base ? "base" : joint.name;
      const std::size_t row = joint.row + static_cast<std::size_t>(c.v);
      found.rows[row] = *c.label ? name + "/" + c.label : name;
      found.is_angle[row] = c.is_angle;
    }
}

int held_steps(const SceneCoupling& spec, double h) {
  return spec.rate > 0 ? static_cast<int>(std::lround(1 / (spec.rate * h))) : 0;
}

// The scheme of the table that steps all couplings alike, where one does.
std::optional<Scheme> scheme_of_scene(const std::vector<PredictedCoupling>& couplings,
                                      Integrator integrator) {
  const PredictedCoupling& first = couplings.front();
  for (const PredictedCoupling& c : couplings)
    if (c.treatment != first.treatment || c.printed != first.printed || c.rate > 0) return {};
  if (first.printed)
    return integrator == Integrator::euler ? Scheme::euler_difference
                                           : Scheme::semi_implicit_difference;
  if (first.treatment == Treatment::implicit) return Scheme::implicit;
  if (first.treatment == Treatment::semi_implicit) return Scheme::implicit_damper;
  switch (integrator) {
    case Integrator::euler:
      return Scheme::euler;
    case Integrator::semi_implicit:
    case Integrator::semi_implicit_xv:
      return Scheme::semi_implicit;
    case Integrator::rk4:
      return Scheme::rk4;
    default:
      return {};
  }
}

ModeErrors errors_of_mode(double omega, double zeta, const PredictTask& task) {
  constexpr TargetMove kSmooth[] = {TargetMove::cubic, TargetMove::quintic, TargetMove::cosine,
                                    TargetMove::bang_bang};
  const double v = task.distance / task.time;
  ModeErrors errors;
  errors.start = peak_after_jump(v, omega, zeta);
  errors.reversal = peak_after_jump(2 * v, omega, zeta);
  for (std::size_t i = 0; i < 4; ++i)
    errors.smooth[i] = FollowingError(kSmooth[i], task.distance, task.time, omega, zeta).peak();
  errors.absolute_lag = absolute_damper_lag(v, omega, zeta);
  errors.weld_lag = mocap_weld_lag(v, 1 / omega);
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
    if (modes.squares[i] < 0)
      found.warnings.push_back(fmt::format(
          "along a mode, most of it '{}', the couplings push away from their targets: the state is "
          "beyond what they can hold (a point spring pulls back as the sine of the angle)",
          found.rows[static_cast<std::size_t>(largest)]));
    found.modes.push_back(std::move(mode));
  }
}

void add_limits(const SceneModel& scene, const MatrixXd& joint_damping, Predicted& found) {
  const std::optional<Scheme> own = scheme_of_scene(found.couplings, found.integrator);
  for (const Scheme scheme : all_schemes) {
    const auto factor = [&](Keep keep) {
      return largest_stiffness_factor(found.M, found.K, found.B, scheme, found.step, keep);
    };
    found.limits.push_back({scheme, largest_stable_step(found.M, found.K, found.B, scheme),
                            factor(Keep::damping_per_stiffness), factor(Keep::damping_ratio),
                            own && *own == scheme});
  }
  std::vector<StepPart> parts;
  for (std::size_t c = 0; c < found.couplings.size(); ++c) {
    const PredictedCoupling& of = found.couplings[c];
    parts.push_back(
        {of.K, of.K_zero, of.B, of.treatment, held_steps(scene.couplings[c], found.step)});
  }
  // Dampers of joints are implicit in the step of the semi-implicit integrators.
  const bool implicit = facts_of(found.integrator).implicit_force;
  const MatrixXd none = MatrixXd::Zero(found.K.rows(), found.K.cols());
  parts.push_back(
      {none, none, joint_damping, implicit ? Treatment::semi_implicit : Treatment::explicit_, 0});
  found.largest_step = largest_stable_step(found.M, parts, found.integrator);
  if (found.integrator != Integrator::dopri5)
    found.growth = growth_per_step(found.M, parts, found.integrator, found.step);
}

std::string words_of_step(const Predicted& found) {
  std::vector<std::string> words;
  for (const PredictedCoupling& c : found.couplings) {
    std::string word = word_of(c.treatment);
    if (c.rate > 0) word += fmt::format(", held at {:g} Hz", c.rate);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  return fmt::format("{}, couplings {}", integrator_name(found.integrator), fmt::join(words, "; "));
}

void add_warnings(const SceneModel& scene, Predicted& found) {
  const auto warn = [&](std::string text) { found.warnings.push_back(std::move(text)); };
  constexpr double kGrows = 1e-9;
  if (found.growth > 1 + kGrows && found.largest_step > 0)
    warn(
        fmt::format("the scene's step of {:g} s is beyond its limit of {:.4g} s: an error grows by "
                    "{:.3g} in each; take a shorter --step, a smaller stiffness, or treatment = "
                    "\"implicit\"",
                    found.step, found.largest_step, found.growth));
  else if (found.growth > 1 + kGrows)
    warn(
        fmt::format("as this scene is stepped no step is stable: an error grows by {:.6g} in each "
                    "of {:g} s; take another --integrator, more damping, or treatment = "
                    "\"implicit\"",
                    found.growth, found.step));
  for (const SceneCoupling& spec : scene.couplings)
    if (spec.delay > 0)
      warn(
          fmt::format("'{}' sees its target {:g} s late: at a speed v it stands that much times v "
                      "behind, whatever its gains",
                      spec.name, spec.delay));
  for (const PredictedCoupling& c : found.couplings) {
    if (c.law == CouplingSpec::Type::god_object)
      warn(fmt::format("'{}' is a constraint, not a spring: it is left out", c.name));
    if (c.printed && !c.is_linear)
      warn(
          fmt::format("'{}': the torsional damper as printed has no linear part; it is predicted "
                      "without one",
                      c.name));
    if (c.absolute_damper)
      warn(
          fmt::format("'{}' has an absolute damper: besides the errors behind a moving target it "
                      "lags, steadily, as the column says",
                      c.name));
    for (const SpringArm& arm : c.arms)
      if (c.treatment == Treatment::implicit && arm.target_radius > arm.largest_target_radius)
        warn(
            fmt::format("'{}', about '{}': its target lies {:.4g} m from the axis, beyond the "
                        "{:.4g} m that an implicit point spring holds in this step",
                        c.name, arm.joint, arm.target_radius, arm.largest_target_radius));
  }
  if (!scene.constraints.empty()) warn("constraints are left out: they stiffen what they hold");
  if (scene.may_touch()) warn("contacts are left out");
}

}  // namespace

const char* word_of(Treatment treatment) {
  switch (treatment) {
    case Treatment::explicit_:
      return "explicit";
    case Treatment::semi_implicit:
      return "semi-implicit";
    case Treatment::implicit:
      break;
  }
  return "implicit";
}

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
    if (input.couplings->spec(c).outside) continue;  // a stop mostly does not act
    found.couplings.push_back(posed.coupling(c, found.step));
    PredictedCoupling& coupling = found.couplings.back();
    if (task.wall && coupling.is_linear)
      coupling.with_wall = series_stiffness(coupling.gains.k, *task.wall);
    found.K += coupling.K;
    found.B += coupling.B;
    found.M += coupling.felt;
  }
  if (!found.K.allFinite() || !found.M.allFinite())
    throw InputError(
        {{scene.description.file.string(), 0, "",
          "stiffness or inertia is not finite in this state", "give smaller numbers"}});
  found.stepped = words_of_step(found);
  add_modes(task, found);
  add_limits(scene, posed.joint_damping(), found);
  found.sag = chain_sag(found.K, posed.gravity());
  add_warnings(scene, found);
  return found;
}

}  // namespace twinarm
