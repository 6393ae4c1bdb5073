// C3, C4, C5: hanging chains of n links, 1 m long.
// C3, equal point masses: w_i^2 = n g x_i, x_i the zeros of Laguerre's polynomial L_n, which are
// the eigenvalues of its symmetric tridiagonal matrix (2k + 1; k) (Golub, Welsch 1969).
// C4, rods, absolute angles: M_ij = m a^2 (n - j + 1/2) for i < j, M_ii = m a^2 (n - i + 1/3),
// K_ii = m g a (n - i + 1/2), a = 1/n, i from 1; for n -> infinity w_k = j_(0,k)/2 sqrt(g/L).
// C5, a folded chain, one end released, energy conserved (Calkin, March, Am. J. Phys. 57, 1989):
// v^2 = 2 g x (1 - x/2L)/(1 - x/L); a chain of n links approximates it.
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

CaseReadings laguerre_frequencies(int n) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    T(k, k) = 2 * k + 1;
    if (k > 0) T(k, k - 1) = T(k - 1, k) = k;
  }
  CaseReadings all;
  for (const double x : symmetric_eigenvalues(T)) all.push_back(std::sqrt(n * kGravity * x));
  return all;
}

// The lowest `count` frequencies of a chain of n rods.
CaseReadings rod_chain_frequencies(int n, int count) {
  const double a = 1.0 / n;
  Eigen::MatrixXd M(n, n), K = Eigen::MatrixXd::Zero(n, n);  // for m = 1
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int lower = std::max(i, j);
      M(i, j) = a * a * (n - lower - 1 + (i == j ? 1.0 / 3 : 0.5));
    }
    K(i, i) = kGravity * a * (n - i - 0.5);
  }
  // K is well conditioned: the slow modes are the largest eigenvalues of M x = mu K x.
  const Eigen::VectorXd slow = generalized_eigenvalues(M, K);
  CaseReadings all;
  for (int k = 0; k < count; ++k) all.push_back(1 / std::sqrt(slow[n - 1 - k]));
  return all;
}

std::vector<std::string> mode_names(std::size_t count) {
  std::vector<std::string> all;
  for (std::size_t k = 1; k <= count; ++k) all.push_back("w" + std::to_string(k) + " [rad/s]");
  return all;
}

// Lowest frequencies of a chain that hangs at rest.
TrajectoryCase chain_modes(const ChainLink& link, int n, const CaseReadings& exact) {
  const std::size_t count = exact.size();
  return evaluation(
      at_rest(plane_chain(link, n)), mode_names(count),
      [count](ModelRef model, StateRef x) {
        CaseReadings all = small_frequencies(model, x);
        all.resize(count);
        return all;
      },
      exact, relative_each);
}

// Finite chains have higher frequencies, by 0.0307 / n^2.
TrajectoryCase rope_mode() {
  return chain_modes(rod_link(1, 1.0 / 50), 50,
                     {special::zero_of_bessel(1) / 2 * std::sqrt(kGravity)});
}

// ---- C5 ----

constexpr int kDown = 20, kFoldedLinks = 2 * kDown + 1;  // down, one horizontal link, up
constexpr double kFoldedLink = 1.0 / kFoldedLinks, kDeep = 0.9;

CaseScene folded_chain() {
  std::vector<double> q(kFoldedLinks, 0.0);
  q[kDown] = q[kDown + 1] = std::numbers::pi / 2;
  return start_at(plane_chain(rod_link(kFoldedLink, kFoldedLink), kFoldedLinks), q,
                  std::vector<double>(kFoldedLinks, 0.0));
}
// Mutant: joint damping slows the tip.
void add_damping(CaseScene& scene) {
  for (double& damping : scene.model.damping) damping = 1e-4;
}

double tip_depth(ModelRef model, StateRef x) {
  const Kinematics k = kinematics_at(model, x);
  return -k.position(kFoldedLinks, {0, 0, -kFoldedLink}).z();
}

// From rest at depth 0, chain of 1 m.
Real folded_fall_time(Real depth) {
  // x = s^2: the speed is sqrt(2 g x) near x = 0.
  const auto slowness = [](Real s) {
    const Real x = s * s;
    return 2 * std::sqrt((1 - x) / (2 * 9.81L * (1 - x / 2)));
  };
  return special::integral(slowness, 0, std::sqrt(depth));
}

TrajectoryCase folded_fall() {
  return {.scene = folded_chain,
          .reference = [](double) { return values(folded_fall_time(kDeep)); },
          .measure = relative_each,
          .mutant = add_damping,
          .events = {[](ModelRef model, StateRef x) { return tip_depth(model, x) - kDeep; }, 1, 1}};
}
TrajectoryCase folded_energy() {
  TrajectoryCase c = folded_fall();
  c.events = {};
  c.times = {0.1, 0.2, 0.3, 0.35};
  c.readings = {"energy [J]"};
  c.observe = observe_energy;
  // Two straight halves, and the horizontal link below them.
  constexpr double half = kDown * kFoldedLink;
  c.reference = constantly({-kGravity * (2 * half * half / 2 + kFoldedLink * half)});
  c.measure = max_difference;
  c.integration = dopri5_with(1e-12);
  return c;
}

}  // namespace

CaseFamily hanging_chain_cases() {
  std::vector<AnalyticCase> all;
  for (const int n : {1, 2, 3, 4, 5, 6, 8, 10})
    all.push_back({"C3-" + std::to_string(n), 1e-10,
                   chain_modes(point_link(1, 1.0 / n), n, laguerre_frequencies(n))});
  for (const int n : {1, 2, 5, 10, 20, 50})
    all.push_back({"C4-" + std::to_string(n), 1e-10,
                   chain_modes(rod_link(1, 1.0 / n), n, rod_chain_frequencies(n, std::min(n, 3)))});
  all.push_back({"C4-rope", 1.3e-5, rope_mode()});
  all.push_back({"C5", 0.01, folded_fall()});
  all.push_back({"C5-energy", 1e-8, folded_energy()});
  return {120, all};
}

}  // namespace twinarm
