#include "solver/expressions/expression_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace twinarm {
namespace {

using Id = ExpressionGraph::Id;

// A term and its dimension. None: of numbers without unit, and what they were multiplied by.
struct Term {
  Id id = 0;
  std::optional<Dimension> dimension;
};

constexpr std::pair<std::string_view, Operation> kFunctions[] = {
    {"sqrt", Operation::square_root},
    {"sin", Operation::sine},
    {"cos", Operation::cosine},
    {"tan", Operation::tangent},
    {"exp", Operation::exponential},
    {"log", Operation::logarithm},
    {"tanh", Operation::hyperbolic_tangent}};
constexpr std::string_view kOtherFunctions[] = {"abs", "atan2", "min", "max", "if"};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

class ExpressionParser {
 public:
  ExpressionParser(ExpressionGraph& graph, std::string_view text,
                   std::span<const ExpressionSymbol> symbols)
      : graph_(graph), text_(text), symbols_(symbols) {}

  Id parse(std::optional<Dimension> wanted) {
    if (text_.size() > kMaxFormulaLength)
      fail(kMaxFormulaLength,
           "formula has more than " + std::to_string(kMaxFormulaLength) + " characters");
    const Term term = sum();
    if (at_ < text_.size()) fail(at_, "unexpected '" + std::string(1, text_[at_]) + "'");
    if (wanted && term.dimension && *term.dimension != *wanted)
      fail(0, "value is in " + term.dimension->text() + ", must be in " + wanted->text());
    return term.id;
  }

 private:
  [[noreturn]] static void fail(std::size_t at, const std::string& message) {
    throw ExpressionError(at, message);
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool accept(std::string_view sign) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }
  void expect(std::string_view sign) {
    if (accept(sign)) return;
    const std::string found =
        at_ < text_.size() ? "'" + std::string(1, text_[at_]) + "'" : "the end";
    fail(at_, "found " + found + ", expected '" + std::string(sign) + "'");
  }

  // The common dimension of terms that are added or compared.
  std::optional<Dimension> common(const Term& a, const Term& b, std::size_t at) const {
    if (a.dimension && b.dimension && *a.dimension != *b.dimension)
      fail(at,
           a.dimension->text() + " and " + b.dimension->text() + " cannot be added or compared");
    return a.dimension ? a.dimension : b.dimension;
  }

  Term sum() {
    Term left = product();
    while (true) {
      skip_blanks();
      const std::size_t at = at_;
      const bool minus = accept("-");
      if (!minus && !accept("+")) return left;
      const Term right = product();
      left = {minus ? graph_.subtract(left.id, right.id) : graph_.add(left.id, right.id),
              common(left, right, at)};
    }
  }

  Term product() {
    Term left = signed_power();
    while (true) {
      const bool divides = accept("/");
      if (!divides && !accept("*")) return left;
      const Term right = signed_power();
      std::optional<Dimension> dimension;
      if (left.dimension && right.dimension)
        dimension =
            divides ? *left.dimension / *right.dimension : *left.dimension * *right.dimension;
      left = {divides ? graph_.divide(left.id, right.id) : graph_.multiply(left.id, right.id),
              dimension};
    }
  }

  Term signed_power() {
    const Nesting nesting(*this);
    if (accept("-")) {
      const Term term = signed_power();
      return {graph_.negate(term.id), term.dimension};
    }
    Term base = primary();
    if (!accept("^")) return base;
    skip_blanks();
    const std::size_t at = at_;
    const Term exponent = signed_power();
    if (!graph_.is_constant(exponent.id)) fail(at, "exponent must be a number");
    const double power = graph_.node(exponent.id).value;
    return {graph_.power(base.id, power), raised(base, power, at)};
  }

  static std::optional<Dimension> raised(const Term& base, double power, std::size_t at) {
    if (!base.dimension) return std::nullopt;
    const auto dimension = base.dimension->to_the(power);
    if (!dimension) fail(at, "power of " + base.dimension->text() + " has no unit");
    return dimension;
  }

  Term primary() {
    skip_blanks();
    const std::size_t at = at_;
    if (at == text_.size()) fail(at, "found the end, expected a number or a name");
    if (accept("(")) {
      const Term inner = sum();
      expect(")");
      return inner;
    }
    if (is_digit(text_[at]) || text_[at] == '.') return number();
    if (!is_letter(text_[at])) fail(at, "unexpected '" + std::string(1, text_[at]) + "'");
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view name = text_.substr(at, at_ - at);
    if (const ExpressionSymbol* symbol = symbol_at(at, name))
      return {graph_.symbol(symbol->name), symbol->dimension};
    if (name == "pi") return {graph_.constant(std::numbers::pi), Dimension{}};
    return call(name, at);
  }

