// Painleve's rod (E7): a uniform rod of 1 m slides on its lower end, which leads. From mu = (k^2 +
// cos^2) / (sin cos), k^2 = 1/3, the normal force would have to pull: no force does it, only an
// impulse.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/support/contact_scene.h"
#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

using namespace contact_looks;

constexpr double kLength = 1, kRodRadius = 1e-3;
constexpr double kSteep = 1.107148717794090;  // cos^2 = 1/5 [rad]

// From the lower end up: (cos, 0, sin). It moves along -x.
int add_rod(ContactScene& scene, double angle, double mu, double speed, double inertia = 1) {
  scene.add_floor(surface(mu));
  const Vector3 up(std::cos(angle), 0, std::sin(angle));
  ContactScene::Body rod{Capsule{kRodRadius, kLength}, surface(mu), 1};
  rod.R = turn_about(Vector3::UnitY(), std::numbers::pi / 2 - angle);
  rod.p = 0.5 * kLength * up + Vector3(0, 0, kRodRadius);
  rod.v = {-speed, 0, 0};
  rod.inertia = Vector3(inertia / 12, inertia / 12, 1e-6).asDiagonal();
  const int body = scene.add(rod);
  scene.start();
  return body;
}

// Where n . J M^-1 J^T (n + mu x) changes its sign, by this solver's Jacobian and mass matrix.
double critical_friction(double angle, double inertia) {
  ContactScene scene;
  const int rod = add_rod(scene, angle, 0, 0, inertia);
  const Model<double>& model = scene.model();
  const State<double>& x = scene.simulation().state();
  const Eigen::MatrixXd M = mass_matrix(model, x);
  Kinematics k(model);
  forward_kinematics(model, x, k);
  const Vector3 end = k.X_WL[static_cast<std::size_t>(rod)] * Vector3(0, 0, -0.5 * kLength);
  const Eigen::MatrixXd J = point_jacobian(model, k, rod, end);
  const Eigen::Matrix3d A = J * solve_symmetric(M, J.transpose());
  return -A(2, 2) / A(2, 0);
}
CaseResult threshold_of_sign(double off) {  // inertia
  constexpr std::array angles{std::numbers::pi / 3, kSteep};
  constexpr std::array critical{1.347150628109127, 4 / 3.0};
  double error = 0;
  for (std::size_t i = 0; i < angles.size(); ++i)
    error = std::max(error, relative(critical_friction(angles[i], off), critical[i]));
  return {error};
}

// For each mu: every step is finite and solved, energy does not rise, the end does not sink; below
// the critical mu it slides on smoothly.
CaseResult slides_or_jams(double off) {  // mu
  int broken = 0;
  for (const double mu : {0.3, 0.8, 1.2, 1.3, 1.4, 2.0, 5.0}) {
    ContactScene scene;
    const int rod = add_rod(scene, kSteep, off * mu, 2);
    double lowest = 0;
    for (int n = 0; n < 1000; ++n) {
      const double before = scene.v(rod).x();
      broken += !scene.step(kStep);
      if (n < 20 && mu < 4 / 3.0) broken += std::abs(scene.v(rod).x() - before) > 0.5;
      const Vector3 axis = scene.R(rod).col(2);
      lowest = std::min(lowest, scene.p(rod).z() - 0.5 * kLength * std::abs(axis.z()) - kRodRadius);
    }
    broken += lowest < -1e-4;
    broken += scene.rise() > 1e-9;
    broken += !std::isfinite(scene.energy());
  }
  return {static_cast<double>(broken)};
}

}  // namespace

CaseFamily painleve_cases() {
  return {250,
          {contact_case<threshold_of_sign, 1>("E7-sign", 1e-12),
           contact_case<slides_or_jams, 100>("E7-rod", 0,
                                             {.readings = {"v along the floor [m/s]"},
                                              .read = velocity<1, 0>,
                                              .runs = {"μ = 0.3", "0.8", "1.2", "1.3", "1.4", "2"},
                                              .no_steps = kCounted})}};
}

}  // namespace twinarm
