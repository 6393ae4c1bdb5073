#include "app/data/table_reader.h"

#include <algorithm>
#include <cmath>

#include "app/support/text.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr double kFewDigits = 1e-6;  // tolerance for unit lengths given with few digits

bool is_finite_number(const Value& value) {
  return value.is_number() && std::isfinite(value.number);
}

}  // namespace

const Value* TableReader::find(const std::string& key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.push_back(key);
  return table_.find(key);
}

const Value* TableReader::find(const std::string& key, Value::Kind kind, const char* wanted) {
  const Value* value = find(key);
  if (!value || value->kind == kind) return value;
  fault(key, std::string("must be ") + wanted + ", is " + describe(*value), "", "scene.type");
  return nullptr;
}

std::optional<double> TableReader::number(const std::string& key) {
  const Value* value = find(key, Value::Kind::number, "a number");
  if (!value) return std::nullopt;
  if (std::isfinite(value->number)) return value->number;
  fault(key, "must be finite, is " + describe(*value), "give a number in SI units",
        "scene.not-finite");
  return std::nullopt;
}

std::optional<double> TableReader::positive(const std::string& key) {
  const auto value = number(key);
  if (!value || *value > 0) return value;
  fault(key, "must be positive, is " + number_text(*value), "give a number above 0",
        "scene.not-positive");
  return std::nullopt;
}

std::optional<double> TableReader::not_negative(const std::string& key) {
  const auto value = number(key);
  if (!value || *value >= 0) return value;
  fault(key, "must not be negative, is " + number_text(*value), "give 0 or more", "scene.negative");
  return std::nullopt;
}

std::optional<std::string> TableReader::text(const std::string& key) {
  const Value* value = find(key, Value::Kind::text, "a text");
  if (!value) return std::nullopt;
  if (!value->text.empty()) return value->text;
  fault(key, "must not be empty", "give " + key + " = \"...\"", "scene.empty");
  return std::nullopt;
}

std::optional<bool> TableReader::flag(const std::string& key) {
  const Value* value = find(key, Value::Kind::boolean, "true or false");
  if (!value) return std::nullopt;
  return value->number != 0;
}

std::optional<std::vector<double>> TableReader::numbers(const std::string& key, std::size_t count) {
  const Value* value = find(key);
  if (!value) return std::nullopt;
  const bool good = value->kind == Value::Kind::list && value->items.size() == count &&
                    std::ranges::all_of(value->items, is_finite_number);
  if (!good) {
    const auto bad = std::ranges::find_if_not(value->items, is_finite_number);
    fault(key,
          "must be a list of " + std::to_string(count) + " finite numbers, is " + describe(*value) +
              (bad != value->items.end() ? " with " + describe(*bad) : ""),
          "", "scene.list");
    return std::nullopt;
  }
  std::vector<double> found;
  for (const Value& item : value->items) found.push_back(item.number);
  return found;
}

std::optional<Vector3> TableReader::vector(const std::string& key) {
  const auto found = numbers(key, 3);
  if (!found) return std::nullopt;
  return Vector3(found->data());
}

std::optional<Vector3> TableReader::unit_vector(const std::string& key) {
  const auto found = vector(key);
  if (!found) return std::nullopt;
  if (std::abs(found->norm() - 1) <= kFewDigits) return found->normalized();
  fault(key, "must have length 1, has " + short_number_text(found->norm()),
        "divide it by its length", "scene.length");
  return std::nullopt;
}

std::optional<Matrix3> TableReader::orientation(const std::string& key) {
  const auto q = numbers(key, 4);
  if (!q) return std::nullopt;
  if (!unit_length(key, std::span<const double, 4>(*q))) return std::nullopt;
  return Eigen::Quaterniond((*q)[0], (*q)[1], (*q)[2], (*q)[3]).normalized().toRotationMatrix();
}

std::optional<double> TableReader::unit_length(const std::string& key,
                                               std::span<const double, 4> q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (std::abs(length - 1) <= kFewDigits) return length;
  fault(key, "a quaternion (w, x, y, z) has length 1, this one has " + short_number_text(length),
        "divide it by its length", "scene.length");
  return std::nullopt;
}

std::optional<std::size_t> TableReader::choice(const std::string& key,
                                               const std::vector<std::string>& names) {
  const auto name = text(key);
  if (!name) return std::nullopt;
  const auto found = std::ranges::find(names, *name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  fault(key, "there is no '" + *name + "'", name_remedy(*name, names, "possible"), "scene.choice");
  return std::nullopt;
}

std::vector<const Value*> TableReader::tables(const std::string& key) {
  const Value* value = find(key);
  std::vector<const Value*> found;
  if (!value) return found;
  constexpr std::size_t kMaxTables = 10000;  // names are compared pairwise
  if (value->items.size() > kMaxTables) {
    fault(key, "has " + std::to_string(value->items.size()) + " tables", "give at most 10000",
          "scene.too-many");
    return found;
  }
  for (const Value& item : value->items)
    if (item.kind == Value::Kind::table) found.push_back(&item);
  if (value->kind != Value::Kind::list || found.size() != value->items.size())
    fault(key, "must be a list of tables, is " + describe(*value),
          "write [[" + key + "]] with two brackets", "scene.type");
  return found;
}

std::string TableReader::where(const std::string& key) const {
  if (key.empty()) return where_;
  return place_ ? place_->before + key + place_->after : where_ + ", " + key;
}

void TableReader::fault(const std::string& key, std::string problem, std::string fix,
                        std::string_view code) {
  const Value* value = table_.find(key);
  faults_.add({file_, value ? value->line : table_.line, where(key), std::move(problem),
               std::move(fix), code});
}

void TableReader::done() {
  for (const Value& member : table_.members)
    if (!faults_.is_full() && std::ranges::find(known_, member.key) == known_.end())
      fault(member.key, "unknown key", name_remedy(member.key, known_, "keys"),
            "scene.unknown-key");
}

}  // namespace twinarm
