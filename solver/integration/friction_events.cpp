#include "solver/integration/friction_events.h"

#include <algorithm>
#include <limits>

namespace twinarm {
namespace {

// A held dof breaks loose where its limit is passed by this part: far above the rounding by which
// the choice at the new start could take it for held.
constexpr double kBeyondLimit = 1e-10;

}  // namespace

void FrictionEventFunction::start(const IntegrationState& m) {
  const ForwardDynamics& dynamics = m.dynamics;
  for (std::size_t k = 0; k < slid_.size(); ++k)
    slid_[k] = m.x.qd[dynamics.families()[k].dof] * static_cast<double>(dynamics.mode(k)) > 0;
  at_start_ = (*this)(dynamics, m.x);
}

double FrictionEventFunction::operator()(const ForwardDynamics& dynamics,
                                         const State<double>& x) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < slid_.size(); ++k)
    if (slid_[k])
      least =
          std::min(least, x.qd[dynamics.families()[k].dof] * static_cast<double>(dynamics.mode(k)));
  return dynamics.holds_any() ? std::min(least, dynamics.slack() + kBeyondLimit) : least;
}

}  // namespace twinarm
