#include "app/study/settings.h"

#include "app/data/table_reader.h"

namespace twinarm {
namespace {

constexpr const char* kFix = "see the shipped file";

// Table of the settings: every key is required. Invalid values are reported and read as zero.
class SettingsTable : public TableReader {
 public:
  SettingsTable(const Value& table, std::string where, const std::string& file,
                DiagnosticList& faults)
      : TableReader(table, std::move(where), file, faults), faults_(faults) {}

  SettingsTable part(const std::string& key) {
    static const Value kNone;
    missing(key, kFix);
    const Value* part = table(key);
    return {part ? *part : kNone, key, file(), faults_};
  }
  double number(const std::string& key) { return required(&TableReader::number, key); }
  double positive(const std::string& key) { return required(&TableReader::positive, key); }
  double not_negative(const std::string& key) { return required(&TableReader::not_negative, key); }
  std::string text(const std::string& key) { return required(&TableReader::text, key); }
  Vector3 vector(const std::string& key) {
    return required(&TableReader::vector, key, Vector3::Zero());
  }
  unsigned whole(const std::string& key) {
    const double value = number(key);
    if (value >= 0 && value < 4294967296.0 && value == std::floor(value))
      return static_cast<unsigned>(value);
    fault(key, "must be a whole number of at least 0", kFix, "study.whole-number");
    return 0;
  }
  std::array<double, 2> range(const std::string& key) {
    missing(key, kFix);
    const auto pair = TableReader::numbers(key, 2);
    if (!pair) return {1, 1};
    if (pair->at(0) > 0 && pair->at(0) <= pair->at(1)) return {pair->at(0), pair->at(1)};
    fault(key, "must be [low, high], both positive", kFix, "study.range");
    return {1, 1};
  }
  std::vector<double> numbers(const std::string& key) {
    std::vector<double> all;
    for (const Value& item : items(key, Value::Kind::number, "a list of finite numbers"))
      all.push_back(item.number);
    if (std::ranges::any_of(all, [](double one) { return one <= 0; }))
      fault(key, "must be positive numbers", kFix, "study.range");
    return all;
  }
  std::vector<std::string> texts(const std::string& key, std::size_t count) {
    std::vector<std::string> all;
    for (const Value& item :
         items(key, Value::Kind::text, "a list of " + std::to_string(count) + " texts", count))
      all.push_back(item.text);
    return all;
  }

 private:
  template <class T>
  T required(std::optional<T> (TableReader::*read)(const std::string&), const std::string& key,
             const std::type_identity_t<T>& none = {}) {
    missing(key, kFix);
    return (this->*read)(key).value_or(none);
  }

  // A nonempty list; of `count` items if that is not 0.
  std::vector<Value> items(const std::string& key, Value::Kind kind, const std::string& wanted,
                           std::size_t count = 0) {
    const Value* list = find(key);
    bool good = list && list->kind == Value::Kind::list && !list->items.empty() &&
                (count == 0 || list->items.size() == count);
    for (std::size_t i = 0; good && i < list->items.size(); ++i)
      good = list->items[i].kind == kind && std::isfinite(list->items[i].number);
    if (good) return list->items;
    fault(key, "must be " + wanted, kFix, "study.list");
    return {};
  }

  DiagnosticList& faults_;
};

void read_robot(SettingsTable robot, DiagnosticList& faults, StudySettings& s) {
  s.urdf = s.assets / robot.text("urdf");
  s.joints.turned = robot.texts("turned", 3);
  s.joints.gripper = robot.text("gripper");
  s.joints.gripper_open = robot.number("gripper_open");
  s.joints.gripper_closed = robot.number("gripper_closed");
  s.added_mass = robot.not_negative("added_mass");
  const auto mounts = robot.tables("mount");
  if (mounts.size() != 2)  // one for each linear spring
    robot.fault("mount", "must be 2 tables [[robot.mount]]", kFix, "study.mounts");
  for (const Value* one : mounts) {
    SettingsTable mount(*one, "robot.mount", robot.file(), faults);
    s.mounts.push_back({mount.text("link"), mount.vector("point")});
    mount.done();
  }
  robot.done();
}

}  // namespace

StudySettings read_settings(const std::filesystem::path& assets) {
  const std::filesystem::path path = assets / "study" / "settings.toml";
  const std::string file = path.string();
  const Value root = read_toml(path);
  DiagnosticList faults;
  SettingsTable all(root, "settings", file, faults);
  StudySettings s;
  s.assets = assets;
  read_robot(all.part("robot"), faults, s);
  SettingsTable auxiliary = all.part("auxiliary"), protocol = all.part("protocol"),
                person = all.part("operator"), obstacle = all.part("obstacle"),
                far = all.part("far_target");
  s.auxiliary_frequency_hz = auxiliary.positive("frequency_hz");
  s.auxiliary_damping_ratio = auxiliary.not_negative("damping_ratio");
  s.stop_stiffness = auxiliary.not_negative("stop_stiffness");
  s.stop_damping = auxiliary.not_negative("stop_damping");
  s.rates_hz = protocol.numbers("rates_hz");
  if (!s.rates_hz.empty() && std::ranges::find(s.rates_hz, 60.0) == s.rates_hz.end())
    protocol.fault("rates_hz", "lacks 60 Hz, at which the report compares the laws", "add 60",
                   "study.rates");
  s.search_rates_hz = protocol.numbers("search_rates_hz");
  s.identification_rates_hz = protocol.numbers("identification_rates_hz");
  s.sweep_times = protocol.numbers("sweep_times");
  s.held_physics_hz = protocol.positive("held_physics_hz");
  s.implicit_frequency_hz = protocol.positive("implicit_frequency_hz");
  s.implicit_damping_ratio = protocol.not_negative("implicit_damping_ratio");
  s.seed = person.whole("seed");
  s.seeds = person.whole("seeds");
  if (s.seeds < 10 || s.seeds > 10000)
    person.fault("seeds", "must be 10 to 10000", "100 take some seconds", "study.whole-number");
  s.operator_ranges.peak_speed = person.range("peak_speed");
  s.operator_ranges.tremor = person.range("tremor");
  s.operator_duration = person.positive("duration");
  s.obstacle = {obstacle.vector("size"), obstacle.vector("position")};
  s.contact_stiffness = obstacle.positive("contact_stiffness");
  s.contact_dissipation = obstacle.not_negative("contact_dissipation");
  s.contact_friction = obstacle.not_negative("friction");
  s.far_target = {{far.vector("size"), far.vector("position")},
                  far.positive("rate_hz"),
                  far.positive("frequency_hz"),
                  far.not_negative("damping_ratio")};
  for (SettingsTable* table : {&all, &auxiliary, &protocol, &person, &obstacle, &far})
    table->done();
  faults.check();
  return s;
}

}  // namespace twinarm
