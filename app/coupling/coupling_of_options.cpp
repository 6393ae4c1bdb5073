#include "app/coupling/coupling_of_options.h"

#include <utility>

namespace twinarm {
namespace {

TomlValue value(TomlValue::Kind kind, std::string key) {
  TomlValue made;
  made.kind = kind;
  made.key = std::move(key);
  return made;
}
TomlValue text(std::string key, std::string words) {
  TomlValue made = value(TomlValue::Kind::text, std::move(key));
  made.text = std::move(words);
  return made;
}
TomlValue number(std::string key, double size) {
  TomlValue made = value(TomlValue::Kind::number, std::move(key));
  made.number = size;
  return made;
}
// A list with one table in it.
TomlValue only(std::string key, TomlValue table) {
  TomlValue made = value(TomlValue::Kind::list, std::move(key));
  made.items.push_back(std::move(table));
  return made;
}

}  // namespace

TomlValue scene_of_options(const CouplingPredictOptions& options, FaultList& faults) {
  using Kind = TomlValue::Kind;
  TomlValue robot = value(Kind::table, "");
  robot.members = {text("name", "robot"),
                   text("model", std::filesystem::absolute(options.robot.model).string())};
  TomlValue coupling = value(Kind::table, "");
  coupling.members.push_back(text("name", "coupling"));
  for (const auto& [key, words] : {std::pair{"type", &options.type},
                                   {"link", &options.link},
                                   {"measure", &options.measure},
                                   {"treatment", &options.treatment}})
    if (!words->empty()) coupling.members.push_back(text(key, *words));
  for (const auto& [key, size] :
       {std::pair{"stiffness", &options.stiffness}, {"damping", &options.damping}})
    if (*size) coupling.members.push_back(number(key, **size));
  if (!options.point.empty()) {
    TomlValue point = value(Kind::list, "point");
    for (const double x : parse_list("--point", options.point, faults))
      point.items.push_back(number("", x));
    coupling.members.push_back(std::move(point));
  }
  TomlValue scene = value(Kind::table, "");
  scene.members = {only("robot", std::move(robot)), only("coupling", std::move(coupling))};
  return scene;
}

}  // namespace twinarm
