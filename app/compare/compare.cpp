#include "app/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/nearest_name.h"
#include "solver/fault.h"

namespace twinarm {
namespace {

bool means(const std::string& asked, const AnalyticCase& c) {
  const std::string name = c.name;
  return name == asked || name.rfind(asked + "-", 0) == 0;
}

}  // namespace

std::vector<const AnalyticCase*> select_cases(const std::vector<std::string>& names,
                                              const std::string& group) {
  const std::vector<AnalyticCase>& all = analytic_cases();
  std::vector<std::string> known, groups;
  for (const AnalyticCase& c : all) {
    known.push_back(c.name);
    if (std::find(groups.begin(), groups.end(), c.group) == groups.end()) groups.push_back(c.group);
  }
  FaultList faults;
  for (const std::string& name : names)
    if (std::none_of(all.begin(), all.end(), [&](const auto& c) { return means(name, c); }))
      faults.add({"", 0, "command line", fmt::format("there is no case '{}'", name),
                  name_remedy(name, known, "cases")});
  if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
    faults.add({"", 0, "--group", fmt::format("there is no group '{}'", group),
                name_remedy(group, groups, "groups")});
  faults.check();

  std::vector<const AnalyticCase*> chosen;
  for (const AnalyticCase& c : all) {
    const bool named = std::any_of(names.begin(), names.end(),
                                   [&](const std::string& name) { return means(name, c); });
    if (named || group == c.group || (names.empty() && group.empty())) chosen.push_back(&c);
  }
  return chosen;
}

std::vector<CompareRow> run_cases(const std::vector<const AnalyticCase*>& cases,
                                  const std::function<void(std::size_t)>& tick) {
  using Clock = std::chrono::steady_clock;
  std::vector<CompareRow> rows;
  for (const AnalyticCase* test : cases) {
    tick(rows.size());
    const Clock::time_point start = Clock::now();
    const CaseResult result = run_case(*test);
    rows.push_back({test, result, std::chrono::duration<double>(Clock::now() - start).count()});
  }
  tick(rows.size());
  return rows;
}

std::size_t failures(const std::vector<CompareRow>& rows) {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const CompareRow& r) { return !passes(*r.test, r.result); }));
}

}  // namespace twinarm
