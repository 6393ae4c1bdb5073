// A tree of values from a TOML or JSON file, with line numbers for diagnostics, or made in code.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace twinarm {

class StateArchive;

struct Value {
  // table: a JSON object; date: a TOML date or time.
  enum class Kind { null, boolean, number, text, list, table, date };
  Kind kind = Kind::table;
  std::string key{};  // of a member of a table
  int line = 0;       // of the key or the opening bracket
  double number = 0;  // boolean: 0 or 1
  std::string text{};
  std::vector<Value> items{}, members{};  // of a list, of a table in the order of its keys

  static Value of(double number) { return {.kind = Kind::number, .number = number}; }
  static Value of(std::string text) { return {.kind = Kind::text, .text = std::move(text)}; }
  static Value flag(bool on) { return {.kind = Kind::boolean, .number = on ? 1.0 : 0.0}; }
  static Value list(std::vector<Value> items) {
    return {.kind = Kind::list, .items = std::move(items)};
  }
  template <class Numbers>
  static Value numbers(const Numbers& all) {  // a list
    Value made = list({});
    for (const double number : all) made.items.push_back(of(number));
    return made;
  }
  static Value table(std::initializer_list<std::pair<const char*, Value>> members) {
    Value made;
    for (const auto& [name, value] : members) made.put(name, value);
    return made;
  }

  bool is_number() const { return kind == Kind::number; }
  bool is_text() const { return kind == Kind::text; }
  bool is_list() const { return kind == Kind::list; }
  bool is_table() const { return kind == Kind::table; }

  const Value* find(const std::string& name) const;  // a member, or nullptr
  Value* find(const std::string& name) {
    return const_cast<Value*>(std::as_const(*this).find(name));
  }
  // Replaces or adds the member.
  Value& put(const std::string& name, Value value);
};
// "a list of 3", "the text 'box'", ..: for messages.
std::string describe(const Value& value);

// For the transfer between processes. Throws std::runtime_error if it is not a packed value.
void serialize(StateArchive& archive, Value& value);

// Throw InputError if the file cannot be read, is invalid, or has a key twice.
Value read_toml(const std::filesystem::path& file);
Value read_json(const std::filesystem::path& file);
// `name`: of the text in diagnostics.
Value parse_json(const std::string& json, const std::string& name);

// Without comments; numbers in the fewest digits that read back the same. Lists of tables become
// [[key]], other tables one line.
std::string to_toml(const Value& root);

// Makes file names relative to `folder` absolute, for a copy of the scene elsewhere.
void name_files_from_root(const std::filesystem::path& folder, Value& scene);

}  // namespace twinarm
