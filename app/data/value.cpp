#include "app/data/value.h"

#include <utility>

#include "solver/support/number_text.h"

namespace twinarm {

Value Value::of(double number) {
  Value value;
  value.kind = Kind::number;
  value.number = number;
  return value;
}

Value Value::of(std::string text) {
  Value value;
  value.kind = Kind::text;
  value.text = std::move(text);
  return value;
}

Value Value::list(std::vector<Value> items) {
  Value value;
  value.kind = Kind::list;
  value.items = std::move(items);
  return value;
}

const Value* Value::find(const std::string& name) const {
  for (const Value& member : members)
    if (member.key == name) return &member;
  return nullptr;
}

Value* Value::find(const std::string& name) {
  return const_cast<Value*>(std::as_const(*this).find(name));
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

}  // namespace twinarm
