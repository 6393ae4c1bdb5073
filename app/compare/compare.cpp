#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "app/compare/compare.h"
#include "app/compare/published/published_cases.h"
#include "app/data/json_writer.h"
#include "app/data/tables.h"
#include "app/support/progress.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

bool selects(const std::string& word, const std::string& name, const std::string& group) {
  if (name == word || group == word || name.starts_with(word + "-")) return true;
  return word.size() == 1 && name.size() > 1 && word[0] == name[0] &&
         std::isdigit(static_cast<unsigned char>(name[1])) != 0;
}

template <class F>
void for_each_case(F&& f) {
  for (const AnalyticCase& c : analytic_cases()) f(c);
  for (const AnalyticCase& c : published_cases()) f(c);
}

template <class F>
void for_each_name(F&& f) {
  for_each_case([&](const AnalyticCase& c) { f(c.name, c.group); });
  for (const SkippedCase& c : skipped_cases()) f(c.name, c.group);
}

using Json = nlohmann::ordered_json;

std::string error_cell(const std::optional<double>& value, const char* format = "{:.3g}") {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json integrations_of(const CompareRow& row) {
  Json integrations = Json::array();
  for (const IntegrationRow& r : row.integrations) {
    const bool adaptive = r.integration.integrator == Integrator::dopri5;
    integrations.push_back({{"integrator", integrator_name(r.integration.integrator)},
                            {"step", adaptive ? Json(nullptr) : Json(r.integration.step)},
                            {"tolerance", adaptive ? Json(r.integration.tolerance) : Json(nullptr)},
                            {"error", r.result.error},
                            {"order", number_or_null(r.order)},
                            {"energy_drift", number_or_null(r.result.energy_drift)},
                            {"seconds", r.result.seconds}});
  }
  return integrations;
}

Json numbers_of(const CaseResult& result) {
  Json numbers = Json::array();
  for (const ComparedNumber& number : result.numbers)
    numbers.push_back({{"quantity", number.quantity},
                       {"unit", number.unit},
                       {"published", number.published},
                       {"answer", number.answer},
                       {"error", number.error}});
  return numbers;
}

}  // namespace

CaseSelection select_cases(const std::vector<std::string>& names, const std::string& group,
                           DiagnosticList& faults) {
  std::vector<std::string> both, groups;
  for_each_name([&](const std::string& name, const std::string& of) {
    both.push_back(name);
    if (std::ranges::find(groups, of) == groups.end()) groups.push_back(of);
  });
  both.insert(both.end(), groups.begin(), groups.end());

  for (const std::string& name : names) {
    bool found = false;
    for_each_name(
        [&](const std::string& one, const std::string& of) { found |= selects(name, one, of); });
    if (!found)
      faults.add("command line", fmt::format("unknown case or group '{}'", name),
                 name_remedy(name, both, "cases and groups"), "compare.unknown");
  }
  if (!group.empty() && std::ranges::find(groups, group) == groups.end())
    faults.add("--group", fmt::format("unknown group '{}'", group),
               name_remedy(group, groups, "groups"), "option.choice");

  const auto chosen = [&](const std::string& name, const std::string& of) {
    return (names.empty() && group.empty()) || group == of ||
           std::ranges::any_of(names, [&](const auto& word) { return selects(word, name, of); });
  };
  CaseSelection selection;
  for_each_case([&](const AnalyticCase& c) {
    if (chosen(c.name, c.group)) selection.cases.push_back(&c);
  });
  for (const SkippedCase& c : skipped_cases())
    if (chosen(c.name, c.group)) selection.skipped.push_back(&c);
  return selection;
}

std::vector<Integration> read_integrations(const std::vector<std::string>& integrators,
                                           const std::vector<double>& steps,
                                           DiagnosticList& faults) {
  const std::vector<std::string> known = names_of(all_integrators);
  std::vector<Integrator> found;
  for (const std::string& name : integrators) {
    if (const auto integrator = find_integrator(name))
      found.push_back(*integrator);
    else
      faults.add("--integrator", fmt::format("unknown integrator '{}'", name),
                 name_remedy(name, known, "integrators"), "option.choice");
  }
  for (const double step : steps)
    if (!(step > 0) || !std::isfinite(step))
      faults.add("--step", fmt::format("step is {} s, must be positive and finite", step),
                 "for example --step 0.001,0.0005", "option.not-positive");

  std::vector<Integration> integrations;
  if (integrators.empty() && steps.empty()) return integrations;
  if (found.empty()) found.push_back(Integrator::rk4);
  for (const Integrator integrator : found)
    if (integrator == Integrator::dopri5)
      integrations.push_back(dopri5_with());
    else
      for (const double step : steps.empty() ? std::vector{1e-3} : steps)
        integrations.push_back({integrator, step});
  return integrations;
}

