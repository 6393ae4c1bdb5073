// Formulas as text: numbers, symbols, + - * / ^, parentheses and
//   sqrt sin cos tan exp log tanh abs (x), atan2(y, x), min(a, b), max(a, b), pi,
//   if(a < b, where true, else), with < > <= >=
// A symbol is a name or has one in parentheses: q(arm/elbow).
// A number may have a unit: 12[N/mm] is 12000 N/m. A number without one takes that which fits.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "solver/expressions/dimension.h"
#include "solver/expressions/expression_graph.h"

namespace twinarm {

struct ExpressionSymbol {
  std::string name;
  Dimension dimension;
};

class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(std::size_t at, const std::string& message)
      : std::runtime_error("at character " + std::to_string(at + 1) + ": " + message),
        position(at) {}
  std::size_t position;  // in the text, from 0
};

inline constexpr std::size_t kMaxFormulaLength = 4096, kMaxFormulaDepth = 100;

// wanted: dimension of the value. Throws ExpressionError.
ExpressionGraph::Id parse_expression(ExpressionGraph& graph, std::string_view text,
                                     std::span<const ExpressionSymbol> symbols,
                                     std::optional<Dimension> wanted = std::nullopt);

}  // namespace twinarm
