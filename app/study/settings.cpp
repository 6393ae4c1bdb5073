#include "app/study/settings.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/support/nearest_name.h"
#include "collision/import/toml/toml_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// Reads entries by their dotted path and collects what is wrong. The entries that were asked for
// are those that there are.
class Reader {
 public:
  Reader(std::string file, const toml::table& root) : file_(std::move(file)), root_(root) {}

  double number(const std::string& path) {
    const auto value = at(path).value<double>();
    if (!value || !std::isfinite(*value)) miss(path, "a finite number");
    return value.value_or(0.0);
  }
  unsigned whole(const std::string& path) {
    const auto value = at(path).value<unsigned>();
    if (!value) miss(path, "a whole number of at least 0");
    return value.value_or(0);
  }
  std::string text(const std::string& path) {
    const auto value = at(path).value<std::string>();
    if (!value) miss(path, "a text");
    return value.value_or("");
  }
  std::vector<double> numbers(const std::string& path) {
    return list<double>(path, "a list of finite numbers");
  }
  Vector3 vector(const std::string& path) {
    const std::vector<double> v = list<double>(path, "three finite numbers", 3);
    return v.empty() ? Vector3::Zero() : Vector3(v.data());
  }
  std::vector<std::string> texts(const std::string& path, std::size_t count) {
    return list<std::string>(path, "a list of " + std::to_string(count) + " texts", count);
  }
  // Whether there are so many tables [[path]].
  bool tables(const std::string& path, std::size_t count) {
    const auto* array = at(path).as_array();
    const bool right = array && array->size() == count && array->is_array_of_tables();
    if (!right) miss(path, std::to_string(count) + " tables [[" + path + "]]");
    return right;
  }
  void check() {
    tell_unknown(root_, "");
    faults_.check();
  }

 private:
  // Empty where it is not what it must be; of any length where `count` is 0.
  template <typename T>
  std::vector<T> list(const std::string& path, const std::string& kind, std::size_t count = 0) {
    std::vector<T> values;
    const auto* array = at(path).as_array();
    for (std::size_t i = 0; array && i < array->size(); ++i)
      if (const auto value = array->get(i)->value<T>(); value && is_finite(*value))
        values.push_back(*value);
    const bool all = array && values.size() == array->size() && !values.empty();
    if (all && (count == 0 || values.size() == count)) return values;
    miss(path, kind);
    return {};
  }
  static bool is_finite(double value) { return std::isfinite(value); }
  static bool is_finite(const std::string&) { return true; }
  toml::node_view<const toml::node> at(const std::string& path) {
    asked_.insert(path);
    return root_.at_path(path);
  }
  void miss(const std::string& path, const std::string& kind) {
    faults_.add({file_, line_of(root_.at_path(path).node()), path, "must be " + kind,
                 "see the file as it was shipped"});
  }
  static int line_of(const toml::node* node) {
    return node ? static_cast<int>(node->source().begin.line) : 0;
  }
  // The keys asked for of a table; `inside`: "robot.mount[0].", empty for the root.
  std::vector<std::string> keys_of(const std::string& inside) const {
    std::vector<std::string> keys;
    for (auto it = asked_.lower_bound(inside); it != asked_.end() && it->starts_with(inside);
         ++it) {
      const std::size_t from = inside.size();
      std::string key = it->substr(from, it->find_first_of(".[", from) - from);
      if (keys.empty() || keys.back() != key) keys.push_back(std::move(key));
    }
    return keys;
  }
  void tell_unknown(const toml::table& table, const std::string& inside) {
    const std::vector<std::string> keys = keys_of(inside);
    if (keys.empty()) return;  // no table was wanted: told as such
    for (const auto& [key, node] : table) {
      const std::string name(key.str()), path = inside + name;
      if (faults_.is_full()) return;
      if (std::find(keys.begin(), keys.end(), name) == keys.end())
        faults_.add({file_, line_of(&node), path, "this key is not known here",
                     name_remedy(name, keys, "keys")});
      else if (const auto* inner = node.as_table())
        tell_unknown(*inner, path + ".");
      else if (const auto* list = node.as_array())
        for (std::size_t i = 0; i < list->size(); ++i)
          if (const auto* item = list->get_as<toml::table>(i))
            tell_unknown(*item, path + "[" + std::to_string(i) + "].");
    }
  }

  std::string file_;
  const toml::table& root_;
  std::set<std::string> asked_;
  FaultList faults_;
};

}  // namespace

StudySettings read_settings(const std::filesystem::path& assets) {
  const std::filesystem::path file = assets / "study" / "settings.toml";
  const std::string text = read_toml_text(file);
  toml::table root;
  try {
    root = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError({{file.string(), static_cast<int>(error.source().begin.line), "",
                       std::string(error.description()), "mend the file, or give --assets"}});
  }
  Reader read(file.string(), root);
  StudySettings s;
  s.assets = assets;
  s.urdf = assets / read.text("robot.urdf");
  s.joints.turned = read.texts("robot.turned", 3);
  s.joints.gripper = read.text("robot.gripper");
  s.joints.gripper_open = read.number("robot.gripper_open");
  s.joints.gripper_closed = read.number("robot.gripper_closed");
  s.added_mass = read.number("robot.added_mass");
  if (read.tables("robot.mount", 2))  // of the two linear springs
    for (const std::string mount : {"robot.mount[0]", "robot.mount[1]"})
      s.mounts.push_back({read.text(mount + ".link"), read.vector(mount + ".point")});
  s.auxiliary_frequency_hz = read.number("auxiliary.frequency_hz");
  s.auxiliary_damping_ratio = read.number("auxiliary.damping_ratio");
  s.stop_stiffness = read.number("auxiliary.stop_stiffness");
  s.stop_damping = read.number("auxiliary.stop_damping");
  s.rates_hz = read.numbers("protocol.rates_hz");
  s.search_rates_hz = read.numbers("protocol.search_rates_hz");
  s.identification_rates_hz = read.numbers("protocol.identification_rates_hz");
  s.sweep_times = read.numbers("protocol.sweep_times");
  s.held_physics_hz = read.number("protocol.held_physics_hz");
  s.implicit_frequency_hz = read.number("protocol.implicit_frequency_hz");
  s.implicit_damping_ratio = read.number("protocol.implicit_damping_ratio");
  s.seed = read.whole("operator.seed");
  s.operator_duration = read.number("operator.duration");
  s.obstacle.size = read.vector("obstacle.size");
  s.obstacle.position = read.vector("obstacle.position");
  s.obstacle.rate_hz = read.number("obstacle.rate_hz");
  s.obstacle.contact_stiffness = read.number("obstacle.contact_stiffness");
  s.obstacle.contact_dissipation = read.number("obstacle.contact_dissipation");
  s.obstacle.friction = read.number("obstacle.friction");
  s.obstacle.coupling_frequency_hz = read.number("obstacle.coupling_frequency_hz");
  s.obstacle.coupling_damping_ratio = read.number("obstacle.coupling_damping_ratio");
  read.check();
  return s;
}

}  // namespace twinarm
