// A tree of values, of a TOML or a JSON file or made in code; of a file each value has its line, so
// that faults can say where it stands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace twinarm {

struct Value {
  // table: in JSON an object; date: in TOML a date or a time.
  enum class Kind { null, boolean, number, text, list, table, date };
  Kind kind = Kind::table;
  std::string key;    // of a member of a table
  int line = 0;       // of the key, or of the bracket that opens it
  double number = 0;  // of a boolean 0 or 1
  std::string text;
  std::vector<Value> items, members;  // of a list, of a table in the order of its keys

  static Value of(double number);
  static Value of(std::string text);
  static Value list(std::vector<Value> items);

  bool is_number() const { return kind == Kind::number; }
  bool is_text() const { return kind == Kind::text; }
  bool is_list() const { return kind == Kind::list; }
  bool is_table() const { return kind == Kind::table; }

  const Value* find(const std::string& name) const;  // a member; nullptr where there is none
  Value* find(const std::string& name);
  // In place of the member of that name, or as one more.
  Value& put(const std::string& name, Value value);
};
// "a list of 3", "the text 'box'", ...: what stands there, for messages.
std::string describe(const Value& value);

// Throw InputError where the file cannot be read, is not of its format, or has a key twice.
Value read_toml(const std::filesystem::path& file);
Value read_json(const std::filesystem::path& file);
// Of a text; faults call it `name`.
Value parse_json(const std::string& json, const std::string& name);

// Comments are gone; numbers are written in the fewest digits that read back as they were. Tables
// of lists stand under [[key]], all other tables in one line.
std::string to_toml(const Value& root);

// Files that a scene in `folder` names relative to it are named from the root: a copy of the scene
// may lie elsewhere.
void name_files_from_root(const std::filesystem::path& folder, Value& scene);

}  // namespace twinarm
