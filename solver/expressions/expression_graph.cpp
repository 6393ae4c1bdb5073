#include "solver/expressions/expression_graph.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

using Id = ExpressionGraph::Id;
using enum Operation;

std::size_t segment_of(const ExpressionTable& table, double position) {
  const auto after = std::upper_bound(table.x.begin(), table.x.end(), position);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - table.x.begin(), 1)) - 1;
}

bool is_commutative(Operation operation) {
  return operation == sum || operation == product || operation == smaller || operation == larger;
}

const char* name_of(Operation operation) {
  switch (operation) {
    case square_root:
      return "sqrt";
    case sine:
      return "sin";
    case cosine:
      return "cos";
    case tangent:
      return "tan";
    case exponential:
      return "exp";
    case logarithm:
      return "log";
    case hyperbolic_tangent:
      return "tanh";
    case arctangent2:
      return "atan2";
    case smaller:
      return "min";
    case larger:
      return "max";
    case interpolation:
      return "table";
    case slope:
      return "slope";
    default:
      return "";
  }
}

}  // namespace

double ExpressionTable::at(double position) const {
  if (!(position > x.front())) return position <= x.front() ? y.front() : position;  // NaN remains
  if (position >= x.back()) return y.back();
  const std::size_t i = segment_of(*this, position);
  return y[i] + (y[i + 1] - y[i]) * ((position - x[i]) / (x[i + 1] - x[i]));
}

