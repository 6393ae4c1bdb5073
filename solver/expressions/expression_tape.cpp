#include "solver/expressions/expression_tape.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <unordered_map>

namespace twinarm {

using Id = ExpressionGraph::Id;

ExpressionTape::ExpressionTape(const ExpressionGraph& graph, std::span<const Id> inputs,
                               std::span<const Id> outputs)
    : results_(outputs.size()), inputs_(inputs.size()) {
  std::vector<char> needed(graph.size(), 0);
  for (const Id id : outputs) needed[static_cast<std::size_t>(id)] = 1;
  for (std::size_t i = needed.size(); i-- > 0;) {
    if (!needed[i]) continue;
    const ExpressionGraph::Node& node = graph.node(static_cast<Id>(i));
    for (std::size_t k = 0; k < ExpressionGraph::arity(node.operation); ++k)
      needed[static_cast<std::size_t>(node.operands[k])] = 1;
  }
  std::unordered_map<Id, std::size_t> place;
  for (const Id id : inputs) place.emplace(id, place.size());
  values_.resize(inputs_);
  const auto each = [&](auto&& visit) {
    for (std::size_t i = 0; i < needed.size(); ++i)
      if (const Id id = static_cast<Id>(i); needed[i]) visit(id, graph.node(id));
  };
  each([&](Id id, const ExpressionGraph::Node& node) {
    if (node.operation == Operation::variable && !place.contains(id))
      throw std::invalid_argument("no value is given for '" + graph.text(id) + "'");
    if (node.operation != Operation::number) return;
    place.emplace(id, values_.size());
    values_.push_back(node.value);
  });
  first_step_ = values_.size();
  each([&](Id id, const ExpressionGraph::Node& node) {
    if (place.contains(id)) return;
    const std::size_t count = ExpressionGraph::arity(node.operation);
    steps_.push_back({node.operation, operands_.size(), count, tables_.size()});
    for (std::size_t k = 0; k < count; ++k) operands_.push_back(place.at(node.operands[k]));
    if (node.operation == Operation::interpolation || node.operation == Operation::slope)
      tables_.push_back(graph.table_of(node));
    place.emplace(id, first_step_ + steps_.size() - 1);
  });
  values_.resize(first_step_ + steps_.size());
  for (const Id id : outputs) outputs_.push_back(place.at(id));
}

std::span<const double> ExpressionTape::operator()(std::span<const double> inputs) noexcept {
  std::copy_n(inputs.begin(), inputs_, values_.begin());
  std::array<double, 4> x{};
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    for (std::size_t k = 0; k < step.count; ++k) x[k] = values_[operands_[step.first + k]];
    double& value = values_[first_step_ + s];
    if (step.operation == Operation::interpolation)
      value = tables_[step.table].at(x[0]);
    else if (step.operation == Operation::slope)
      value = tables_[step.table].slope_at(x[0]);
    else
      value = ExpressionGraph::evaluate(step.operation, x);
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i) results_[i] = values_[outputs_[i]];
  return results_;
}

}  // namespace twinarm
