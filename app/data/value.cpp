#include "app/data/value.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "collision/import/toml/toml_file.h"
#include "collision/sandbox/isolated_parser.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {

const Value* Value::find(const std::string& name) const {
  for (const Value& member : members)
    if (member.key == name) return &member;
  return nullptr;
}

Value& Value::put(const std::string& name, Value value) {
  Value* found = find(name);
  Value& place = found ? *found : members.emplace_back();
  value.key = name;
  return place = std::move(value);
}

std::string describe(const Value& value) {
  switch (value.kind) {
    case Value::Kind::null:
      return "null, or not finite";
    case Value::Kind::boolean:
      return value.number != 0 ? "true" : "false";
    case Value::Kind::number:
      return number_text(value.number);
    case Value::Kind::text:
      return "the text '" + value.text + "'";
    case Value::Kind::list:
      return "a list of " + std::to_string(value.items.size());
    case Value::Kind::table:
      return "a table";
    case Value::Kind::date:
      break;
  }
  return "a date or time";
}

void name_files_from_root(const std::filesystem::path& folder, Value& scene) {
  std::error_code ignored;
  if (scene.is_text() && !scene.text.empty() &&
      std::filesystem::is_regular_file(folder / scene.text, ignored))
    scene.text = std::filesystem::absolute(folder / scene.text).lexically_normal().string();
  for (Value& item : scene.items) name_files_from_root(folder, item);
  for (Value& member : scene.members) name_files_from_root(folder, member);
}

namespace {

Value value_of_node(const toml::node& node) {
  Value value;
  value.line = static_cast<int>(node.source().begin.line);
  value.kind = Value::Kind::date;
  if (const toml::table* table = node.as_table()) {
    value.kind = Value::Kind::table;
    for (const auto& [key, member] : *table) {
      value.members.push_back(value_of_node(member));
      value.members.back().key = std::string(key.str());
    }
    // toml++ sorts keys by name; diagnostics are in the order of the file.
    std::ranges::stable_sort(value.members, {}, &Value::line);
  } else if (const toml::array* array = node.as_array()) {
    value.kind = Value::Kind::list;
    for (const toml::node& item : *array) value.items.push_back(value_of_node(item));
  } else if (node.is_boolean()) {
    value.kind = Value::Kind::boolean;
    value.number = node.value_or(false) ? 1 : 0;
  } else if (node.is_number()) {
    value.kind = Value::Kind::number;
    value.number = node.value_or(0.0);
  } else if (node.is_string()) {
    value.kind = Value::Kind::text;
    value.text = node.value_or(std::string());
  }
  return value;
}

std::string quoted_toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += std::string("\\") + c;
    else if (code < 0x20 || code == 0x7f)
      quoted += fmt::format("\\u{:04x}", code);
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string toml_key(const std::string& key) {
  const auto is_bare = [](unsigned char c) {
    return (c < 0x80 && std::isalnum(c)) || c == '_' || c == '-';
  };
  return !key.empty() && std::ranges::all_of(key, is_bare) ? key : quoted_toml(key);
}

std::string inline_toml(const Value& value) {
  switch (value.kind) {
    case Value::Kind::boolean:
      return value.number != 0 ? "true" : "false";
    case Value::Kind::number: {
      std::string digits = number_text(value.number);  // "1e+20" is valid TOML
      const bool whole = digits.find_first_of(".einf") == std::string::npos;
      return whole ? digits + ".0" : digits;
    }
    case Value::Kind::list: {
      std::string text;
      for (const Value& item : value.items) text += (text.empty() ? "" : ", ") + inline_toml(item);
      return "[" + text + "]";
    }
    case Value::Kind::table: {
      std::string text;
      for (const Value& m : value.members)
        text += (text.empty() ? "" : ", ") + toml_key(m.key) + " = " + inline_toml(m);
      return "{ " + text + " }";
    }
    case Value::Kind::null:
    case Value::Kind::text:
    case Value::Kind::date:
      break;
  }
  return quoted_toml(value.text);
}

bool is_array_of_tables(const Value& value) {
  return value.is_list() && !value.items.empty() &&
         std::ranges::all_of(value.items, [](const Value& v) { return v.is_table(); });
}

void visit(StateArchive& archive, Value& value, std::size_t depth) {
  archive.visit(value.kind, value.key, value.line, value.number, value.text);
  if (depth > 2 * kMaxTomlDepth || value.kind > Value::Kind::date)
    throw std::runtime_error("not a packed value");
  constexpr std::size_t kMinBytes = 40;  // of the fields above
  for (std::vector<Value>* part : {&value.items, &value.members}) {
    archive.resize(*part, kMinBytes);
    for (Value& each : *part) visit(archive, each, depth + 1);
  }
}

Value parse_toml(const std::string& file, const std::string&) {
  const std::string text = read_toml_text(file);
  try {
    return value_of_node(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    throw InputError({{file, static_cast<int>(error.source().begin.line), "",
                       "not well-formed TOML: " + std::string(error.description()),
                       "correct this line", "file.toml"}});
  }
}

}  // namespace

std::string to_toml(const Value& root) {
  std::string text;
  for (const Value& member : root.members)
    if (!is_array_of_tables(member))
      text += toml_key(member.key) + " = " + inline_toml(member) + "\n";
  for (const Value& member : root.members) {
    if (!is_array_of_tables(member)) continue;
    for (const Value& table : member.items) {
      text += "\n[[" + toml_key(member.key) + "]]\n";
      for (const Value& m : table.members) text += toml_key(m.key) + " = " + inline_toml(m) + "\n";
    }
  }
  return text;
}

void serialize(StateArchive& archive, Value& value) {
  visit(archive, value, 0);
}

Value read_toml(const std::filesystem::path& file) {
  return parse<parse_toml>(file.string());
}

}  // namespace twinarm
