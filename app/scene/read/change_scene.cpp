#include "app/scene/read/change_scene.h"

#include "app/scene/read/scene_keys.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

bool is_list_of_tables(const Value& value) {
  return value.is_list() && !value.items.empty() && value.items[0].is_table();
}

// Follows a path through the tree.
struct PathWalk {
  const ValuePath& path;
  const MadeKeys made;
  const int line;
  const std::string& where;
  std::vector<PathTarget> found{};

  void go(Value& table, std::size_t p = 0) {
    const ValuePath::Part& part = path.parts[p];
    if (part.name.empty() || part.index == -2)
      fault("'" + path.text + "' is not a path",
            "write it as in coupling[0].stiffness, body.mass or step", "path.form");
    if (!table.is_table())
      fault(up_to(p) + " is " + describe(table) + ": it has no '" + part.name + "'",
            "name a number of the scene file", "path.unknown-key");
    const bool last = is_last(p);
    const bool may_make = part.index < 0 && (made == MadeKeys::last ? last : p > 0);
    Value* member = table.find(part.name);
    if (!member && may_make) {
      member = &table.put(part.name, last ? Value::of(0.0) : Value());
      member->line = line;
    }
    if (!member) {
      std::vector<std::string> names;
      for (const Value& m : table.members) names.push_back(m.key);
      fault(up_to(p) + " has no '" + part.name + "'", name_remedy(part.name, names, "keys"),
            "path.unknown-key");
    }
    if (part.index >= 0)
      go_to_item(*member, p);
    else if (last)
      found.push_back({member, &table});
    else if (is_list_of_tables(*member))
      go_to_items(*member, p);
    else
      go(*member, p + 1);
  }

  [[noreturn]] void fault(const std::string& problem, const std::string& fix,
                          std::string_view code) const {
    throw InputError(where, problem, fix, code);
  }
  bool is_last(std::size_t p) const { return p + 1 == path.parts.size(); }
  std::string up_to(std::size_t p) const {  // the path before part p: "the scene", "'body[0]'"
    if (p == 0) return "the scene";
    std::string text;
    for (std::size_t i = 0; i < p; ++i) {
      const ValuePath::Part& part = path.parts[i];
      text += (i ? "." : "") + part.name +
              (part.index >= 0 ? "[" + std::to_string(part.index) + "]" : "");
    }
    return "'" + text + "'";
  }

  void go_to_item(Value& list, std::size_t p) {
    const ValuePath::Part& part = path.parts[p];
    const auto i = static_cast<std::size_t>(part.index);
    if (!list.is_list())
      fault("'" + part.name + "' is " + describe(list) + ": it has no items",
            "leave the brackets out", "path.no-list");
    if (i >= list.items.size())
      fault("'" + part.name + "' has " + std::to_string(list.items.size()) +
                " items: there is no item " + std::to_string(i),
            "give an index from 0, below " + std::to_string(list.items.size()), "path.no-item");
    if (is_last(p))
      found.push_back({&list.items[i], &list});
    else
      go(list.items[i], p + 1);
  }

  // The item whose name is the next part, else all items, if the next part can be a key.
  void go_to_items(Value& list, std::size_t p) {
    const ValuePath::Part& next = path.parts[p + 1];
    static const std::array kTables{"q",     "qd",      "torque", "damping",   "motion",
                                    "shape", "gripper", "target", "mass_scale"};
    bool is_key = is_last(p + 1) || next.index != -1 || next.name.empty() ||
                  std::ranges::find(kTables, next.name) != kTables.end();
    std::vector<std::string> names;
    for (Value& item : list.items) {
      const Value* name = item.find("name");
      is_key = is_key || item.find(next.name);
      if (name) names.push_back(name->text);
      if (!name || name->text != next.name || next.index != -1) continue;
      if (!is_last(p + 1)) return go(item, p + 2);
      if (made == MadeKeys::last)
        fault("'" + path.text + "' is a table", "name one of its numbers", "path.no-number");
    }
    if (!is_key)
      fault("there is no " + path.parts[p].name + " '" + next.name + "'",
            name_remedy(next.name, names, "names"), "path.unknown-name");
    for (Value& item : list.items) go(item, p + 1);
  }
};

