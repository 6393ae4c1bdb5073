#include "app/scene/read/parameter_path.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "app/support/nearest_name.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

struct PathPart {
  std::string name;
  long index = -1;  // -1: none is given; -2: what stands in the brackets is no index
};

std::vector<PathPart> parts_of_path(const std::string& path) {
  std::vector<PathPart> parts;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    PathPart part{path.substr(begin, end - begin)};
    const std::size_t bracket = part.name.find('[');
    if (bracket != std::string::npos) {
      const std::string inside = part.name.substr(bracket + 1);
      const bool digits = inside.size() > 1 && inside.size() < 8 && inside.back() == ']' &&
                          inside.find_first_not_of("0123456789") == inside.size() - 1;
      part.index = digits ? std::stol(inside) : -2;
      part.name.resize(bracket);
    }
    parts.push_back(std::move(part));
    begin = end + 1;
  }
  return parts;
}

TomlValue* find_member(TomlValue& table, const std::string& key) {
  for (TomlValue& member : table.members)
    if (member.key == key) return &member;
  return nullptr;
}

bool is_list_of_tables(const TomlValue& value) {
  return value.kind == TomlValue::Kind::list && !value.items.empty() &&
         value.items[0].kind == TomlValue::Kind::table;
}

// Goes along a path through the tree; all numbers that are meant are in `found`.
class PathWalk {
 public:
  PathWalk(const std::string& path, const std::string& where, FaultList& faults)
      : path_(path), where_(where), faults_(faults), parts_(parts_of_path(path)) {}

  std::vector<TomlValue*> found;
  std::vector<TomlValue*> tables;  // that the last key stands in

  bool walk(TomlValue& scene) { return go(scene, 0); }

 private:
  bool fault(const std::string& rule, const std::string& remedy, std::string_view code) {
    faults_.add({"", 0, where_, rule, remedy, code});
    return false;
  }
  std::string up_to(std::size_t p) const {  // the path before part p, as "the scene" or "body[0]"
    if (p == 0) return "the scene";
    std::string text;
    for (std::size_t i = 0; i < p; ++i)
      text += (i ? "." : "") + parts_[i].name +
              (parts_[i].index >= 0 ? "[" + std::to_string(parts_[i].index) + "]" : "");
    return "'" + text + "'";
  }

  bool go(TomlValue& table, std::size_t p) {
    const PathPart& part = parts_[p];
    const bool last = p + 1 == parts_.size();
    if (part.name.empty() || part.index == -2)
      return fault("'" + path_ + "' is no path",
                   "write it as in coupling[0].stiffness, body.mass or step", "path.form");
    if (table.kind != TomlValue::Kind::table)
      return fault(up_to(p) + " is " + describe(table) + ", and has no '" + part.name + "'",
                   "name a number of the scene file", "path.unknown-key");
    TomlValue* member = find_member(table, part.name);
    if (!member && last && part.index < 0) {
      table.members.emplace_back();
      member = &table.members.back();
      member->key = part.name;
      member->kind = TomlValue::Kind::number;
    }
    if (!member) {
      std::vector<std::string> names;
      for (const TomlValue& m : table.members) names.push_back(m.key);
      return fault(up_to(p) + " has no '" + part.name + "'", name_remedy(part.name, names, "keys"),
                   "path.unknown-key");
    }
    if (part.index >= 0) return go_to_item(*member, p, last);
    if (last) return take(*member, p, table);
    if (is_list_of_tables(*member)) return go_to_items(*member, p);
    return go(*member, p + 1);
  }

  bool go_to_item(TomlValue& list, std::size_t p, bool last) {
    const auto i = static_cast<std::size_t>(parts_[p].index);
    if (list.kind != TomlValue::Kind::list)
      return fault("'" + parts_[p].name + "' is " + describe(list) + ", and has no items",
                   "leave the brackets out", "path.no-list");
    if (i >= list.items.size())
      return fault("'" + parts_[p].name + "' has " + std::to_string(list.items.size()) +
                       " items, counted from 0, and no item " + std::to_string(i),
                   "give an index below " + std::to_string(list.items.size()), "path.no-item");
    return last ? take(list.items[i], p, list) : go(list.items[i], p + 1);
  }

  // One of them where its name comes next, else all.
  bool go_to_items(TomlValue& list, std::size_t p) {
    for (TomlValue& item : list.items) {
      const TomlValue* name = item.find("name");
      if (!name || name->text != parts_[p + 1].name) continue;
      if (p + 2 < parts_.size()) return go(item, p + 2);
      return fault("'" + path_ + "' is a table", "name one of its numbers", "path.no-number");
    }
    return std::all_of(list.items.begin(), list.items.end(),
                       [&](TomlValue& item) { return go(item, p + 1); });
  }

  bool take(TomlValue& value, std::size_t p, TomlValue& inside) {
    if (value.kind != TomlValue::Kind::number) {
      const bool is_list = value.kind == TomlValue::Kind::list;
      return fault("'" + path_ + "' is " + describe(value) + ", and no number",
                   is_list ? "name one of them: " + parts_[p].name + "[0]"
                           : "name a number of the scene file",
                   "path.no-number");
    }
    found.push_back(&value);
    tables.push_back(&inside);
    return true;
  }

  const std::string& path_;
  const std::string& where_;
  FaultList& faults_;
  std::vector<PathPart> parts_;
};

bool is_text(const TomlValue& table, const char* key, const char* text) {
  const TomlValue* value = table.find(key);
  return value && value->text == text;
}

}  // namespace

void set_number(TomlValue& scene, const std::string& path, double value, int line,
                const std::string& where, FaultList& faults) {
  PathWalk walk(path, where, faults);
  if (!walk.walk(scene)) return;
  for (TomlValue* number : walk.found) {
    number->number = value;
    number->line = line;
  }
}

std::string unit_of_number(const TomlValue& scene, const std::string& path) {
  TomlValue copy = scene;
  FaultList faults;
  PathWalk walk(path, path, faults);
  if (!walk.walk(copy) || walk.tables.empty()) return "";
  const std::vector<PathPart> parts = parts_of_path(path);
  const std::string& key = parts.back().name;
  const bool of_coupling = parts.size() > 1 && parts.front().name == "coupling";
  if (of_coupling && (key == "stiffness" || key == "damping")) {
    const bool turns = is_text(*walk.tables[0], "type", "torsional");
    for (const TomlValue* table : walk.tables)
      if (is_text(*table, "type", "torsional") != turns) return "";
    return key == "stiffness" ? (turns ? "N m/rad" : "N/m") : (turns ? "N m s/rad" : "N s/m");
  }
  static constexpr std::array<std::pair<const char*, const char*>, 26> kUnits{
      {{"step", "s"},
       {"duration", "s"},
       {"delay", "s"},
       {"gravity", "m/s²"},
       {"rate", "Hz"},
       {"mass", "kg"},
       {"density", "kg/m³"},
       {"position", "m"},
       {"point", "m"},
       {"point_b", "m"},
       {"com", "m"},
       {"size", "m"},
       {"radius", "m"},
       {"length", "m"},
       {"offset", "m"},
       {"semi_axes", "m"},
       {"stiffness", "N/m"},
       {"dissipation", "s/m"},
       {"inertia", "kg m²"},
       {"linear_velocity", "m/s"},
       {"linear", "m/s"},
       {"angular_velocity", "rad/s"},
       {"angular", "rad/s"},
       {"rolling_friction", "m"},
       {"torsional_friction", "m"},
       {"damping", "N s/m"}}};
  for (const auto& [name, unit] : kUnits)
    if (key == name) return unit;
  return "";
}

}  // namespace twinarm
