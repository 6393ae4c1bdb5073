#include "collision/import/recipe/recipe_toml.h"

#include <algorithm>
#include <cmath>

namespace twinarm {

void TomlSource::only_keys(const toml::table& table, const std::string& where,
                           std::initializer_list<std::string_view> keys) {
  std::string known;
  for (const std::string_view key : keys) known += (known.empty() ? "" : ", ") + std::string(key);
  for (const auto& [key, node] : table)
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
      fault(line_of(node), where, "key '" + std::string(key.str()) + "' is not known",
            "keys here: " + known);
}

double TomlSource::number(const toml::table& table, std::string_view key, const std::string& where,
                          std::optional<double> fallback) {
  const toml::node* node = table.get(key);
  if (!node) {
    if (!fallback)
      fault(line_of(table), where, "'" + std::string(key) + "' is missing", "give a number");
    return fallback.value_or(1.0);
  }
  const std::optional<double> value = node->value<double>();
  if (value && std::isfinite(*value)) return *value;
  fault(line_of(*node), where, "'" + std::string(key) + "' must be a finite number",
        "give a number in SI units");
  return fallback.value_or(1.0);
}

std::string TomlSource::text(const toml::table& table, std::string_view key,
                             const std::string& where, std::optional<std::string> fallback) {
  const toml::node* node = table.get(key);
  if (!node && fallback) return *fallback;
  const std::string value = node ? node->value_or(std::string()) : std::string();
  if (value.empty())
    fault(line_of(node ? *node : table), where,
          "'" + std::string(key) + (node ? "' must be a text that is not empty" : "' is missing"),
          "give " + std::string(key) + " = \"...\"");
  return value;
}

std::optional<std::vector<double>> TomlSource::numbers(const toml::table& table,
                                                       std::string_view key,
                                                       const std::string& where,
                                                       std::size_t count) {
  const toml::node* node = table.get(key);
  std::vector<double> values;
  if (const toml::array* array = node ? node->as_array() : nullptr)
    for (const toml::node& item : *array)
      if (const auto value = item.value<double>(); value && std::isfinite(*value))
        values.push_back(*value);
  const toml::array* array = node ? node->as_array() : nullptr;
  if (array && array->size() == count && values.size() == count) return values;
  fault(line_of(node ? *node : table), where,
        "'" + std::string(key) + "' must be " + std::to_string(count) + " finite numbers",
        "give " + std::string(key) + " = [ ... ]");
  return std::nullopt;
}

std::optional<Vector3> TomlSource::vector3(const toml::table& table, std::string_view key,
                                           const std::string& where) {
  const auto values = numbers(table, key, where, 3);
  if (!values) return std::nullopt;
  return Vector3((*values)[0], (*values)[1], (*values)[2]);
}

std::vector<std::string> TomlSource::texts(const toml::table& table, std::string_view key,
                                           const std::string& where) {
  const toml::node* node = table.get(key);
  const toml::array* array = node ? node->as_array() : nullptr;
  std::vector<std::string> values;
  if (array)
    for (const toml::node& item : *array)
      if (const auto value = item.value<std::string>()) values.push_back(*value);
  if (!array || values.empty() || values.size() != array->size())
    fault(line_of(node ? *node : table), where,
          "'" + std::string(key) + "' must be a list of names",
          "give " + std::string(key) + " = [\"...\"]");
  return values;
}

std::vector<const toml::table*> TomlSource::tables(const toml::table& table, std::string_view key,
                                                   const std::string& where) {
  const toml::node* node = table.get(key);
  if (!node) return {};
  const toml::array* array = node->as_array();
  std::vector<const toml::table*> result;
  if (array)
    for (const toml::node& item : *array)
      if (item.is_table()) result.push_back(item.as_table());
  if (!array || result.size() != array->size())
    fault(line_of(*node), where, "'" + std::string(key) + "' must be a list of tables",
          "write [[" + std::string(key) + "]] with two brackets");
  return result;
}

const toml::table* TomlSource::table(const toml::table& parent, std::string_view key,
                                     const std::string& where) {
  const toml::node* node = parent.get(key);
  if (node && !node->is_table())
    fault(line_of(*node), where, "'" + std::string(key) + "' must be a table",
          "write [" + std::string(key) + "]");
  return node ? node->as_table() : nullptr;
}

}  // namespace twinarm
