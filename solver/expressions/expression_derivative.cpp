// Derivatives of formulas.
#include "solver/expressions/expression_graph.h"

#include <algorithm>

namespace twinarm {

using Id = ExpressionGraph::Id;
using enum Operation;

// Each node once, in the order of the nodes: operands come before what uses them.
Id ExpressionGraph::derivative(Id of, Id by) {
  std::vector<bool> is_used(static_cast<std::size_t>(of) + 1, false);
  is_used.back() = true;
  for (Id id = of; id >= 0; --id) {
    if (!is_used[static_cast<std::size_t>(id)]) continue;
    const Node& here = node(id);
    for (std::size_t k = 0; k < arity(here.operation); ++k)
      is_used[static_cast<std::size_t>(here.operands[k])] = true;
  }
  const Id zero = constant(0), one = constant(1);
  std::vector<Id> derivatives(is_used.size(), zero);
  for (Id id = 0; id <= of; ++id) {
    if (!is_used[static_cast<std::size_t>(id)]) continue;
    std::array<Id, 4> d{zero, zero, zero, zero};
    const Node here = node(id);
    for (std::size_t k = 0; k < arity(here.operation); ++k)
      d[k] = derivatives[static_cast<std::size_t>(here.operands[k])];
    derivatives[static_cast<std::size_t>(id)] = id == by ? one : chain_rule(id, d);
  }
  return derivatives.back();
}

Id ExpressionGraph::chain_rule(Id of, const std::array<Id, 4>& d) {
  const Node here = node(of);  // a copy: nodes_ grows
  const Id x = here.operands[0], y = here.operands[1];
  if (std::ranges::all_of(d, [&](Id id) { return is_constant(id, 0); })) return constant(0);
  switch (here.operation) {
    case sum:
      return add(d[0], d[1]);
    case difference:
      return subtract(d[0], d[1]);
    case product:
      return add(multiply(d[0], y), multiply(x, d[1]));
    case quotient:
      return divide(subtract(d[0], multiply(of, d[1])), y);
    case exponentiation:
      return multiply(multiply(y, power(x, node(y).value - 1)), d[0]);
    case square_root:
      return divide(d[0], multiply(constant(2), of));
    case sine:
      return multiply(apply(cosine, x), d[0]);
    case cosine:
      return negate(multiply(apply(sine, x), d[0]));
    case tangent:
      return multiply(add(constant(1), multiply(of, of)), d[0]);
    case exponential:
      return multiply(of, d[0]);
    case logarithm:
      return divide(d[0], x);
    case hyperbolic_tangent:
      return multiply(subtract(constant(1), multiply(of, of)), d[0]);
    case arctangent2:
      return divide(subtract(multiply(y, d[0]), multiply(x, d[1])),
                    add(multiply(x, x), multiply(y, y)));
    case smaller:
      return select(y, x, d[1], d[0]);
    case larger:
      return select(x, y, d[1], d[0]);
    case choice:
      return select(x, y, d[2], d[3]);
    case interpolation: {
      Node derived = here;
      derived.operation = slope;
      return multiply(intern(derived), d[0]);
    }
    default:
      return constant(0);  // constants, other symbols, slopes of tables
  }
}

}  // namespace twinarm
