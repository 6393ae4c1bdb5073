#include "benchmarks/analytic/registry/case_statements.h"

#include "benchmarks/analytic/registry/analytic_cases.h"

namespace twinarm {

const char* statement_of(const AnalyticCase& c) {
  if (c.trajectory) return c.trajectory->statement;
  if (c.statement) return c.statement;
  const std::string_view name = c.name;
  const CaseStatement* found = nullptr;
  for (const auto* table : {&contact_statements(), &other_statements()})
    for (const CaseStatement& one : *table) {
      const bool means =
          name.starts_with(one.name) && (name.size() == one.name.size() ||
                                         one.name.ends_with('-') || name[one.name.size()] == '-');
      if (means && (!found || one.name.size() > found->name.size())) found = &one;
    }
  return found ? found->text : nullptr;
}

}  // namespace twinarm
