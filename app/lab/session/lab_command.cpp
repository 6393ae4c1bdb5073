#include "app/lab/session/lab_command.h"

#include "app/support/text.h"

namespace twinarm {
namespace {

constexpr std::size_t kMaxNames = 64;
constexpr std::size_t kMaxCommands = 4096;
constexpr long kMaxIndex = 1'000'000;

// Each read() returns whether the value has the right type.
bool read(const Value& value, double& into) {
  into = value.number;
  return value.is_number();
}

bool read(const Value& value, std::string& into) {
  into = value.text;
  return value.is_text();
}

bool read(const Value& value, bool& into) {
  into = value.number != 0;
  return value.kind == Value::Kind::boolean;
}

bool read(const Value& value, std::optional<double>& into) {
  if (value.kind == Value::Kind::null) return true;
  return read(value, into.emplace());
}

bool read(const Value& value, std::vector<std::string>& into) {
  if (!value.is_list() || value.items.size() > kMaxNames) return false;
  return std::ranges::all_of(value.items,
                             [&](const Value& item) { return read(item, into.emplace_back()); });
}

template <class Numbers>
bool read_numbers(const Value& value, Numbers& into) {
  if (!value.is_list() || value.items.size() != static_cast<std::size_t>(into.size())) return false;
  auto number = into.begin();
  return std::ranges::all_of(value.items, [&](const Value& item) { return read(item, *number++); });
}

bool read(const Value& value, Vector3& into) {
  return read_numbers(value, into);
}

bool read(const Value& value, std::array<double, 6>& into) {
  const bool is_read = read_numbers(value, into);
  for (double& rate : into) rate = std::clamp(rate, -1.0, 1.0);
  return is_read;
}

struct Field {
  const char* key;
  const char* expected;
  std::function<bool(const Value& value, LabCommand& command)> read;
  bool is_optional = false;
};

template <class T>
Field field(const char* key, const char* expected, T LabCommand::*member,
            bool is_optional = false) {
  return {key, expected, [=](const Value& v, LabCommand& c) { return read(v, c.*member); },
          is_optional};
}

Field whole_number(const char* key, const char* expected, long max, bool is_optional = false) {
  const auto read_count = [max](const Value& v, LabCommand& c) {
    if (!v.is_number() || !(v.number >= 0 && v.number <= static_cast<double>(max))) return false;
    c.count = static_cast<long>(v.number);
    return static_cast<double>(c.count) == v.number;
  };
  return {key, expected, read_count, is_optional};
}

Field angle(const char* key, Eigen::Index component) {
  return {key, "a number",
          [=](const Value& v, LabCommand& c) { return read(v, c.point[component]); }};
}

struct Form {
  std::string name;
  bool needs_control;
  std::vector<Field> fields;
};

const std::vector<Form>& forms() {
  const char *number = "a number", *flag = "true or false", *text = "a text";
  const char *texts = "a list of at most 64 texts", *three = "three numbers";
  const Field stamp = field("stamp", number, &LabCommand::stamp, true);
  const Field on = field("on", flag, &LabCommand::on);
  const Field at = field("at", "seconds, or null", &LabCommand::at);
  const Field name = field("name", text, &LabCommand::name);
  const Field changes = field("changes", texts, &LabCommand::names);
  const Field goal = field("goal", three, &LabCommand::goal);
  const Field index = whole_number("index", "a whole number", 15);
  const Field factor{"factor", "0.001 to 10", [](const Value& v, LabCommand& c) {
                       return read(v, c.value) && c.value >= 0.001 && c.value <= 10;
                     }};
  const auto body = [](bool is_optional) {
    return whole_number("body", "a body's number", kMaxIndex, is_optional);
  };
  static const std::vector<Form> all{
      {"layers", false, {field("names", texts, &LabCommand::names)}},
      {"inspect", false, {on, body(true)}},
      {"request_control", false, {}},
      {"grant_control", false, {whole_number("to", "a client's number", kMaxIndex)}},
      {"seek", true, {at}},
      {"play", true, {on}},
      {"step", true, {whole_number("steps", "1 to 100000", 100'000)}},
      {"speed", true, {factor}},
      {"set", true, {changes}},
      {"branch", true, {at, changes}},
      {"preset", true, {name}},
      {"scene", true, {name}},
      {"edit",
       true,
       {field("what", text, &LabCommand::name), field("name", text, &LabCommand::spec, true)}},
      {"reset", true, {}},
      {"reset_parameters", true, {}},
      {"input",
       true,
       {field("source", text, &LabCommand::name), field("spec", text, &LabCommand::spec, true)}},
      {"drag_stylus", true, {goal, stamp}},
      {"joint", true, {index, field("value", number, &LabCommand::value), stamp}},
      {"rotate_stylus", true, {angle("yaw", 0), angle("pitch", 1), angle("roll", 2), stamp}},
      {"axes", true, {field("rates", "six numbers", &LabCommand::rates), stamp}},
      {"button", true, {index, field("down", flag, &LabCommand::on), stamp}},
      {"drag_body", true, {body(false), field("point", three, &LabCommand::point), goal, stamp}},
      {"release", true, {}}};
  return all;
}

const Form& form_of(const Value& root) {
  const Value* what = root.find("do");
  if (!what || !what->is_text())
    throw InputError(
        {{"command", 0, "do", "is missing", "write {\"do\": \"play\", ..}", "lab.missing"}});
  const auto found = std::ranges::find(forms(), what->text, &Form::name);
  if (found == forms().end())
    throw InputError(
        {{"command", 0, "do", "there is no '" + what->text + "'",
          name_remedy(what->text, names_of(forms()), "commands"), "lab.unknown-command"}});
  return *found;
}

}  // namespace

LabCommand parse_command(const std::string& text) {
  LabCommand command;
  command.came = std::chrono::steady_clock::now();
  const Value root = parse_json(text, "command");
  const Form& form = form_of(root);
  command.what = form.name;
  DiagnosticList faults;
  for (const Field& field : form.fields) {
    const Value* value = root.find(field.key);
    const std::string where = form.name + ", " + field.key;
    const std::string fix = std::string("give ") + field.expected;
    if (!value && !field.is_optional)
      faults.add({"command", 0, where, "is missing", fix, "lab.missing"});
    else if (value && !field.read(*value, command))
      faults.add({"command", 0, where, "is " + describe(*value), fix, "lab.type"});
  }
  faults.check();
  return command;
}

bool needs_control(std::string_view what) {
  return std::ranges::find(forms(), what, &Form::name)->needs_control;
}

bool is_movement(std::string_view what) {
  return what == "drag_stylus" || what == "joint" || what == "rotate_stylus" || what == "axes" ||
         what == "drag_body";
}

std::string text_of_command(const std::string& text) {
  Value root = parse_json(text, "command");
  const Form& form = form_of(root);
  if (is_movement(form.name)) return form.name;
  std::erase_if(root.members, [&](const Value& member) {
    return std::ranges::none_of(form.fields,
                                [&](const Field& field) { return member.key == field.key; });
  });
  return form.name + (" " + replace_all(to_toml(root), "\n", " "));
}

void Inbox::push(LabCommand command) {
  locked([&] {
    if (contents_.commands.size() < kMaxCommands) contents_.commands.push_back(std::move(command));
  });
}

void Inbox::note(const std::string& level, const std::string& text) {
  locked([&] {
    if (notes_.size() == kMaxNotes) notes_.pop_front();
    std::size_t size = std::min(text.size(), kMaxNote);
    while (size < text.size() && (text[size] & 0xC0) == 0x80) --size;  // whole characters
    notes_.push_back({0, level, text.substr(0, size) + (size < text.size() ? " .." : "")});
  });
}

bool Inbox::stop() {
  bool was_stopped = false;
  locked([&] { was_stopped = std::exchange(stop_, true); });
  return !was_stopped;
}

Inbox::Contents Inbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(contents_, {});
}

std::deque<LabNote> Inbox::take_notes() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notes_, {});
}

bool Inbox::is_stopped() const {
  const std::lock_guard lock(mutex_);
  return stop_;
}

void Inbox::sleep_until(std::chrono::steady_clock::time_point time) {
  std::unique_lock lock(mutex_);
  came_.wait_until(lock, time, [this] {
    return stop_ || contents_.refused || contents_.tried || !contents_.commands.empty() ||
           !contents_.built.empty() || !notes_.empty();
  });
}

}  // namespace twinarm
