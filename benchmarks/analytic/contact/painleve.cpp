// E7: Painleve's rod: a uniform rod of 1 m slides on its lower end, which leads. Above mu = (k^2 +
// cos^2) / (sin cos), k^2 = 1/3, no compressive normal force solves the equations of motion; an
// impulse does.
#include <array>

#include "benchmarks/analytic/support/contact_scene.h"
#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kLength = 1, kRodRadius = 1e-3;
constexpr double kSteep = 1.107148717794090;  // cos^2 = 1/5 [rad]

// Its direction from the lower end is (cos, 0, sin); it moves along -x.
int add_rod(ContactScene& scene, double angle, double mu, double speed, double inertia = 1) {
  const Vector3 up(std::cos(angle), 0, std::sin(angle));
  ContactScene::Body rod{Capsule{kRodRadius, kLength}, surface(mu), 1};
  rod.R = rotation_about(Vector3::UnitY(), std::numbers::pi / 2 - angle);
  rod.p = 0.5 * kLength * up + Vector3(0, 0, kRodRadius);
  rod.v = {-speed, 0, 0};
  rod.inertia = Vector3(inertia / 12, inertia / 12, 1e-6).asDiagonal();
  return scene.start_on_floor(rod);
}

// mu at which n . J M^-1 J^T (n + mu x) changes its sign, by the solver's Jacobian and mass matrix.
double critical_friction(double angle, double inertia) {
  ContactScene scene;
  const int rod = add_rod(scene, angle, 0, 0, inertia);
  const Model<double>& model = scene.model();
  const State<double>& x = scene.simulation().state();
  const Eigen::MatrixXd M = mass_matrix(model, x);
  const Kinematics& k = scene.simulation().kinematics();
  const Vector3 end = k.X_WL[static_cast<std::size_t>(rod)] * Vector3(0, 0, -0.5 * kLength);
  const Eigen::MatrixXd J = point_jacobian(model, k, rod, end);
  const Eigen::Matrix3d A = J * solve_symmetric(M, J.transpose());
  return -A(2, 2) / A(2, 0);
}
CaseResult threshold_of_sign(double scale) {  // inertia
  constexpr std::array angles{std::numbers::pi / 3, kSteep};
  constexpr std::array critical{1.347150628109127, 4 / 3.0};
  double error = 0;
  for (std::size_t i = 0; i < angles.size(); ++i)
    error = std::max(error, relative(critical_friction(angles[i], scale), critical[i]));
  return {error};
}

// Violations for each mu: a step that is not finite or not solved, a rise of energy, penetration of
// the end; below the critical mu also a jump of the velocity.
CaseResult slides_or_jams(double scale) {  // mu
  int violations = 0;
  for (const double mu : {0.3, 0.8, 1.2, 1.3, 1.4, 2.0, 5.0}) {
    ContactScene scene;
    const int rod = add_rod(scene, kSteep, scale * mu, 2);
    double lowest = 0;
    for (int n = 0; n < 1000; ++n) {
      const double before = scene.v(rod).x();
      violations += !scene.step(kStep);
      if (n < 20 && mu < 4 / 3.0) violations += std::abs(scene.v(rod).x() - before) > 0.5;
      const Vector3 axis = scene.R(rod).col(2);
      lowest = std::min(lowest, scene.p(rod).z() - 0.5 * kLength * std::abs(axis.z()) - kRodRadius);
    }
    violations += lowest < -1e-4;
    violations += scene.rise() > 1e-9;
    violations += !std::isfinite(scene.energy());
  }
  return {static_cast<double>(violations)};
}

}  // namespace

CaseFamily painleve_cases() {
  const Plot speed{{"v along the floor [m/s]"}, velocity<1, 0>};
  return {250,
          {contact_case<threshold_of_sign, 1>("E7-sign", 1e-12),
           contact_case<slides_or_jams, 100>("E7-rod", 0,
                                             speed.without_convergence(kCounted).of_runs(
                                                 {"μ = 0.3", "0.8", "1.2", "1.3", "1.4", "2"}))}};
}

}  // namespace twinarm