std::string integration_name(const Integration& integration) {
  const bool adaptive = integration.integrator == Integrator::dopri5;
  return fmt::format("{} {:g}", integrator_name(integration.integrator),
                     adaptive ? integration.tolerance : integration.step);
}

CompareRow run_one(const AnalyticCase& test, const std::vector<Integration>& integrations) {
  const double start = steady_seconds();
  CompareRow row{&test, run_case(test), 0, {}};
  row.seconds = steady_seconds() - start;
  if (test.trajectory && test.trajectory->takes_any_integrator())
    for (const Integration& integration : integrations)
      row.integrations.push_back({integration, run_trajectory(*test.trajectory, integration),
                                  observed_order(*test.trajectory, integration)});
  return row;
}

std::size_t failures(const std::vector<CompareRow>& rows) {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [](const CompareRow& r) { return !passes(*r.test, r.result); }));
}

std::string totals(const std::vector<CompareRow>& rows, std::size_t skipped) {
  const std::size_t failed = failures(rows);
  return fmt::format("{} passed, {} failed", rows.size() - failed, failed) +
         (skipped > 0 ? fmt::format(", {} skipped", skipped) : "");
}

std::string compare_table(const std::vector<CompareRow>& rows,
                          const std::vector<Integration>& integrations,
                          const std::vector<const SkippedCase*>& skipped) {
  std::vector<std::string> headings{"case", "error", "tolerance", "", "order", "energy", "seconds"};
  for (const Integration& integration : integrations)
    headings.push_back(integration_name(integration));
  TextTable table(headings);
  std::string failed_cases;
  for (const CompareRow& row : rows) {
    const auto& [test, result, seconds, with_others] = row;
    const bool pass = passes(*test, result);
    std::vector<std::string> cells{test->name,
                                   error_cell(result.error),
                                   error_cell(test->tolerance),
                                   pass ? "pass" : "FAIL",
                                   error_cell(result.order, "{:.2f}"),
                                   error_cell(result.energy_drift, "{:.1e}"),
                                   fmt::format("{:.2f}", seconds)};
    for (std::size_t i = 0; i < integrations.size(); ++i)
      cells.push_back(with_others.empty() ? "-" : error_cell(with_others[i].result.error));
    table.add(cells);
    if (!pass)
      failed_cases +=
          fmt::format("{}: error {} exceeds {}; {}\n", test->name, error_cell(result.error),
                      error_cell(test->tolerance), test->reference);
  }
  std::string text = rows.empty() ? "" : table.str() + "\n";
  if (!failed_cases.empty()) text += failed_cases + "\n";
  for (const SkippedCase* c : skipped) text += fmt::format("skipped {}: {}\n", c->name, c->why);
  if (!skipped.empty()) text += "\n";
  return text + totals(rows, skipped.size()) + "\n";
}

// Numbers that are not finite become null.
std::string compare_json(const std::vector<CompareRow>& rows,
                         const std::vector<Integration>& integrations,
                         const std::vector<const SkippedCase*>& skipped, const std::string& page) {
  Json cases = Json::array();
  for (const CompareRow& row : rows) {
    cases.push_back({{"name", row.test->name},
                     {"group", row.test->group},
                     {"error", row.result.error},
                     {"tolerance", row.test->tolerance},
                     {"pass", passes(*row.test, row.result)},
                     {"order", number_or_null(row.result.order)},
                     {"energy_drift", number_or_null(row.result.energy_drift)},
                     {"reference", row.test->reference},
                     {"seconds", row.seconds}});
    if (!integrations.empty()) cases.back()["configurations"] = integrations_of(row);
    if (!row.result.numbers.empty()) cases.back()["numbers"] = numbers_of(row.result);
  }
  Json left_out = Json::array();
  for (const SkippedCase* c : skipped) left_out.push_back({{"name", c->name}, {"why", c->why}});
  const std::size_t failed = failures(rows);
  Json answer = {{"schema", kJsonSchema},
                 {"cases", cases},
                 {"passed", rows.size() - failed},
                 {"failed", failed},
                 {"skipped", left_out}};
  if (!page.empty()) answer["page"] = page;
  return answer.dump(1) + "\n";
}

}  // namespace twinarm
