#include "app/scene/read/change_scene.h"

#include <algorithm>
#include <array>

#include "app/scene/read/coupling_keys.h"
#include "app/support/nearest_name.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

struct StepOfPath {
  std::string name;
  long index = -1;  // -1: none is given; -2: what stands in the brackets is none
};

// "coupling[2]": the name, and which.
StepOfPath step_of_path(const std::string& part) {
  const std::size_t bracket = part.find('[');
  if (bracket == std::string::npos || part.back() != ']') return {part};
  const auto index = parse_number(part.substr(bracket + 1, part.size() - bracket - 2));
  const bool is_index = index && *index >= 0 && *index < 1e6;
  return {part.substr(0, bracket), is_index ? static_cast<long>(*index) : -2};
}

std::vector<StepOfPath> steps_of_path(const std::string& path) {
  std::vector<StepOfPath> steps;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    steps.push_back(step_of_path(path.substr(begin, end - begin)));
    begin = end + 1;
  }
  return steps;
}

TomlValue& made_member(TomlValue& table, const std::string& key, int line) {
  if (TomlValue* found = table.find(key)) return *found;
  TomlValue& made = table.members.emplace_back();
  made.key = key;
  made.line = line;
  return made;
}

void write_toml_value(TomlValue& value, const std::string& text, int line) {
  const auto number = parse_number(text);
  value.line = line;
  value.text = text;
  value.items.clear();
  value.members.clear();
  value.number = number.value_or(text == "true" ? 1 : 0);
  value.kind = number                              ? TomlValue::Kind::number
               : text == "true" || text == "false" ? TomlValue::Kind::boolean
                                                   : TomlValue::Kind::text;
  if (value.kind != TomlValue::Kind::text || text.find(',') == std::string::npos) return;
  std::vector<TomlValue> items;  // "0,0,-1.62"
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    TomlValue item;
    write_toml_value(item, text.substr(begin, end - begin), line);
    if (item.kind != TomlValue::Kind::number) return;
    items.push_back(std::move(item));
    begin = end + 1;
  }
  value.kind = TomlValue::Kind::list;
  value.items = std::move(items);
}

// Writes the value at each place that a path leads to.
class SceneChange {
 public:
  SceneChange(const Change& change, int line) : text_(change.value), line_(line) {
    steps_ = steps_of_path(change.path);
  }
  const std::string& top() const { return steps_.front().name; }
  std::size_t count() const { return steps_.size(); }
  // False where the path leads nowhere.
  bool apply(TomlValue& scene) { return into_member(scene, 0); }

 private:
  bool into_member(TomlValue& table, std::size_t s) {
    TomlValue* found = s == 0 ? table.find(steps_[s].name) : nullptr;
    if (s == 0 && !found) return false;
    TomlValue& member = found ? *found : made_member(table, steps_[s].name, line_);
    const long index = steps_[s].index;
    if (index == -1) {
      if (!into(member, s + 1)) return false;
    } else {
      const auto i = static_cast<std::size_t>(index);
      if (index < 0 || i >= member.items.size() || !into(member.items[i], s + 1)) return false;
    }
    if (s + 1 == steps_.size() && top() == "coupling" && steps_[s].name == "type")
      fit_keys_to_type(table, line_);
    return true;
  }
  // The value that the steps before s led to.
  bool into(TomlValue& value, std::size_t s) {
    if (s == steps_.size()) {
      write_toml_value(value, text_, line_);
      return true;
    }
    if (value.kind == TomlValue::Kind::table) return into_member(value, s);
    if (value.kind != TomlValue::Kind::list || value.items.empty()) return false;
    for (TomlValue& item : value.items) {
      const TomlValue* name = item.find("name");
      if (steps_[s].index == -1 && s + 1 < steps_.size() && name && name->text == steps_[s].name)
        return into(item, s + 1);
    }
    return std::all_of(value.items.begin(), value.items.end(), [&](TomlValue& item) {
      return item.kind == TomlValue::Kind::table && into_member(item, s);
    });
  }

  std::vector<StepOfPath> steps_;
  const std::string& text_;
  int line_;
};

// Keys of the top that a scene may leave out, and what they are then.
void add_left_out(const std::string& name, int line, TomlValue& scene) {
  static const std::array<std::pair<const char*, const char*>, 5> kDefaults{
      {{"gravity", "0,0,-9.81"},
       {"step", "0.001"},
       {"integrator", "semi-implicit"},
       {"contact", "rigid"},
       {"duration", "1"}}};
  for (const auto& [key, text] : kDefaults)
    if (name == key && !scene.find(name))
      write_toml_value(made_member(scene, name, line), text, line);
}

}  // namespace

Change parse_change(const std::string& text) {
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || equal == 0 || equal + 1 == text.size())
    throw InputError({{"", 0, "--set", "'" + text + "' is no change",
                       "write PATH=VALUE, as in coupling.stiffness=800", "change.form"}});
  return {text.substr(0, equal), text.substr(equal + 1)};
}

void apply(const Change& change, int line, TomlValue& scene, FaultList& faults) {
  const auto fault = [&](const std::string& rule, const std::string& remedy,
                         std::string_view code) {
    faults.add({"", 0, "--set " + change.path, rule, remedy, code});
  };
  constexpr std::size_t kLongestPath = 16;  // each step is a table within a table
  SceneChange wanted(change, line);
  if (wanted.count() > kLongestPath)
    return fault("the path has " + std::to_string(wanted.count()) + " steps",
                 "no number of a scene lies deeper than a few", "change.too-deep");
  const std::string& name = wanted.top();
  add_left_out(name, line, scene);
  std::vector<std::string> names;
  for (const TomlValue& member : scene.members) names.push_back(member.key);
  if (!scene.find(name))
    return fault("the scene has no '" + name + "'", name_remedy(name, names, "keys"),
                 "change.unknown-key");
  if (!wanted.apply(scene))
    fault("the scene has no such " + name,
          "write " + name + "[0].KEY, " + name + ".KEY for all, or " + name + ".NAME.KEY",
          "change.unknown-key");
}

}  // namespace twinarm