  // A symbol may have a name in parentheses: q(arm/elbow).
  const ExpressionSymbol* symbol_at(std::size_t at, std::string_view name) {
    const auto find = [&](std::string_view whole) {
      const auto known = std::ranges::find(symbols_, whole, &ExpressionSymbol::name);
      return known == symbols_.end() ? nullptr : &*known;
    };
    const std::size_t close = text_.find(')', at);
    if (at_ < text_.size() && text_[at_] == '(' && close != std::string_view::npos)
      if (const ExpressionSymbol* symbol = find(text_.substr(at, close + 1 - at))) {
        at_ = close + 1;
        return symbol;
      }
    return find(name);
  }

  Term number() {
    double value = 0;
    const char* const first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fail(at_, "not a finite number");
    at_ += static_cast<std::size_t>(end - first);
    if (at_ == text_.size() || text_[at_] != '[') return {graph_.constant(value), std::nullopt};
    const std::size_t start = at_ + 1, close = text_.find(']', start);
    if (close == std::string_view::npos) fail(at_, "unit has no ']'");
    const std::string_view name = text_.substr(start, close - start);
    const auto unit = parse_unit(name);
    if (!unit) fail(start, "unknown unit '" + std::string(name) + "'; give for example N/m or 1/s");
    at_ = close + 1;
    return {graph_.constant(value * unit->size), unit->dimension};
  }

  Term call(std::string_view name, std::size_t at) {
    const auto known =
        std::ranges::find(kFunctions, name, &std::pair<std::string_view, Operation>::first);
    const bool is_known = known != std::end(kFunctions);
    if (!is_known && std::ranges::find(kOtherFunctions, name) == std::end(kOtherFunctions))
      fail(at, "unknown name '" + std::string(name) + "'; known are " + names());
    expect("(");
    const Term result = name == "if" ? choice()
                        : is_known   ? function(known->second, name, at)
                                     : other(name, at);
    expect(")");
    return result;
  }

  Term function(Operation operation, std::string_view name, std::size_t at) {
    const Term x = sum();
    if (operation == Operation::square_root)
      return {graph_.apply(operation, x.id), raised(x, 0.5, at)};
    if (x.dimension && !x.dimension->is_none())
      fail(at, "argument of " + std::string(name) + " is in " + x.dimension->text() +
                   ", must have no unit");
    return {graph_.apply(operation, x.id), Dimension{}};
  }

  Term other(std::string_view name, std::size_t at) {
    const Term a = sum();
    if (name == "abs") return {graph_.absolute(a.id), a.dimension};
    expect(",");
    const Term b = sum();
    const auto dimension = common(a, b, at);
    if (name == "atan2") return {graph_.arctangent(a.id, b.id), Dimension{}};
    return {name == "min" ? graph_.minimum(a.id, b.id) : graph_.maximum(a.id, b.id), dimension};
  }

  // a <= b is not b < a.
  Term choice() {
    const Term a = sum();
    skip_blanks();
    const std::size_t at = at_;
    const bool greater = accept(">");
    if (!greater) expect("<");
    const bool or_equal = accept("=");
    const Term b = sum();
    common(a, b, at);
    expect(",");
    const Term where_true = sum();
    expect(",");
    const Term otherwise = sum();
    const auto dimension = common(where_true, otherwise, at);
    const bool swaps = greater != or_equal;  // compares b < a
    const bool negates = or_equal;
    const Id x = swaps ? b.id : a.id, y = swaps ? a.id : b.id;
    return {negates ? graph_.select(x, y, otherwise.id, where_true.id)
                    : graph_.select(x, y, where_true.id, otherwise.id),
            dimension};
  }

  std::string names() const {
    std::string all;
    for (const ExpressionSymbol& symbol : symbols_) all += symbol.name + ", ";
    for (const auto& [name, operation] : kFunctions) all += std::string(name) + ", ";
    for (const std::string_view name : kOtherFunctions) all += std::string(name) + ", ";
    return all + "pi";
  }

  struct Nesting {
    explicit Nesting(ExpressionParser& of) : parser(of) {
      if (++parser.depth_ > kMaxFormulaDepth)
        fail(parser.at_, "nested more than " + std::to_string(kMaxFormulaDepth) + " deep");
    }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;
    ~Nesting() { --parser.depth_; }
    ExpressionParser& parser;
  };

  ExpressionGraph& graph_;
  std::string_view text_;
  std::span<const ExpressionSymbol> symbols_;
  std::size_t at_ = 0, depth_ = 0;
};

}  // namespace

Id parse_expression(ExpressionGraph& graph, std::string_view text,
                    std::span<const ExpressionSymbol> symbols, std::optional<Dimension> wanted) {
  return ExpressionParser(graph, text, symbols).parse(wanted);
}

}  // namespace twinarm
