#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/compare/compare.h"
#include "app/data/text_table.h"

namespace twinarm {
namespace {

using Json = nlohmann::ordered_json;

// Errors are compared with tolerances by eye: three digits.
std::string short_number(double value) {
  return fmt::format("{:.3g}", value);
}
std::string short_number(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// Only where lanes were asked for.
Json lanes_of(const CompareRow& row) {
  Json lanes = Json::array();
  for (const LaneRow& r : row.lanes) {
    const bool adaptive = r.lane.integrator == Integrator::dopri5;
    lanes.push_back({{"integrator", integrator_name(r.lane.integrator)},
                     {"step", adaptive ? Json(nullptr) : Json(r.lane.step)},
                     {"tolerance", adaptive ? Json(r.lane.tolerance) : Json(nullptr)},
                     {"error", r.result.error},
                     {"order", number_or_null(r.order)},
                     {"energy_drift", number_or_null(r.result.energy_drift)},
                     {"seconds", r.result.seconds}});
  }
  return lanes;
}

}  // namespace

std::string compare_table(const std::vector<CompareRow>& rows, const std::vector<Lane>& lanes,
                          const std::vector<const SkippedCase*>& skipped) {
  std::vector<std::string> headings{"case", "error", "tolerance", "", "order", "energy", "seconds"};
  for (const Lane& lane : lanes) headings.push_back(lane_name(lane));
  TextTable table(headings);
  std::string short_of;
  for (const CompareRow& row : rows) {
    const auto& [test, result, seconds, of_lanes] = row;
    const bool pass = passes(*test, result);
    std::vector<std::string> cells{test->name,
                                   short_number(result.error),
                                   short_number(test->tolerance),
                                   pass ? "pass" : "FAIL",
                                   short_number(result.order, "{:.2f}"),
                                   short_number(result.energy_drift, "{:.1e}"),
                                   fmt::format("{:.2f}", seconds)};
    for (std::size_t i = 0; i < lanes.size(); ++i)
      cells.push_back(of_lanes.empty() ? "-" : short_number(of_lanes[i].result.error));
    table.add(cells);
    if (!pass)
      short_of += fmt::format("{}: error {} above {}; {}\n", test->name, short_number(result.error),
                              short_number(test->tolerance), test->reference);
  }
  const std::size_t failed = failures(rows);
  std::string text = rows.empty() ? "" : table.str() + "\n";
  if (!short_of.empty()) text += short_of + "\n";
  for (const SkippedCase* c : skipped) text += fmt::format("skipped {}: {}\n", c->name, c->why);
  if (!skipped.empty()) text += "\n";
  text += fmt::format("{} passed, {} failed", rows.size() - failed, failed);
  if (!skipped.empty()) text += fmt::format(", {} skipped", skipped.size());
  return text + "\n";
}

// What is not finite becomes null.
std::string compare_json(const std::vector<CompareRow>& rows, const std::vector<Lane>& lanes,
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
    if (!lanes.empty()) cases.back()["lanes"] = lanes_of(row);
  }
  Json left_out = Json::array();
  for (const SkippedCase* c : skipped) left_out.push_back({{"name", c->name}, {"why", c->why}});
  const std::size_t failed = failures(rows);
  Json answer = {{"cases", cases},
                 {"passed", rows.size() - failed},
                 {"failed", failed},
                 {"skipped", left_out}};
  if (!page.empty()) answer["page"] = page;
  return answer.dump(1) + "\n";
}

}  // namespace twinarm
