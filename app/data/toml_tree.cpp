#include "app/data/toml_tree.h"

#include <toml++/toml.h>

#include <algorithm>
#include <utility>

#include "collision/import/toml/toml_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

TomlValue value_of(const toml::node& node) {
  TomlValue value;
  value.line = static_cast<int>(node.source().begin.line);
  value.kind = TomlValue::Kind::other;
  if (const toml::table* table = node.as_table()) {
    value.kind = TomlValue::Kind::table;
    for (const auto& [key, member] : *table) {
      value.members.push_back(value_of(member));
      value.members.back().key = std::string(key.str());
    }
    // toml++ sorts keys by name; faults are told in the order of the file.
    std::stable_sort(value.members.begin(), value.members.end(),
                     [](const TomlValue& a, const TomlValue& b) { return a.line < b.line; });
  } else if (const toml::array* array = node.as_array()) {
    value.kind = TomlValue::Kind::list;
    for (const toml::node& item : *array) value.items.push_back(value_of(item));
  } else if (node.is_boolean()) {
    value.kind = TomlValue::Kind::boolean;
    value.number = node.value_or(false) ? 1 : 0;
  } else if (node.is_number()) {
    value.kind = TomlValue::Kind::number;
    value.number = node.value_or(0.0);
  } else if (node.is_string()) {
    value.kind = TomlValue::Kind::text;
    value.text = node.value_or(std::string());
  }
  return value;
}

}  // namespace

const TomlValue* TomlValue::find(const std::string& name) const {
  for (const TomlValue& member : members)
    if (member.key == name) return &member;
  return nullptr;
}

TomlValue* TomlValue::find(const std::string& name) {
  return const_cast<TomlValue*>(std::as_const(*this).find(name));
}

std::string describe(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::boolean:
      return value.number != 0 ? "true" : "false";
    case TomlValue::Kind::number:
      return number_text(value.number);
    case TomlValue::Kind::text:
      return "the text '" + value.text + "'";
    case TomlValue::Kind::list:
      return "a list of " + std::to_string(value.items.size());
    case TomlValue::Kind::table:
      return "a table";
    case TomlValue::Kind::other:
      break;
  }
  return "a date or time";
}

TomlValue read_toml(const std::filesystem::path& file) {
  const std::string text = read_toml_text(file);
  try {
    return value_of(toml::parse(text, file.string()));
  } catch (const toml::parse_error& error) {
    throw InputError({{file.string(), static_cast<int>(error.source().begin.line), "",
                       "not well-formed TOML: " + std::string(error.description()),
                       "mend this line", "file.toml"}});
  }
}

}  // namespace twinarm
