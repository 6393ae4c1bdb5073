#include "benchmarks/analytic/analytic_case.h"
#include "benchmarks/analytic/contact_cases.h"
#include "benchmarks/analytic/loop_runs.h"

namespace twinarm {

// A new family of cases is one more line here.
const std::vector<AnalyticCase>& analytic_cases() {
  static const std::vector<AnalyticCase> all = [] {
    using namespace contact_cases;
    std::vector<AnalyticCase> cases;
    for (const auto& family : {loop_runs(), impacts(), sliding(), toppling(), rolling(), painleve(),
                               spinning(), stacks(), hollows(), arches(), wedges(), rod_impacts()})
      cases.insert(cases.end(), family.begin(), family.end());
    return cases;
  }();
  return all;
}

}  // namespace twinarm
