#include "app/command/coupling_of_options.h"

#include <utility>

namespace twinarm {
namespace {

TomlValue empty_entry(TomlValue::Kind kind, std::string key) {
  TomlValue made;
  made.kind = kind;
  made.key = std::move(key);
  return made;
}
TomlValue text_entry(std::string key, std::string words) {
  TomlValue made = empty_entry(TomlValue::Kind::text, std::move(key));
  made.text = std::move(words);
  return made;
}
TomlValue number_entry(std::string key, double size) {
  TomlValue made = empty_entry(TomlValue::Kind::number, std::move(key));
  made.number = size;
  return made;
}
// A list with one table in it.
TomlValue list_of_one(std::string key, TomlValue table) {
  TomlValue made = empty_entry(TomlValue::Kind::list, std::move(key));
  made.items.push_back(std::move(table));
  return made;
}

}  // namespace

TomlValue scene_of_options(const CouplingPredictOptions& options, FaultList& faults) {
  using Kind = TomlValue::Kind;
  TomlValue robot = empty_entry(Kind::table, "");
  robot.members = {text_entry("name", "robot"),
                   text_entry("model", std::filesystem::absolute(options.robot.model).string())};
  TomlValue coupling = empty_entry(Kind::table, "");
  coupling.members.push_back(text_entry("name", "coupling"));
  for (const auto& [key, words] : {std::pair{"type", &options.type},
                                   {"link", &options.link},
                                   {"measure", &options.measure},
                                   {"treatment", &options.treatment}})
    if (!words->empty()) coupling.members.push_back(text_entry(key, *words));
  for (const auto& [key, size] :
       {std::pair{"stiffness", &options.stiffness}, {"damping", &options.damping}})
    if (*size) coupling.members.push_back(number_entry(key, **size));
  if (!options.point.empty()) {
    TomlValue point = empty_entry(Kind::list, "point");
    for (const double x : parse_list("--point", options.point, faults))
      point.items.push_back(number_entry("", x));
    coupling.members.push_back(std::move(point));
  }
  TomlValue scene = empty_entry(Kind::table, "");
  scene.members = {list_of_one("robot", std::move(robot)),
                   list_of_one("coupling", std::move(coupling))};
  return scene;
}

}  // namespace twinarm
