#include "app/study/settings.h"

#include <toml++/toml.h>

#include "collision/import/toml_file.h"
#include "solver/fault.h"

namespace twinarm {
namespace {

// Reads entries by their dotted path and collects what is wrong.
class Reader {
 public:
  Reader(std::string file, const toml::table& root) : file_(std::move(file)), root_(root) {}

  double number(const std::string& path) {
    const auto value = root_.at_path(path).value<double>();
    if (!value) miss(path, "a number");
    return value.value_or(0.0);
  }
  unsigned whole(const std::string& path) {
    const auto value = root_.at_path(path).value<unsigned>();
    if (!value) miss(path, "a whole number of at least 0");
    return value.value_or(0);
  }
  std::string text(const std::string& path) {
    const auto value = root_.at_path(path).value<std::string>();
    if (!value) miss(path, "a text");
    return value.value_or("");
  }
  std::vector<double> numbers(const std::string& path) {
    std::vector<double> values;
    if (const auto* array = root_.at_path(path).as_array())
      for (const auto& entry : *array)
        if (const auto value = entry.value<double>()) values.push_back(*value);
    if (values.empty()) miss(path, "a list of numbers");
    return values;
  }
  Vector3 vector(const std::string& path) {
    const std::vector<double> v = numbers(path);
    if (v.size() != 3) {
      if (!v.empty()) miss(path, "three numbers");
      return Vector3::Zero();
    }
    return {v[0], v[1], v[2]};
  }
  std::vector<std::string> texts(const std::string& path) {
    std::vector<std::string> values;
    if (const auto* array = root_.at_path(path).as_array())
      for (const auto& entry : *array)
        if (const auto value = entry.value<std::string>()) values.push_back(*value);
    if (values.empty()) miss(path, "a list of texts");
    return values;
  }
  std::size_t count(const std::string& path) {
    const auto* array = root_.at_path(path).as_array();
    return array ? array->size() : 0;
  }
  void check() const { faults_.check(); }

 private:
  void miss(const std::string& path, const std::string& kind) {
    faults_.add({file_, 0, path, "must be " + kind, "see the file as it was shipped"});
  }
  std::string file_;
  const toml::table& root_;
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
  s.joints.turned = read.texts("robot.turned");
  s.joints.gripper = read.text("robot.gripper");
  s.joints.gripper_open = read.number("robot.gripper_open");
  s.joints.gripper_closed = read.number("robot.gripper_closed");
  s.added_mass = read.number("robot.added_mass");
  for (std::size_t m = 0; m < read.count("robot.mount"); ++m) {
    const std::string path = "robot.mount[" + std::to_string(m) + "]";
    s.mounts.push_back({read.text(path + ".link"), read.vector(path + ".point")});
  }
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
