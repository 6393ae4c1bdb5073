// Writes one JSON object as text, in the order of the calls.
//
// Numbers have the fewest digits (at most 17) that read back as the same double, and a point or an
// exponent; non-finite numbers become null.
//
//   json.object({{"name", row.name}, {"work", row.work}});          {"name": "a", "work": 0.5}
//   json.list(rows, [&](const Row& row) { json.vector(row.p); });   [[1.0, 2.0], [..]]
//   json.key("rows").object([&] { for (..) json.put(row.name, row.work); });
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace twinarm {

class JsonWriter {
 public:
  // A key and a reference to its value; only for arguments of object() and members().
  struct Member {
    template <class T>
    Member(std::string_view name, const T& value)
        : key(name), what(&value), write([](JsonWriter& json, const void* one) {
            json.value(*static_cast<const T*>(one));
          }) {}
    std::string_view key;
    const void* what;
    void (*write)(JsonWriter& json, const void* what);
  };
  using Members = std::initializer_list<Member>;

  JsonWriter& key(std::string_view name);
  void begin_object() { open('{'); }
  void end_object() { close('}'); }
  void begin_array() { open('['); }
  void end_array() { close(']'); }

  void object(Members all) {
    begin_object();
    members(all);
    end_object();
  }
  // `write` writes the members.
  template <class Write>
  void object(const Write& write) {
    begin_object();
    write();
    end_object();
  }
  // Of the open object.
  void members(Members all) {
    for (const Member& member : all) member.write(key(member.key), member.what);
  }
  template <class T>
  void put(std::string_view name, const T& what) {
    key(name).value(what);
  }
  // `write` writes one value for each item.
  template <class Range, class Write>
  void list(const Range& range, const Write& write) {
    begin_array();
    for (const auto& item : range) write(item);
    end_array();
  }

  // A number, boolean or text; null for an empty optional; a list for a range or vector, a list of
  // rows for a matrix; a function writes one value itself.
  template <class T>
  void value(const T& what) {
    if constexpr (std::is_same_v<T, bool>)
      boolean(what);
    else if constexpr (std::is_integral_v<T>)
      count(static_cast<long>(what));
    else if constexpr (std::is_arithmetic_v<T>)
      number(what);
    else if constexpr (std::is_convertible_v<const T&, std::string_view>)
      text(what);
    else if constexpr (std::is_invocable_v<const T&>)
      what();
    else if constexpr (requires { what.has_value(); })
      what ? value(*what) : null();
    else if constexpr (!std::is_base_of_v<Eigen::EigenBase<T>, T>)
      list(what, [&](const auto& item) { value(item); });
    else if constexpr (T::IsVectorAtCompileTime)
      vector(what);
    else
      matrix(what);
  }

  void number(double value);
  void count(long value) { write(std::to_string(value)); }
  void text(std::string_view value);
  void boolean(bool value) { write(value ? "true" : "false"); }
  void null() { write("null"); }

  template <class Derived>
  void matrix(const Eigen::MatrixBase<Derived>& values) {
    begin_array();
    for (Eigen::Index i = 0; i < values.rows(); ++i) vector(values.row(i));
    end_array();
  }
  template <class Derived>
  void vector(const Eigen::MatrixBase<Derived>& values) {
    begin_array();
    for (Eigen::Index i = 0; i < values.size(); ++i) number(values(i));
    end_array();
  }
  void numbers(const std::vector<double>& values) { value(values); }
  void texts(const std::vector<std::string>& values) { value(values); }
  // A number if there is one, else a list.
  void number_or_list(const std::vector<double>& values);

  // `write` writes the value if there is one; else null.
  template <class T, class Write>
  void or_null(const std::optional<T>& what, const Write& write) {
    what ? static_cast<void>(write(*what)) : null();
  }

  const std::string& str() const { return text_; }
  // The text so far, without which writing goes on: for output in parts.
  std::string take() { return std::exchange(text_, {}); }

 private:
  void open(char bracket);
  void close(char bracket);
  void separate();  // comma before all but the first item
  void write(std::string_view item);

  std::string text_;
  int depth_ = 0;
  bool first_ = true;  // directly after an opening bracket
  bool keyed_ = false;
};

// One object as text, from a function that writes its members.
template <class Write>
std::string json_text(const Write& write) {
  JsonWriter json;
  json.object([&] { write(json); });
  return json.str();
}

// Version of what --json prints (docs/reference/json_output.schema.json). A key that is removed,
// renamed or changes its meaning raises it; a new one does not.
inline constexpr int kJsonSchema = 1;

// What --json prints: the version, and the members or what a function writes.
template <class Write>
std::string answer_text(const Write& write) {
  return json_text([&](JsonWriter& json) {
    json.put("schema", kJsonSchema);
    write(json);
  });
}
inline std::string answer_text(JsonWriter::Members members) {
  return answer_text([&](JsonWriter& json) { json.members(members); });
}

}  // namespace twinarm
