// What `inspect` checks of a step, and of all its numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/inspect/report/inspect_output.h"
#include "solver/model/non_finite.h"

namespace twinarm {

Check step_check(const Inspection& in, const std::vector<double>& qdd_of_step) {
  constexpr double kTolerance = 1e-9;  // of what the impulse solver leaves
  Check check{"step", "the step's own accelerations, forces by name", 0, kTolerance, ""};
  const Vector3 g = to_eigen(in.model.gravity);
  double size = std::max(g.norm(), 1e-300);
  for (const double qdd : qdd_of_step) size = std::max(size, std::abs(qdd));
  for (std::size_t i = 1; i < in.body_count(); ++i)
    for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof) {
      const double error = std::abs(in.w.qdd[dof] - qdd_of_step[dof]) / size;
      if (!(error <= check.error)) {
        check.error = std::isfinite(error) ? error : 1e300;
        check.worst = in.model.body_name[i];
      }
    }
  return check;
}

void warn_of_bad_numbers(const Inspection& in, std::vector<std::string>& warnings) {
  const BadQuantity bad = first_bad_quantity(in.model, in.forces, in.w);
  if (bad.body == 0) return;
  const std::string pass = bad.pass == 0 ? "an input" : "of pass " + std::to_string(bad.pass);
  warnings.push_back(fmt::format(
      "not all numbers are finite; the first that is not is '{}' of body '{}', {}: look at an "
      "earlier instant",
      bad.name, in.model.body_name[bad.body], pass));
}

}  // namespace twinarm
