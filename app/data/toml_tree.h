// A TOML file read into memory, each value with its line, so that faults can say where they stand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace twinarm {

struct TomlValue {
  enum class Kind { boolean, number, text, list, table, other };  // other: dates and times
  Kind kind = Kind::table;
  std::string key;  // of a member of a table
  int line = 0;
  double number = 0;  // of a boolean 0 or 1
  std::string text;
  std::vector<TomlValue> items, members;  // of a list, of a table in the order of its keys

  const TomlValue* find(const std::string& name) const;
  TomlValue* find(const std::string& name);
};
// "a list of 3", "the text 'box'", ...: what stands there, for messages.
std::string describe(const TomlValue& value);

// Throws InputError where the file cannot be read or is not TOML.
TomlValue read_toml(const std::filesystem::path& file);

}  // namespace twinarm