// A number, true or false, numbers separated by commas, or a text.
Value value_of_text(const std::string& text) {
  if (const auto number = parse_number(text)) return Value::of(*number);
  if (text == "true" || text == "false") return Value::flag(text == "true");
  if (text.find(',') == std::string::npos) return Value::of(text);
  std::vector<double> numbers;  // "0,0,-1.62"
  for (const std::string& item : split(text)) {
    const auto number = parse_number(item);
    if (!number) return Value::of(text);
    numbers.push_back(*number);
  }
  return Value::numbers(numbers);
}

constexpr std::array kOptional{"gravity",  "step",     "integrator", "contact", "detection",
                               "duration", "accuracy", "budget",     "sleep"};

// Adds an optional top-level key, so that a path can denote it.
void add_optional_key(const std::string& name, int line, Value& scene) {
  if (scene.find(name) || std::ranges::find(kOptional, name) == kOptional.end()) return;
  // To be replaced by the new value.
  scene.put(name, name == "gravity" ? Value::numbers(SceneDescription().gravity) : Value::of(0.0))
      .line = line;
}

}  // namespace

ValuePath::ValuePath(const std::string& path) : text(path) {
  for (const std::string& name : split(path, '.')) {
    Part part{name};
    const std::size_t bracket = part.name.find('[');
    if (bracket != std::string::npos) {
      const std::string inside = part.name.substr(bracket + 1);
      const bool digits = inside.size() > 1 && inside.size() < 8 && inside.back() == ']' &&
                          inside.find_first_not_of("0123456789") == inside.size() - 1;
      part.index = digits ? std::stol(inside) : -2;
      part.name.resize(bracket);
    }
    parts.push_back(std::move(part));
  }
}

std::vector<PathTarget> find_targets(Value& scene, const ValuePath& path, MadeKeys made, int line,
                                     const std::string& where) {
  PathWalk walk{path, made, line, where};
  walk.go(scene);
  return std::move(walk.found);
}

void set_number(Value& scene, const std::string& text, double value, int line,
                const std::string& where, DiagnosticList& faults) {
  const ValuePath path(text);
  const auto found =
      attempt(faults, [&] { return find_targets(scene, path, MadeKeys::last, line, where); });
  if (!found) return;
  for (const PathTarget& target : *found)
    if (!target.value->is_number())
      return faults.add(where, "'" + text + "' is " + describe(*target.value) + ", not a number",
                        target.value->is_list()
                            ? "name one of them: " + path.parts.back().name + "[0]"
                            : "name a number of the scene file",
                        "path.no-number");
  for (const PathTarget& target : *found) {
    target.value->number = value;
    target.value->line = line;
  }
}

Change parse_change(const std::string& text) {
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || equal == 0 || equal + 1 == text.size())
    throw InputError("--set", "'" + text + "' is not a change",
                     "write PATH=VALUE, as in coupling.stiffness=800", "change.form");
  return {text.substr(0, equal), text.substr(equal + 1)};
}

void apply(const Change& change, int line, Value& scene, DiagnosticList& faults) {
  const std::string where = "--set " + change.path;
  const auto fault = [&](const std::string& problem, const std::string& fix,
                         std::string_view code) { faults.add(where, problem, fix, code); };
  constexpr std::size_t kMaxDepth = 16;
  const ValuePath path(change.path);
  if (path.parts.size() > kMaxDepth)
    return fault("the path has " + std::to_string(path.parts.size()) + " parts",
                 "give at most " + std::to_string(kMaxDepth), "change.too-deep");
  const std::string& name = path.parts.front().name;
  add_optional_key(name, line, scene);
  std::vector<std::string> names;
  for (const Value& member : scene.members) names.push_back(member.key);
  for (const char* key : kOptional)
    if (!scene.find(key)) names.emplace_back(key);
  if (!scene.find(name))
    return fault("the scene has no '" + name + "'", name_remedy(name, names, "keys"),
                 "change.unknown-key");
  const auto found = attempt(
      faults, [&] { return find_targets(scene, path, MadeKeys::all_below_top, line, where); });
  if (!found) return;
  for (const auto& [value, table] : *found) {
    const std::string key = value->key;
    *value = value_of_text(change.value);
    value->key = key;
    value->line = line;
    if (name == "coupling" && key == "type") fit_keys_to_type(*table, line);
  }
}

}  // namespace twinarm
