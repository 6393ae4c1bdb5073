// Values of formulas of a graph, in one pass over the terms that they need. Does not allocate.
#pragma once

#include <span>
#include <vector>

#include "solver/expressions/expression_graph.h"

namespace twinarm {

class ExpressionTape {
 public:
  ExpressionTape() = default;
  // inputs: symbols. std::invalid_argument if an output needs a symbol that is not among them.
  ExpressionTape(const ExpressionGraph& graph, std::span<const ExpressionGraph::Id> inputs,
                 std::span<const ExpressionGraph::Id> outputs);

  // Values of the outputs, valid until the next call.
  std::span<const double> operator()(std::span<const double> inputs) noexcept;
  std::size_t size() const { return steps_.size(); }

 private:
  struct Step {
    Operation operation;
    std::size_t first, count;  // operands_
    std::size_t table;         // of tables_
  };
  std::vector<Step> steps_;
  std::vector<std::size_t> operands_, outputs_;  // into values_
  std::vector<ExpressionTable> tables_;
  std::vector<double> values_;  // inputs, numbers, results of the steps
  std::vector<double> results_;
  std::size_t inputs_ = 0, first_step_ = 0;
};

}  // namespace twinarm
