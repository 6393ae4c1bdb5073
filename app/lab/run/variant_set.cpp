#include "app/lab/run/variant_set.h"

#include <algorithm>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  for (const char c : text) {
    if (c == '[') ++depth;
    if (c == ']') --depth;
    if (c == ',' && depth == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  return values;
}

}  // namespace

LaneSet parse_lanes(const std::string& text) {
  const std::size_t equals = text.find('=');
  LaneSet lanes;
  lanes.path = text.substr(0, equals);
  if (equals != std::string::npos) lanes.values = split_values(text.substr(equals + 1));
  if (const auto fault = fault_of(lanes))
    throw InputError({{"", 0, "--lanes " + text, fault->rule, fault->remedy}});
  return lanes;
}

std::optional<LaneFault> fault_of(const LaneSet& lanes) {
  const std::vector<std::string>& values = lanes.values;
  const auto is_empty = [](const std::string& value) { return value.empty(); };
  if (lanes.path.empty() || values.empty() || std::ranges::any_of(values, is_empty))
    return LaneFault{"a path or a value is missing", "write integrator=semi-implicit,rk4"};
  if (values.size() < 2 || values.size() > LaneSet::kMost)
    return LaneFault{std::to_string(values.size()) + " values make no lanes", "give 2 to 7 values"};
  for (auto value = values.begin(); value != values.end(); ++value)
    if (std::find(values.begin(), value, *value) != value)
      return LaneFault{"'" + *value + "' stands there twice", "give each value once"};
  return std::nullopt;
}

void put(std::vector<Change>& changes, const Change& change) {
  std::erase_if(changes, [&](const Change& other) { return other.path == change.path; });
  changes.push_back(change);
}

}  // namespace twinarm
