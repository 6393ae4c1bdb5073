#include "app/data/value.h"

#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "solver/support/diagnostics.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

// Counts lines.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at;
  int* line;
  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    if (*at++ == '\n') ++*line;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at == other.at; }
};

// Builds a tree from the parser's events.
class TreeBuilder : public nlohmann::json_sax<nlohmann::ordered_json> {
 public:
  TreeBuilder(const std::filesystem::path& file, const int& line)
      : file_(file.string()), line_(line) {}

  bool null() override { return add({.kind = Value::Kind::null}); }
  bool boolean(bool value) override { return add(Value::flag(value)); }
  bool number_integer(std::int64_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) override { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) override { return number(value); }
  bool string(std::string& value) override { return add(Value::of(std::move(value))); }
  bool binary(nlohmann::ordered_json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Value::Kind::table); }
  bool start_array(std::size_t) override { return open(Value::Kind::list); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& name) override {
    value_line_ = line_;
    if (!open_.back().seen.insert(name).second)
      faults.add({file_, line_, name, "is given twice", "leave one of them out", "json.twice"});
    open_.back().key = name;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) override {
    // "[json.exception.parse_error.101] parse error at line 3, column 7: syntax error ..."
    std::string what = e.what();
    if (const auto colon = what.find(": "); colon != std::string::npos) what.erase(0, colon + 2);
    faults.add({file_, line_, "", "is not JSON: " + what, "correct it; python3 -m json.tool helps",
                "json.form"});
    return false;
  }

  Value root;
  DiagnosticList faults;

 private:
  bool number(double value) { return add(Value::of(value)); }
  bool add(Value item) {
    if (item.line == 0) item.line = value_line_;
    if (open_.empty()) {
      root = std::move(item);
      return true;
    }
    Open& around = open_.back();
    item.key = around.key;
    (around.value.is_table() ? around.value.members : around.value.items)
        .push_back(std::move(item));
    return true;
  }
  bool open(Value::Kind kind) {
    constexpr std::size_t kMaxDepth = 64;
    if (open_.size() > kMaxDepth) {
      faults.add({file_, line_, "", "is nested too deeply", "a state file has at most four levels",
                  "json.too-deep"});
      return false;
    }
    value_line_ = line_;
    Open& opened = open_.emplace_back();
    opened.value.kind = kind;
    opened.value.line = line_;
    return true;
  }
  bool close() {
    Value item = std::move(open_.back().value);
    open_.pop_back();
    return add(std::move(item));
  }

  struct Open {
    Value value;
    std::string key;                       // of the next value
    std::unordered_set<std::string> seen;  // all keys
  };
  std::string file_;
  const int& line_;
  int value_line_ = 1;
  std::vector<Open> open_;  // open objects and lists
};

// Replaces NaN and Infinity, which some programs write, by null, so that parsing continues and all
// errors are reported.
std::string without_nan(const std::string& text) {
  std::string out;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (quoted && text[i] == '\\' && i + 1 < text.size()) {
      out += text[i++];
      out += text[i];
      continue;
    }
    bool replaced = false;
    for (const std::string_view word : {"-Infinity", "Infinity", "-NaN", "NaN", "-nan", "nan"}) {
      if (quoted || replaced || text.compare(i, word.size(), word) != 0) continue;
      out += "null";
      i += word.size() - 1;
      replaced = true;
    }
    if (!replaced) out += text[i];
  }
  return out;
}

}  // namespace

Value read_json(const std::filesystem::path& file) {
  const char* const fix = "name a state file: a few numbers for each joint";
  return parse_json(read_bounded_file(file, 4, fix), file.string());
}

Value parse_json(const std::string& json, const std::string& name) {
  const std::string text = without_nan(json);
  int line = 1;
  TreeBuilder tree(name, line);
  nlohmann::ordered_json::sax_parse(CountingIterator{text.data(), &line},
                                    CountingIterator{text.data() + text.size(), &line}, &tree);
  tree.faults.check();
  return std::move(tree.root);
}

}  // namespace twinarm
