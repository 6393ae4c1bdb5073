#include "app/data/table_reader.h"

#include <algorithm>
#include <cmath>

#include "app/support/nearest_name.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// Lengths that were typed with few digits are mended in silence.
constexpr double kFewDigits = 1e-6;

bool is_finite_number(const TomlValue& value) {
  return value.kind == TomlValue::Kind::number && std::isfinite(value.number);
}

}  // namespace

const TomlValue* SceneTable::find(const std::string& key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  return table_.find(key);
}

const TomlValue* SceneTable::find(const std::string& key, TomlValue::Kind kind,
                                  const char* wanted) {
  const TomlValue* value = find(key);
  if (!value || value->kind == kind) return value;
  fault(key, std::string("must be ") + wanted + ", is " + describe(*value), "", "scene.type");
  return nullptr;
}

std::optional<double> SceneTable::number(const std::string& key) {
  const TomlValue* value = find(key, TomlValue::Kind::number, "a number");
  if (!value) return std::nullopt;
  if (std::isfinite(value->number)) return value->number;
  fault(key, "must be finite, is " + describe(*value), "give a number in SI units",
        "scene.not-finite");
  return std::nullopt;
}

std::optional<double> SceneTable::positive(const std::string& key) {
  const auto value = number(key);
  if (!value || *value > 0) return value;
  fault(key, "must be positive, is " + number_text(*value), "give a number above 0",
        "scene.not-positive");
  return std::nullopt;
}

std::optional<double> SceneTable::not_negative(const std::string& key) {
  const auto value = number(key);
  if (!value || *value >= 0) return value;
  fault(key, "must not be negative, is " + number_text(*value), "give 0 or more", "scene.negative");
  return std::nullopt;
}

std::optional<std::string> SceneTable::text(const std::string& key) {
  const TomlValue* value = find(key, TomlValue::Kind::text, "a text");
  if (!value) return std::nullopt;
  if (!value->text.empty()) return value->text;
  fault(key, "must not be empty", "give " + key + " = \"...\"", "scene.empty");
  return std::nullopt;
}

std::optional<bool> SceneTable::flag(const std::string& key) {
  const TomlValue* value = find(key, TomlValue::Kind::boolean, "true or false");
  if (!value) return std::nullopt;
  return value->number != 0;
}

std::optional<std::vector<double>> SceneTable::numbers(const std::string& key, std::size_t count) {
  const TomlValue* value = find(key);
  if (!value) return std::nullopt;
  const bool good = value->kind == TomlValue::Kind::list && value->items.size() == count &&
                    std::all_of(value->items.begin(), value->items.end(), is_finite_number);
  if (!good) {
    const auto bad = std::find_if_not(value->items.begin(), value->items.end(), is_finite_number);
    fault(key,
          "must be a list of " + std::to_string(count) + " finite numbers, is " + describe(*value) +
              (bad != value->items.end() ? " with " + describe(*bad) : ""),
          "", "scene.list");
    return std::nullopt;
  }
  std::vector<double> found;
  for (const TomlValue& item : value->items) found.push_back(item.number);
  return found;
}

std::optional<Vector3> SceneTable::vector(const std::string& key) {
  const auto found = numbers(key, 3);
  if (!found) return std::nullopt;
  return Vector3(found->data());
}

std::optional<Vector3> SceneTable::unit_vector(const std::string& key) {
  const auto found = vector(key);
  if (!found) return std::nullopt;
  if (std::abs(found->norm() - 1) <= kFewDigits) return found->normalized();
  fault(key, "must have length 1, has " + short_number_text(found->norm()),
        "divide it by its length", "scene.length");
  return std::nullopt;
}

std::optional<Matrix3> SceneTable::orientation(const std::string& key) {
  const auto q = numbers(key, 4);
  if (!q) return std::nullopt;
  Eigen::Quaterniond turn((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
  if (std::abs(turn.norm() - 1) > kFewDigits) {
    fault(key,
          "a quaternion (w, x, y, z) has length 1, this one has " + short_number_text(turn.norm()),
          "divide it by its length", "scene.length");
    return std::nullopt;
  }
  return turn.normalized().toRotationMatrix();
}

std::optional<std::size_t> SceneTable::choice(const std::string& key,
                                              const std::vector<std::string>& names) {
  const auto name = text(key);
  if (!name) return std::nullopt;
  const auto found = std::find(names.begin(), names.end(), *name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  fault(key, "'" + *name + "' is not known", name_remedy(*name, names, "possible"), "scene.choice");
  return std::nullopt;
}

std::vector<const TomlValue*> SceneTable::tables(const std::string& key) {
  const TomlValue* value = find(key);
  std::vector<const TomlValue*> found;
  if (!value) return found;
  constexpr std::size_t kMostTables = 10000;  // each is compared with all others by name
  if (value->items.size() > kMostTables) {
    fault(key, "has " + std::to_string(value->items.size()) + " tables", "give at most 10000",
          "scene.too-many");
    return found;
  }
  for (const TomlValue& item : value->items)
    if (item.kind == TomlValue::Kind::table) found.push_back(&item);
  if (value->kind != TomlValue::Kind::list || found.size() != value->items.size())
    fault(key, "must be a list of tables, is " + describe(*value),
          "write [[" + key + "]] with two brackets", "scene.type");
  return found;
}

const TomlValue* SceneTable::table(const std::string& key) {
  return find(key, TomlValue::Kind::table, "a table");
}

void SceneTable::fault(const std::string& key, std::string rule, std::string remedy,
                       std::string_view code) {
  const TomlValue* value = table_.find(key);
  const std::string inside = key.empty() ? "" : ", " + key;
  faults_.add({file_, value ? value->line : table_.line, where_ + inside, std::move(rule),
               std::move(remedy), code});
}

void SceneTable::missing(const std::string& key, std::string remedy) {
  if (!find(key)) fault(key, "is missing", std::move(remedy), "scene.missing");
}

void SceneTable::done() {
  for (const TomlValue& member : table_.members)
    if (!faults_.is_full() && std::find(asked_.begin(), asked_.end(), member.key) == asked_.end())
      fault(member.key, "this key is not known here", name_remedy(member.key, asked_, "keys"),
            "scene.unknown-key");
}

}  // namespace twinarm