double ExpressionTable::slope_at(double position) const {
  if (!(position >= x.front() && position < x.back())) return 0;
  const std::size_t i = segment_of(*this, position);
  return (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
}

std::size_t ExpressionGraph::arity(Operation operation) {
  switch (operation) {
    case number:
    case variable:
      return 0;
    case sum:
    case difference:
    case product:
    case quotient:
    case exponentiation:
    case arctangent2:
    case smaller:
    case larger:
      return 2;
    case choice:
      return 4;
    default:
      return 1;
  }
}

double ExpressionGraph::evaluate(Operation operation, std::span<const double> x) {
  switch (operation) {
    case sum:
      return x[0] + x[1];
    case difference:
      return x[0] - x[1];
    case product:
      return x[0] * x[1];
    case quotient:
      return x[0] / x[1];
    case exponentiation:
      return std::pow(x[0], x[1]);
    case square_root:
      return std::sqrt(x[0]);
    case sine:
      return std::sin(x[0]);
    case cosine:
      return std::cos(x[0]);
    case tangent:
      return std::tan(x[0]);
    case exponential:
      return std::exp(x[0]);
    case logarithm:
      return std::log(x[0]);
    case hyperbolic_tangent:
      return std::tanh(x[0]);
    case arctangent2:
      return std::atan2(x[0], x[1]);
    case smaller:
      return x[1] < x[0] ? x[1] : x[0];
    case larger:
      return x[1] > x[0] ? x[1] : x[0];
    case choice:
      return x[0] < x[1] ? x[2] : x[3];
    default:
      throw std::logic_error("no value without symbols and tables");
  }
}

std::size_t ExpressionGraph::Hash::operator()(const Node& node) const {
  std::uint64_t hash = static_cast<std::uint64_t>(node.operation) + 1;
  const auto mix = [&](std::uint64_t with) {
    hash = (hash ^ with) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  };
  for (const Id operand : node.operands) mix(static_cast<std::uint32_t>(operand));
  mix(std::bit_cast<std::uint64_t>(node.value));
  return static_cast<std::size_t>(hash);
}

Id ExpressionGraph::intern(const Node& node) {
  const auto [at, is_new] = ids_.try_emplace(node, static_cast<Id>(nodes_.size()));
  if (!is_new) return at->second;
  if (nodes_.size() == kMaxNodes) {
    ids_.erase(at);
    throw std::length_error("formula has more than " + std::to_string(kMaxNodes) + " terms");
  }
  nodes_.push_back(node);
  return at->second;
}

Id ExpressionGraph::constant(double value) {
  Node node;
  node.value = value == 0 ? 0 : value;  // -0 is 0
  return intern(node);
}

Id ExpressionGraph::symbol(std::string_view name) {
  const auto known = std::ranges::find(symbols_, name);
  Node node{variable};
  node.operands[0] = static_cast<Id>(known - symbols_.begin());
  if (known == symbols_.end()) symbols_.emplace_back(name);
  return intern(node);
}

Id ExpressionGraph::function(Operation operation, std::initializer_list<Id> operands) {
  Node node{operation};
  std::ranges::copy(operands, node.operands.begin());
  if (std::ranges::all_of(operands, [&](Id id) { return is_constant(id); })) {
    std::array<double, 4> values{};
    std::ranges::transform(operands, values.begin(), [&](Id id) { return this->node(id).value; });
    return constant(evaluate(operation, values));
  }
  if (is_commutative(operation) && node.operands[1] < node.operands[0])
    std::swap(node.operands[0], node.operands[1]);
  return intern(node);
}

Id ExpressionGraph::add(Id a, Id b) {
  if (is_constant(a, 0)) return b;
  if (is_constant(b, 0)) return a;
  return function(sum, {a, b});
}

Id ExpressionGraph::subtract(Id a, Id b) {
  if (is_constant(b, 0)) return a;
  if (a == b) return constant(0);
  // 0 - (0 - x) and 0 - (x - y)
  if (const Node& of = node(b); is_constant(a, 0) && of.operation == difference)
    return subtract(of.operands[1], of.operands[0]);
  return function(difference, {a, b});
}

Id ExpressionGraph::multiply(Id a, Id b) {
  if (is_constant(a, 0) || is_constant(b, 0)) return constant(0);
  if (is_constant(a, 1)) return b;
  if (is_constant(b, 1)) return a;
  if (is_constant(a, -1)) return negate(b);
  if (is_constant(b, -1)) return negate(a);
  return function(product, {a, b});
}

Id ExpressionGraph::divide(Id a, Id b) {
  if (is_constant(a, 0) && !is_constant(b, 0)) return a;
  if (is_constant(b, 1)) return a;
  return function(quotient, {a, b});
}

Id ExpressionGraph::power(Id base, double exponent) {
  if (exponent == 0) return constant(1);
  if (exponent == 1) return base;
  if (exponent == 2) return multiply(base, base);
  if (exponent == 0.5) return apply(square_root, base);
  return function(exponentiation, {base, constant(exponent)});
}

Id ExpressionGraph::apply(Operation operation, Id x) {
  return function(operation, {x});
}
Id ExpressionGraph::arctangent(Id y, Id x) {
  return function(arctangent2, {y, x});
}
Id ExpressionGraph::minimum(Id a, Id b) {
  return a == b ? a : function(smaller, {a, b});
}
Id ExpressionGraph::maximum(Id a, Id b) {
  return a == b ? a : function(larger, {a, b});
}

Id ExpressionGraph::select(Id a, Id b, Id where_less, Id otherwise) {
  if (where_less == otherwise) return otherwise;
  if (is_constant(a) && is_constant(b))
    return node(a).value < node(b).value ? where_less : otherwise;
  return intern({choice, {a, b, where_less, otherwise}, 0});
}

Id ExpressionGraph::table(ExpressionTable values, Id x) {
  if (is_constant(x)) return constant(values.at(node(x).value));
  const auto same = std::ranges::find_if(
      tables_, [&](const ExpressionTable& t) { return t.x == values.x && t.y == values.y; });
  Node node{interpolation, {x, static_cast<Id>(same - tables_.begin())}};
  if (same == tables_.end()) tables_.push_back(std::move(values));
  return intern(node);
}

std::string ExpressionGraph::text(Id id) const {
  return text(id, 0);
}

// Precedence of the surroundings: 0 none, 1 sum, 2 its right operand, 3 product, 4 its right
// operand, 5 power.
std::string ExpressionGraph::text(Id id, int precedence) const {
  const Node& here = node(id);
  const auto binary = [&](const char* sign, int left, int right, int own) {
    std::string joined = text(here.operands[0], left) + sign + text(here.operands[1], right);
    return precedence > own ? "(" + joined + ")" : joined;
  };
  switch (here.operation) {
    case number: {
      const std::string number = number_text(here.value);
      return here.value < 0 && precedence > 0 ? "(" + number + ")" : number;
    }
    case variable:
      return symbols_[static_cast<std::size_t>(here.operands[0])];
    case sum:
      return binary(" + ", 1, 2, 1);
    case difference:
      if (is_constant(here.operands[0], 0)) {
        const std::string negated = "-" + text(here.operands[1], 4);
        return precedence > 0 ? "(" + negated + ")" : negated;
      }
      return binary(" - ", 1, 2, 1);
    case product:
      return binary(" * ", 3, 4, 3);
    case quotient:
      return binary(" / ", 3, 4, 3);
    case exponentiation:
      return binary("^", 5, 5, 4);
    case choice:
      return "if(" + text(here.operands[0], 0) + " < " + text(here.operands[1], 0) + ", " +
             text(here.operands[2], 0) + ", " + text(here.operands[3], 0) + ")";
    default: {
      std::string call = name_of(here.operation) + ("(" + text(here.operands[0], 0));
      if (arity(here.operation) == 2) call += ", " + text(here.operands[1], 0);
      return call + ")";
    }
  }
}

}  // namespace twinarm
