#include "app/data/toml_text.h"

#include <algorithm>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

std::string quoted_toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    constexpr const char* kHex = "0123456789abcdef";
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += std::string("\\") + c;
    else if (code < 0x20 || code == 0x7f)
      quoted += std::string("\\u00") + kHex[code >> 4] + kHex[code & 15];
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string toml_key(const std::string& key) {
  const auto is_bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
  return bare ? key : quoted_toml(key);
}

std::string inline_toml(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::boolean:
      return value.number != 0 ? "true" : "false";
    case TomlValue::Kind::number: {
      std::string digits = number_text(value.number);  // "1e+20" is TOML too
      const bool whole = digits.find_first_of(".einf") == std::string::npos;
      return whole ? digits + ".0" : digits;
    }
    case TomlValue::Kind::list: {
      std::string text;
      for (const TomlValue& item : value.items)
        text += (text.empty() ? "" : ", ") + inline_toml(item);
      return "[" + text + "]";
    }
    case TomlValue::Kind::table: {
      std::string text;
      for (const TomlValue& m : value.members)
        text += (text.empty() ? "" : ", ") + toml_key(m.key) + " = " + inline_toml(m);
      return "{ " + text + " }";
    }
    case TomlValue::Kind::text:
    case TomlValue::Kind::other:
      break;
  }
  return quoted_toml(value.text);
}

bool is_array_of_tables(const TomlValue& value) {
  return value.kind == TomlValue::Kind::list && !value.items.empty() &&
         std::all_of(value.items.begin(), value.items.end(),
                     [](const TomlValue& v) { return v.kind == TomlValue::Kind::table; });
}

}  // namespace

std::string to_toml(const TomlValue& root) {
  std::string text;
  for (const TomlValue& member : root.members)
    if (!is_array_of_tables(member))
      text += toml_key(member.key) + " = " + inline_toml(member) + "\n";
  for (const TomlValue& member : root.members) {
    if (!is_array_of_tables(member)) continue;
    for (const TomlValue& table : member.items) {
      text += "\n[[" + toml_key(member.key) + "]]\n";
      for (const TomlValue& m : table.members)
        text += toml_key(m.key) + " = " + inline_toml(m) + "\n";
    }
  }
  return text;
}

void name_files_from_root(const std::filesystem::path& folder, TomlValue& scene) {
  std::error_code ignored;
  if (scene.kind == TomlValue::Kind::text && !scene.text.empty() &&
      std::filesystem::is_regular_file(folder / scene.text, ignored))
    scene.text = std::filesystem::absolute(folder / scene.text).lexically_normal().string();
  for (TomlValue& item : scene.items) name_files_from_root(folder, item);
  for (TomlValue& member : scene.members) name_files_from_root(folder, member);
}

}  // namespace twinarm
