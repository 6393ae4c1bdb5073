#include "app/scene/read/change_scene.h"

#include <algorithm>
#include <array>

#include "app/robot/robot_input.h"
#include "app/scene/read/scene_description.h"
#include "app/scene/read/scene_keys.h"
#include "app/scene/read/value_path.h"
#include "app/support/nearest_name.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// A number, true or false, numbers with commas between them, or a text.
Value value_of_text(const std::string& text) {
  if (const auto number = parse_number(text)) return Value::of(*number);
  Value value = Value::of(text);
  if (text == "true" || text == "false") {
    value.kind = Value::Kind::boolean;
    value.number = text == "true" ? 1 : 0;
  } else if (text.find(',') != std::string::npos) {
    std::vector<Value> items;  // "0,0,-1.62"
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      const auto number = parse_number(text.substr(begin, end - begin));
      if (!number) return value;
      items.push_back(Value::of(*number));
      begin = end + 1;
    }
    return Value::list(std::move(items));
  }
  return value;
}

// A key of the top that a scene may leave out, for a path to lead to.
void add_left_out(const std::string& name, int line, Value& scene) {
  static const std::array kLeftOut{"gravity", "step", "integrator", "contact", "duration"};
  if (scene.find(name) || std::find(kLeftOut.begin(), kLeftOut.end(), name) == kLeftOut.end())
    return;
  Value made = Value::of(0.0);  // its text or number comes in its place
  if (name == "gravity") {
    made = Value::list({});
    for (const double g : SceneDescription().gravity) made.items.push_back(Value::of(g));
  }
  made.line = line;
  scene.put(name, std::move(made));
}

}  // namespace

Change parse_change(const std::string& text) {
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || equal == 0 || equal + 1 == text.size())
    throw InputError({{"", 0, "--set", "'" + text + "' is no change",
                       "write PATH=VALUE, as in coupling.stiffness=800", "change.form"}});
  return {text.substr(0, equal), text.substr(equal + 1)};
}

void apply(const Change& change, int line, Value& scene, FaultList& faults) {
  const std::string where = "--set " + change.path;
  const auto fault = [&](const std::string& rule, const std::string& remedy,
                         std::string_view code) {
    faults.add({"", 0, where, rule, remedy, code});
  };
  constexpr std::size_t kLongestPath = 16;  // each step is a table within a table
  const ValuePath path(change.path);
  if (path.parts.size() > kLongestPath)
    return fault("the path has " + std::to_string(path.parts.size()) + " steps",
                 "no number of a scene lies deeper than a few", "change.too-deep");
  const std::string& name = path.parts.front().name;
  add_left_out(name, line, scene);
  std::vector<std::string> names;
  for (const Value& member : scene.members) names.push_back(member.key);
  if (!scene.find(name))
    return fault("the scene has no '" + name + "'", name_remedy(name, names, "keys"),
                 "change.unknown-key");
  FaultList of_path;
  const auto found = attempt(
      of_path, [&] { return find_targets(scene, path, MadeKeys::all_below_top, line, where); });
  if (!found)
    return fault("the scene has no such " + name,
                 "write " + name + "[0].KEY, " + name + ".KEY for all, or " + name + ".NAME.KEY",
                 "change.unknown-key");
  for (const auto& [value, table] : *found) {
    const std::string key = value->key;
    *value = value_of_text(change.value);
    value->key = key;
    value->line = line;
    if (name == "coupling" && key == "type") fit_keys_to_type(*table, line);
  }
}

}  // namespace twinarm
