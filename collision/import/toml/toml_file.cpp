#include "collision/import/toml/toml_file.h"

#include <string_view>
#include <utility>
#include <vector>

#include "solver/support/diagnostics.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

// Measures the nesting depth of brackets and dotted keys. Does not validate TOML.
class DepthScan {
 public:
  explicit DepthScan(std::string_view text) : text_(text) {}

  // First line nested too deep, or 0.
  int line_too_deep() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') end_line();
      if (c == '#') at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      if (c == '"' || c == '\'') pass_string(c);
      if (c == '.') ++dots_;
      if (c == ',') dots_ = 0;
      if (c == '[' || c == '{') open();
      if (c == ']' || c == '}') close();
      if (below_ + dots_ > kMaxTomlDepth) return line_;
    }
    return 0;
  }

 private:
  void end_line() {
    ++line_;
    if (open_.empty()) dots_ = 0;
  }
  // The key of a bracket counts inside it.
  void open() {
    open_.push_back(std::exchange(dots_, 0));
    below_ += open_.back() + 1;
  }
  void close() {
    if (open_.empty()) return;
    dots_ = open_.back();
    below_ -= dots_ + 1;
    open_.pop_back();
  }
  void pass_string(char quote) {
    const std::string three(3, quote);
    const bool is_long = text_.substr(at_, 3) == three;
    const std::string_view end =
        is_long ? std::string_view(three) : std::string_view(three).substr(2);
    for (at_ += end.size(); at_ < text_.size(); ++at_) {
      if (text_.substr(at_, end.size()) == end) break;
      if (text_[at_] == '\\' && quote == '"') ++at_;
      if (at_ < text_.size() && text_[at_] == '\n') {
        ++line_;
        if (!is_long) return;
      }
    }
    at_ += end.size() - 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::size_t dots_ = 0, below_ = 0;  // of the current key; of all enclosing brackets
  std::vector<std::size_t> open_;
};

}  // namespace

std::string read_toml_text(const std::filesystem::path& file) {
  std::string read = read_bounded_file(file, 4, "store meshes and traces in separate files");
  if (const int line = DepthScan(read).line_too_deep(); line > 0)
    throw InputError({{file.string(), line, "", "TOML nesting depth exceeds 200",
                       "remove the nested keys or brackets", "toml.too-deep"}});
  return read;
}

}  // namespace twinarm
