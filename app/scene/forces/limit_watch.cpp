#include "app/scene/forces/limit_watch.h"

#include <fmt/format.h>

#include "solver/support/number_text.h"

namespace twinarm {

void LimitWatch::look(double t, const State<double>& x) {
  for (Limit& limit : limits_) {
    const double q = x.q[limit.iq];
    const double slack = 1e-9;  // a joint that rests at its limit is not beyond it
    if (limit.is_told || (q >= limit.joint->lower - slack && q <= limit.joint->upper + slack))
      continue;
    limit.is_told = true;
    warnings_.push_back(fmt::format(
        "joint '{}' stands at {} beyond its limits {} .. {} at t = {} s: position limits do not "
        "act here",
        limit.joint->name, short_number_text(q), short_number_text(limit.joint->lower),
        short_number_text(limit.joint->upper), short_number_text(t)));
  }
}

}  // namespace twinarm
