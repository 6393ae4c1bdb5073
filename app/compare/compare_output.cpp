#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/compare/compare.h"
#include "app/text_table.h"

namespace twinarm {
namespace {

// Errors are compared with tolerances by eye: three digits.
std::string short_number(double value) {
  return fmt::format("{:.3g}", value);
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

std::string compare_table(const std::vector<CompareRow>& rows) {
  TextTable table({"case", "error", "tolerance", "", "seconds"});
  std::string short_of;
  for (const auto& [test, result, seconds] : rows) {
    const bool pass = passes(*test, result);
    table.add({test->name, short_number(result.error), short_number(test->tolerance),
               pass ? "pass" : "FAIL", fmt::format("{:.2f}", seconds)});
    if (!pass)
      short_of += fmt::format("{}: error {} above {}; {}\n", test->name, short_number(result.error),
                              short_number(test->tolerance), test->reference);
  }
  const std::size_t failed = failures(rows);
  std::string text = table.str() + "\n";
  if (!short_of.empty()) text += short_of + "\n";
  return text + fmt::format("{} passed, {} failed\n", rows.size() - failed, failed);
}

// What is not finite becomes null.
std::string compare_json(const std::vector<CompareRow>& rows) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const auto& [test, result, seconds] : rows)
    cases.push_back({{"name", test->name},
                     {"group", test->group},
                     {"error", result.error},
                     {"tolerance", test->tolerance},
                     {"pass", passes(*test, result)},
                     {"order", number_or_null(result.order)},
                     {"energy_drift", number_or_null(result.energy_drift)},
                     {"reference", test->reference},
                     {"seconds", seconds}});
  const std::size_t failed = failures(rows);
  const nlohmann::ordered_json answer = {{"cases", cases},
                                         {"passed", rows.size() - failed},
                                         {"failed", failed},
                                         {"skipped", nlohmann::ordered_json::array()}};
  return answer.dump(1) + "\n";
}

}  // namespace twinarm
