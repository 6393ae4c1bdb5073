#include "app/compare/compare.h"
#include "app/support/seconds.h"
#include "benchmarks/analytic/registry/analytic_cases.h"

#include <algorithm>

namespace twinarm {
CompareRow run_one(const AnalyticCase& test, const std::vector<Lane>& lanes) {
  const double start = steady_seconds();
  CompareRow row{&test, run_case(test), 0, {}};
  row.seconds = steady_seconds() - start;
  if (test.trajectory && test.trajectory->takes_lanes())
    for (const Lane& lane : lanes)
      row.lanes.push_back(
          {lane, run_lane(*test.trajectory, lane), observed_order(*test.trajectory, lane)});
  return row;
}

std::size_t failures(const std::vector<CompareRow>& rows) {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const CompareRow& r) { return !passes(*r.test, r.result); }));
}

}  // namespace twinarm
