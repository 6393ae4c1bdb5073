#include "app/scene/read/value_path.h"

#include <algorithm>

#include "app/robot/robot_input.h"
#include "app/support/nearest_name.h"

namespace twinarm {
namespace {

bool is_list_of_tables(const Value& value) {
  return value.is_list() && !value.items.empty() && value.items[0].is_table();
}

// Goes along a path through the tree.
class PathWalk {
 public:
  PathWalk(const ValuePath& path, MadeKeys made, int line, const std::string& where)
      : path_(path), made_(made), line_(line), where_(where) {}

  std::vector<PathTarget> found;

  void go(Value& table, std::size_t p = 0) {
    const ValuePath::Part& part = path_.parts[p];
    if (part.name.empty() || part.index == -2)
      fault("'" + path_.text + "' is no path",
            "write it as in coupling[0].stiffness, body.mass or step", "path.form");
    if (!table.is_table())
      fault(up_to(p) + " is " + describe(table) + ", and has no '" + part.name + "'",
            "name a number of the scene file", "path.unknown-key");
    const bool last = is_last(p);
    const bool may_make = part.index < 0 && (made_ == MadeKeys::last ? last : p > 0);
    Value* member = table.find(part.name);
    if (!member && may_make) {
      member = &table.put(part.name, last ? Value::of(0.0) : Value());
      member->line = line_;
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

 private:
  [[noreturn]] void fault(const std::string& rule, const std::string& remedy,
                          std::string_view code) const {
    throw InputError({{"", 0, where_, rule, remedy, code}});
  }
  bool is_last(std::size_t p) const { return p + 1 == path_.parts.size(); }
  std::string up_to(std::size_t p) const {  // the path before part p, as "the scene" or "body[0]"
    if (p == 0) return "the scene";
    std::string text;
    for (std::size_t i = 0; i < p; ++i) {
      const ValuePath::Part& part = path_.parts[i];
      text += (i ? "." : "") + part.name +
              (part.index >= 0 ? "[" + std::to_string(part.index) + "]" : "");
    }
    return "'" + text + "'";
  }

  void go_to_item(Value& list, std::size_t p) {
    const ValuePath::Part& part = path_.parts[p];
    const auto i = static_cast<std::size_t>(part.index);
    if (!list.is_list())
      fault("'" + part.name + "' is " + describe(list) + ", and has no items",
            "leave the brackets out", "path.no-list");
    if (i >= list.items.size())
      fault("'" + part.name + "' has " + std::to_string(list.items.size()) +
                " items, counted from 0, and no item " + std::to_string(i),
            "give an index below " + std::to_string(list.items.size()), "path.no-item");
    if (is_last(p))
      found.push_back({&list.items[i], &list});
    else
      go(list.items[i], p + 1);
  }

  // One of them where its name comes next, else all.
  void go_to_items(Value& list, std::size_t p) {
    const ValuePath::Part& next = path_.parts[p + 1];
    for (Value& item : list.items) {
      const Value* name = item.find("name");
      if (!name || name->text != next.name || next.index != -1) continue;
      if (!is_last(p + 1)) return go(item, p + 2);
      if (made_ == MadeKeys::last)
        fault("'" + path_.text + "' is a table", "name one of its numbers", "path.no-number");
    }
    for (Value& item : list.items) go(item, p + 1);
  }

  const ValuePath& path_;
  const MadeKeys made_;
  const int line_;
  const std::string& where_;
};

}  // namespace

ValuePath::ValuePath(const std::string& path) : text(path) {
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    Part part{path.substr(begin, end - begin)};
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
}

std::vector<PathTarget> find_targets(Value& scene, const ValuePath& path, MadeKeys made, int line,
                                     const std::string& where) {
  PathWalk walk(path, made, line, where);
  walk.go(scene);
  return std::move(walk.found);
}

void set_number(Value& scene, const std::string& text, double value, int line,
                const std::string& where, FaultList& faults) {
  const ValuePath path(text);
  const auto found =
      attempt(faults, [&] { return find_targets(scene, path, MadeKeys::last, line, where); });
  if (!found) return;
  for (const PathTarget& target : *found)
    if (!target.value->is_number())
      return faults.add(
          {"", 0, where, "'" + text + "' is " + describe(*target.value) + ", and no number",
           target.value->is_list() ? "name one of them: " + path.parts.back().name + "[0]"
                                   : "name a number of the scene file",
           "path.no-number"});
  for (const PathTarget& target : *found) {
    target.value->number = value;
    target.value->line = line;
  }
}

}  // namespace twinarm
