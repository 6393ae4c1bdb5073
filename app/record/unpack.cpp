#include "app/record/unpack.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "app/nearest_name.h"
#include "collision/import/number_text.h"
#include "solver/whole_file.h"

namespace twinarm {
namespace {

TomlValue* member_of(TomlValue& table, const std::string& key) {
  for (TomlValue& member : table.members)
    if (member.key == key) return &member;
  return nullptr;
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    parts.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// No file has such a line: faults in what a change wrote are known by it.
int line_of_change(std::size_t change) {
  return -1 - static_cast<int>(change);
}

void write_toml_value(TomlValue& value, const std::string& text, int line) {
  const auto number = parse_number(text);
  value.line = line;
  value.text = text;
  value.number = number.value_or(text == "true" ? 1 : 0);
  value.kind = number                              ? TomlValue::Kind::number
               : text == "true" || text == "false" ? TomlValue::Kind::boolean
                                                   : TomlValue::Kind::text;
}

// "coupling[2]": the name, and which; -1: all.
std::pair<std::string, long> name_and_index(const std::string& part) {
  const std::size_t bracket = part.find('[');
  if (bracket == std::string::npos || part.back() != ']') return {part, -1};
  const auto index = parse_number(part.substr(bracket + 1, part.size() - bracket - 2));
  return {part.substr(0, bracket), index ? static_cast<long>(*index) : -2};
}

}  // namespace

Change parse_change(const std::string& text) {
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || equal == 0 || equal + 1 == text.size())
    throw InputError({{"", 0, "--set", "'" + text + "' is no change",
                       "write PATH=VALUE, as in coupling.stiffness=800"}});
  return {text.substr(0, equal), text.substr(equal + 1)};
}

void apply(const Change& change, int line, TomlValue& scene, FaultList& faults) {
  const auto fault = [&](const std::string& rule, const std::string& remedy) {
    faults.add({"", 0, "--set " + change.path, rule, remedy});
  };
  const std::vector<std::string> parts = parts_of(change.path);
  const auto [name, index] = name_and_index(parts.front());
  static const std::vector<std::string> kept{"step", "integrator", "duration", "contact"};
  if (std::find(kept.begin(), kept.end(), name) != kept.end())
    return fault("a fork keeps the grid and the method of its recording",
                 "run `twinarm simulate` with another " + name);
  TomlValue* list = member_of(scene, name);
  std::vector<std::string> names;
  for (const TomlValue& member : scene.members) names.push_back(member.key);
  if (!list) return fault("the scene has no '" + name + "'", name_remedy(name, names, "keys"));
  if (parts.size() == 1) return write_toml_value(*list, change.value, line);
  std::vector<TomlValue*> items;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const TomlValue* own_name = list->items[i].find("name");
    const bool named = parts.size() == 3 && own_name && own_name->text == parts[1];
    const bool all = parts.size() == 2 && index == -1;
    if (named || all || (parts.size() == 2 && index == static_cast<long>(i)))
      items.push_back(&list->items[i]);
  }
  if (items.empty())
    return fault("the scene has no such " + name,
                 "write " + name + "[0].KEY, " + name + ".KEY for all, or " + name + ".NAME.KEY");
  for (TomlValue* item : items) {
    TomlValue* value = member_of(*item, parts.back());
    if (!value) {
      item->members.emplace_back();
      value = &item->members.back();
      value->key = parts.back();
    }
    write_toml_value(*value, change.value, line);
  }
}

UnpackedRun::UnpackedRun(const RecordingHeader& header) : header_(header) {
  std::string name = (std::filesystem::temp_directory_path() / "twinarm-replay-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw InputError({{name, 0, "", "a temporary folder cannot be made", "set TMPDIR"}});
  folder_ = name;
  for (const RecordedFile& file : header.files) {
    const std::filesystem::path copy = copy_of(file.path);
    std::error_code ignored;
    std::filesystem::create_directories(copy.parent_path(), ignored);
    write_whole_file(copy, file.bytes);
  }
}

UnpackedRun::~UnpackedRun() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

// Below the folder as it lay below the root, so that files find one another as they did.
std::filesystem::path UnpackedRun::copy_of(const std::filesystem::path& original) const {
  return folder_ / original.lexically_normal().relative_path();
}

// A text of the scene that names one of the files: it may have lain below assets/.
void UnpackedRun::lead_to_copies(TomlValue& value) const {
  if (value.kind == TomlValue::Kind::text && !value.text.empty()) {
    const std::string name = std::filesystem::path(value.text).lexically_normal().string();
    for (const RecordedFile& file : header_.files)
      if (file.path == name || file.path.ends_with("/" + name))
        value.text = copy_of(file.path).string();
  }
  for (TomlValue& item : value.items) lead_to_copies(item);
  for (TomlValue& member : value.members) lead_to_copies(member);
}

SimulateOptions UnpackedRun::options(const std::vector<Change>& changes) const {
  SimulateOptions options = header_.options;
  options.robot.model = copy_of(options.robot.model);
  if (!options.robot.state.empty()) options.robot.state = copy_of(options.robot.state);
  const bool is_scene = options.robot.model.extension() == ".toml";
  std::vector<std::pair<Change, int>> of_scene;  // and their lines
  FaultList faults;
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (changes[i].path == "gravity")
      options.robot.gravity = changes[i].value;
    else if (is_scene)
      of_scene.emplace_back(changes[i], line_of_change(i));
    else
      faults.add({"", 0, "--set " + changes[i].path,
                  "a robot alone has gravity to be changed, no more",
                  "write --set gravity=x,y,z, or record a scene"});
  faults.check();
  options.change_scene = [this, of_scene](TomlValue& tree, FaultList& found) {
    lead_to_copies(tree);
    for (std::size_t i = 0; i < of_scene.size(); ++i)
      apply(of_scene[i].first, of_scene[i].second, tree, found);
  };
  return options;
}

InputError UnpackedRun::as_typed(const InputError& error,
                                 const std::vector<Change>& changes) const {
  const std::string folder = folder_.string();
  const auto by_original = [&](std::string& text) {
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;)
      text.erase(at, folder.size());
  };
  std::vector<Fault> faults = error.faults();
  for (Fault& fault : faults) {
    for (std::string* text : {&fault.file, &fault.where, &fault.rule, &fault.remedy})
      by_original(*text);
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const std::string typed = "--set " + changes[i].path + "=" + changes[i].value;
      if (fault.line == line_of_change(i))
        fault = {"", 0, typed, fault.where + ": " + fault.rule, fault.remedy};
      else if (changes[i].path == "gravity" && fault.where == "--gravity")
        fault = {"", 0, typed, fault.rule, "write --set gravity=0,0,-9.81"};
    }
  }
  return InputError(std::move(faults));
}

}  // namespace twinarm
