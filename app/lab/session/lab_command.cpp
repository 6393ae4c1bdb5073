#include "app/lab/session/lab_command.h"

#include <algorithm>
#include <utility>

#include "app/data/value.h"
#include "app/support/text.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

using Spoken = LabCommand::Do;
using Kind = Value::Kind;

constexpr std::size_t kMaxNames = 64;

// One key of a command: how it is checked and where it goes.
struct Field {
  const char* key;
  const char* wanted;  // "a number"
  bool (*take)(const Value& value, LabCommand& command);
  bool may_be_missing = false;
};

bool take_vector(const Value& value, Vector3& into) {
  if (value.kind != Kind::list || value.items.size() != 3) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (value.items[i].kind != Kind::number) return false;
    into[static_cast<Eigen::Index>(i)] = value.items[i].number;
  }
  return true;
}

bool take_count(const Value& value, long most, long& into) {
  if (value.kind != Kind::number || !(value.number >= 0 && value.number <= double(most)))
    return false;
  into = static_cast<long>(value.number);
  return static_cast<double>(into) == value.number;
}

bool take_number(const Value& value, double& into) {
  into = value.number;
  return value.is_number();
}

bool take_text(const Value& value, std::string& into) {
  into = value.text;
  return value.is_text();
}

bool take_texts(const Value& value, LabCommand& command) {
  if (value.kind != Kind::list || value.items.size() > kMaxNames) return false;
  for (const Value& item : value.items) {
    if (!item.is_text()) return false;
    command.names.push_back(item.text);
  }
  return true;
}

bool take_flag(const Value& value, LabCommand& command) {
  command.on = value.number != 0;
  return value.kind == Kind::boolean;
}

bool take_instant(const Value& value, LabCommand& command) {
  if (value.kind == Kind::null) return true;
  command.at = value.number;
  return value.is_number();
}

bool take_rates(const Value& value, LabCommand& command) {
  if (value.kind != Kind::list || value.items.size() != command.rates.size()) return false;
  for (std::size_t i = 0; i < command.rates.size(); ++i) {
    if (value.items[i].kind != Kind::number) return false;
    command.rates[i] = std::clamp(value.items[i].number, -1.0, 1.0);
  }
  return true;
}

template <int component>
bool take_turn(const Value& value, LabCommand& command) {
  return take_number(value, command.point[component]);
}

bool take_factor(const Value& value, LabCommand& command) {
  return take_number(value, command.value) && command.value >= 0.001 && command.value <= 10;
}

constexpr long kMaxIndex = 1'000'000;
template <long most>
bool take_index(const Value& value, LabCommand& command) {
  return take_count(value, most, command.count);
}

struct Form {
  const char* name;
  Spoken what;
  bool needs_hand;
  std::vector<Field> fields;
};

