#include "coupling/analysis/gains.h"

#include "coupling/analysis/joint_space_stiffness.h"
#include "coupling/analysis/step_matrix.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

using Eigen::MatrixXd;

namespace {

// By SteppingScheme: name, integrator and term of the step matrix.
struct SchemeFacts {
  const char* name;
  Integrator integrator = Integrator::semi_implicit;
  Discretization discretization = Discretization::explicit_;
  int hold_steps = 0;
  StepLaw law = StepLaw::spring_damper;
  bool older = false;
};
constexpr std::array<SchemeFacts, all_schemes.size()> kSchemes{{
    {.name = "explicit Euler", .integrator = Integrator::euler},
    {.name = "semi-implicit Euler"},
    {.name = "explicit Euler, backward difference",
     .integrator = Integrator::euler,
     .law = StepLaw::printed},
    {.name = "semi-implicit Euler, backward difference"},
    {.name = "semi-implicit Euler, difference one frame older",
     .law = StepLaw::printed,
     .older = true},
    {.name = "zero-order hold, true velocity", .integrator = Integrator::midpoint, .hold_steps = 1},
    {.name = "zero-order hold, backward difference",
     .integrator = Integrator::midpoint,
     .law = StepLaw::printed},
    {.name = "Runge-Kutta of order 4", .integrator = Integrator::rk4},
    {.name = "semi-implicit Euler, damper implicit",
     .discretization = Discretization::semi_implicit},
    {.name = "spring and damper implicit", .discretization = Discretization::implicit},
}};
const SchemeFacts& facts_of(SteppingScheme scheme) {
  return kSchemes[static_cast<std::size_t>(scheme)];
}

// With M = 1, alpha = h^2 K, beta = h B; the step is the unit of time.
bool is_stable_step(const MatrixXd& alpha, const MatrixXd& beta, SteppingScheme scheme) {
  constexpr double kRounding = 1e-9;
  const SchemeFacts& facts = facts_of(scheme);
  const CoupledTerm part{alpha,     alpha,      beta, facts.discretization, facts.hold_steps,
                         facts.law, facts.older};
  return growth_of_modes({part}, facts.integrator, 1) <= 1 + kRounding;
}

}  // namespace

const char* name_of(SteppingScheme scheme) {
  return facts_of(scheme).name;
}

double max_stable_step(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B,
                       SteppingScheme scheme) {
  const SpringModes modes = spring_modes(M, K, B);
  if (modes.size() == 0) return kNoLimit;
  const MatrixXd omega_squared = modes.omega_squared.asDiagonal();
  const double rate = modes.max_rate();
  return max_stable(
      [&](double h) { return is_stable_step(h * h * omega_squared, h * modes.damping, scheme); },
      1e-4 / rate, 1e4 / rate);
}

double max_stiffness_factor(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B,
                            SteppingScheme scheme, double h, HoldConstant keep) {
  check_step_size(h);
  const SpringModes modes = spring_modes(M, K, B);
  if (modes.size() == 0) return kNoLimit;
  const MatrixXd omega_squared = modes.omega_squared.asDiagonal();
  const auto stable = [&](double factor) {
    const double of_b = keep == HoldConstant::damping_ratio ? std::sqrt(factor) : factor;
    return is_stable_step(factor * h * h * omega_squared, of_b * h * modes.damping, scheme);
  };
  const double product = std::max(modes.max_rate() * h, 1e-12);
  return max_stable(stable, 1e-6 / (product * product), 1e8);
}

double max_omega_h(SteppingScheme scheme, double zeta) {
  const auto stable = [&](double wh) {
    return is_stable_step(MatrixXd::Constant(1, 1, wh * wh),
                          MatrixXd::Constant(1, 1, 2 * zeta * wh), scheme);
  };
  return max_stable(stable, 1e-4, 1e4);
}

double joint_inertia(const Eigen::MatrixXd& M, Eigen::Index velocity) {
  return 1 / inverse_of(M)(velocity, velocity);
}

Eigen::Vector3d principal_inertias(const Eigen::MatrixXd& M, const Eigen::Matrix3Xd& J) {
  constexpr double kImmovable = 1e-12;
  const Eigen::Matrix3d mobility = J * solve_symmetric(M, J.transpose());
  const Eigen::VectorXd values = symmetric_eigenvalues((mobility + mobility.transpose()) / 2);
  Eigen::Vector3d inertias;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double value = values[2 - i];
    inertias[i] =
        value > kImmovable * values[2] ? 1 / value : std::numeric_limits<double>::infinity();
  }
  return inertias;
}

// w^2 = d k_ref and 2 z w = d b_ref.
SpringGains gains_of(const Solref& solref, double inertia, const MujocoImpedance& impedance) {
  const double part = impedance.d / impedance.d_max;
  if (solref.is_direct())
    return {-inertia * solref.first * part * part, -inertia * solref.second * part};
  return gains_of(SpringResponse{part / (solref.first * solref.second), solref.second}, inertia);
}

Solref solref_of(const SpringGains& gains, double inertia, const MujocoImpedance& impedance) {
  const SpringResponse response = response_of(gains, inertia);
  return {impedance.d / (impedance.d_max * response.omega * response.zeta), response.zeta};
}

Solref direct_solref_of(const SpringGains& gains, double inertia,
                        const MujocoImpedance& impedance) {
  const double part = impedance.d / impedance.d_max;
  return {-gains.k / (inertia * part * part), -gains.b / (inertia * part)};
}

Drive drive_of(const SpringGains& gains, double inertia, Drive::Mode mode) {
  const double by = mode == Drive::Mode::acceleration ? inertia : 1;
  return {gains.k / by, gains.b / by, mode};
}
SpringGains gains_of(const Drive& drive, double inertia) {
  const double by = drive.mode == Drive::Mode::acceleration ? inertia : 1;
  return {drive.stiffness * by, drive.damping * by};
}

}  // namespace twinarm
