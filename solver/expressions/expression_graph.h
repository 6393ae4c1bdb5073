// Formulas as a directed acyclic graph. Equal terms are one node (hash consing), so that common
// subexpressions are evaluated once and derivatives do not grow exponentially.
//
// Functions fold constants and remove neutral elements (x + 0, 1 x, 0 x, x^1); the order of the
// operands of + and * does not matter. 0 x is 0 also where x may be infinite.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace twinarm {

enum class Operation : std::uint8_t {
  number,
  variable,
  sum,
  difference,
  product,
  quotient,
  exponentiation,  // x^y; the exponent is constant
  square_root,
  sine,
  cosine,
  tangent,
  exponential,
  logarithm,
  hyperbolic_tangent,
  arctangent2,  // atan2(y, x)
  smaller,
  larger,
  choice,         // where x < y the third operand, else the fourth
  interpolation,  // piecewise linear function of x, constant beyond its ends
  slope           // of an interpolation
};

// Piecewise linear: abscissae strictly increasing, at least two.
struct ExpressionTable {
  std::vector<double> x, y;

  double at(double position) const;
  double slope_at(double position) const;  // to the right of a corner; 0 beyond the ends
};

class ExpressionGraph {
 public:
  using Id = std::int32_t;
  static constexpr std::size_t kMaxNodes = 200'000;

  struct Node {
    Operation operation = Operation::number;
    std::array<Id, 4> operands{-1, -1, -1, -1};  // of a variable: its index;
                                                 // of an interpolation: x, index of the table
    double value = 0;                            // of a number
    bool operator==(const Node&) const = default;
  };

  // std::length_error beyond kMaxNodes.
  Id constant(double value);
  Id symbol(std::string_view name);  // the same name is the same node
  Id add(Id a, Id b);
  Id subtract(Id a, Id b);
  Id multiply(Id a, Id b);
  Id divide(Id a, Id b);
  Id negate(Id a) { return subtract(constant(0), a); }
  Id power(Id base, double exponent);
  Id apply(Operation function, Id x);  // of one operand: square_root to hyperbolic_tangent
  Id arctangent(Id y, Id x);
  Id minimum(Id a, Id b);
  Id maximum(Id a, Id b);
  Id absolute(Id a) { return maximum(a, negate(a)); }
  Id select(Id a, Id b, Id where_less, Id otherwise);
  Id table(ExpressionTable values, Id x);  // x and y of equal length, at least two
  // Derivative by a symbol; at corners one-sided, from the right.
  Id derivative(Id of, Id by);

  const Node& node(Id id) const { return nodes_[static_cast<std::size_t>(id)]; }
  bool is_constant(Id id) const { return node(id).operation == Operation::number; }
  bool is_constant(Id id, double value) const { return is_constant(id) && node(id).value == value; }
  std::size_t size() const { return nodes_.size(); }
  const std::vector<std::string>& symbols() const { return symbols_; }
  const ExpressionTable& table_of(const Node& node) const {
    return tables_[static_cast<std::size_t>(node.operands[1])];
  }
  // Number of operands that are nodes.
  static std::size_t arity(Operation operation);
  // Value of an operation other than variable, interpolation and slope.
  static double evaluate(Operation operation, std::span<const double> operands);
  // As text that the parser reads.
  std::string text(Id id) const;

 private:
  Id intern(const Node& node);
  Id function(Operation operation, std::initializer_list<Id> operands);  // folds constants
  Id chain_rule(Id of, const std::array<Id, 4>& d);  // d: derivatives of the operands
  std::string text(Id id, int precedence) const;

  struct Hash {
    std::size_t operator()(const Node& node) const;
  };
  std::vector<Node> nodes_;
  std::unordered_map<Node, Id, Hash> ids_;
  std::vector<std::string> symbols_;
  std::vector<ExpressionTable> tables_;
};

}  // namespace twinarm
