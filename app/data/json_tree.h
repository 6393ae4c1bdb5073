// A JSON file read into memory, each value with its line, so that faults can say where they stand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace twinarm {

struct JsonValue {
  enum class Kind { null, boolean, number, text, list, object };
  Kind kind = Kind::null;
  std::string key;    // of a member of an object
  int line = 0;       // of the key, or of the bracket that opens it
  double number = 0;  // also of a boolean
  std::string text;
  std::vector<JsonValue> items, members;  // of a list, of an object

  const JsonValue* find(const std::string& name) const;
};
// "a list of 3", "text", ...: what stands there, for messages.
std::string describe(const JsonValue& value);

// Throws InputError where the file cannot be read, is not JSON, or has a key twice.
JsonValue read_json(const std::filesystem::path& file);
// The same of a text; faults call it `name`.
JsonValue parse_json(const std::string& json, const std::string& name);

}  // namespace twinarm