const std::vector<Form>& forms() {
  const auto value = [](const Value& v, LabCommand& c) { return take_number(v, c.value); };
  const auto name = [](const Value& v, LabCommand& c) { return take_text(v, c.name); };
  const auto spec = [](const Value& v, LabCommand& c) { return take_text(v, c.spec); };
  const auto point = [](const Value& v, LabCommand& c) { return take_vector(v, c.point); };
  const auto goal = [](const Value& v, LabCommand& c) { return take_vector(v, c.goal); };
  const auto mark = [](const Value& v, LabCommand& c) { return take_number(v, c.stamp); };
  const Field stamp{"stamp", "a number", mark, true};
  const Field on{"on", "true or false", take_flag};
  const Field changes{"changes", "a list of at most 64 texts", take_texts};
  const Field index{"index", "a whole number", take_index<15>};
  static const std::vector<Form> all{
      {"layers", Spoken::layers, false, {{"names", "a list of at most 64 texts", take_texts}}},
      {"glass",
       Spoken::glass,
       false,
       {on, {"body", "a body's number", take_index<kMaxIndex>, true}}},
      {"take", Spoken::take, false, {}},
      {"give", Spoken::give, false, {{"to", "a client's number", take_index<kMaxIndex>}}},
      {"look", Spoken::look, false, {{"at", "seconds, or null", take_instant}}},
      {"play", Spoken::play, true, {on}},
      {"step", Spoken::step, true, {{"steps", "1 to 100000", take_index<100'000>}}},
      {"speed", Spoken::speed, true, {{"factor", "0.001 to 10", take_factor}}},
      {"set", Spoken::set, true, {changes}},
      {"branch", Spoken::branch, true, {{"at", "seconds, or null", take_instant}, changes}},
      {"preset", Spoken::preset, true, {{"name", "a text", name}}},
      {"scene", Spoken::scene, true, {{"name", "a text", name}}},
      {"reset", Spoken::reset, true, {}},
      {"restore", Spoken::restore, true, {}},
      {"hand", Spoken::hand, true, {{"source", "a text", name}, {"spec", "a text", spec, true}}},
      {"tip", Spoken::tip, true, {{"goal", "three numbers", goal}, stamp}},
      {"joint", Spoken::joint, true, {index, {"value", "a number", value}, stamp}},
      {"turn",
       Spoken::turn,
       true,
       {{"yaw", "a number", take_turn<0>},
        {"pitch", "a number", take_turn<1>},
        {"roll", "a number", take_turn<2>},
        stamp}},
      {"axes", Spoken::axes, true, {{"rates", "six numbers", take_rates}, stamp}},
      {"button", Spoken::button, true, {index, {"down", "true or false", take_flag}, stamp}},
      {"pull",
       Spoken::pull,
       true,
       {{"body", "a body's number", take_index<kMaxIndex>},
        {"point", "three numbers", point},
        {"goal", "three numbers", goal},
        stamp}},
      {"drop", Spoken::drop, true, {}}};
  return all;
}

const Form& form_of(const Value& root) {
  const Value* what = root.find("do");
  std::vector<std::string> names;
  for (const Form& form : forms()) names.emplace_back(form.name);
  if (!what || what->kind != Kind::text)
    throw InputError(
        {{"command", 0, "do", "is missing", "write {\"do\": \"play\", ..}", "lab.missing"}});
  const auto is_it = [&](const Form& form) { return form.name == what->text; };
  const auto found = std::find_if(forms().begin(), forms().end(), is_it);
  if (found == forms().end())
    throw InputError({{"command", 0, "do", "there is no '" + what->text + "'",
                       name_remedy(what->text, names, "commands"), "lab.unknown-command"}});
  return *found;
}

}  // namespace

LabCommand parse_command(const std::string& text) {
  LabCommand command;
  command.came = std::chrono::steady_clock::now();
  const Value root = parse_json(text, "command");
  const Form& form = form_of(root);
  command.what = form.what;
  DiagnosticList faults;
  for (const Field& field : form.fields) {
    const Value* value = root.find(field.key);
    const std::string where = std::string(form.name) + ", " + field.key;
    if (!value && !field.may_be_missing)
      faults.add(
          {"command", 0, where, "is missing", std::string("give ") + field.wanted, "lab.missing"});
    else if (value && !field.take(*value, command))
      faults.add({"command", 0, where, "is " + describe(*value),
                  std::string("give ") + field.wanted, "lab.type"});
  }
  faults.check();
  return command;
}

bool needs_hand(LabCommand::Do what) {
  const auto is_it = [&](const Form& form) { return form.what == what; };
  return std::find_if(forms().begin(), forms().end(), is_it)->needs_hand;
}

namespace {

constexpr std::size_t kMaxCommands = 4096;

}  // namespace

void Inbox::push(LabCommand command) {
  locked([&] {
    if (contents_.commands.size() < kMaxCommands) contents_.commands.push_back(std::move(command));
  });
}

void Inbox::push(BuildResult built) {
  locked([&] { contents_.built.push_back(std::move(built)); });
}

void Inbox::push_refused(long number) {
  locked([&] { contents_.refused = number; });
}

void Inbox::note(const std::string& level, const std::string& text) {
  locked([&] {
    if (notes_.size() == kMaxNotes) notes_.pop_front();
    notes_.push_back({0, level, text});
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
    return stop_ || contents_.refused || !contents_.commands.empty() || !contents_.built.empty() ||
           !notes_.empty();
  });
}

}  // namespace twinarm
