#include "solver/loops/loop_closure.h"

#include <algorithm>
#include <utility>

#include "solver/loops/loop_types.h"

namespace twinarm {
namespace {

using Eigen::Index;

Index index(std::size_t i) {
  return static_cast<Index>(i);
}

}  // namespace

std::span<const LoopTypeFacts> all_loop_types() {
#define TWINARM_FACTS(name, Loop) \
  LoopTypeFacts{LoopType::name, #name, Loop::rows, Loop::ends, Loop::slides, &Loop::g_of_pose},
  static constexpr std::array all{TWINARM_LOOPS(TWINARM_FACTS)};
#undef TWINARM_FACTS
  return all;
}

LoopClosures::LoopClosures(const Model<double>& model, std::vector<LoopClosure> loops)
    : model_(&model), loops_(std::move(loops)), ends_(loops_.size()) {
  check_loops(model, loops_);
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    const LoopClosure& loop = loops_[l];
    LoopEnds& e = ends_[l];
    e.first_row = loop_of_row_.size();
    const LoopTypeFacts& facts = facts_of(loop.type);
    loop_of_row_.insert(loop_of_row_.end(), facts.rows, l);
    const auto a = static_cast<std::size_t>(loop.body_a), b = static_cast<std::size_t>(loop.body_b);
    if (facts.ends == LoopBetween::joints) {
      e.dofs = {model.iv[a], model.iv[b]};
    } else if (facts.ends == LoopBetween::one_joint) {
      e.dofs = {model.iv[a]};
    } else {
      e.shared = model.shared_ancestor(a, b);
      for (const std::size_t end : {a, b})
        for (std::size_t i = end; i > e.shared; i = static_cast<std::size_t>(model.parent[i]))
          for (std::size_t d = model.iv[i]; d < model.iv[i] + model.dofs(i); ++d)
            e.dofs.push_back(d);
    }
  }
  g_ = rate_ = gamma_ = Eigen::VectorXd::Zero(index(rows()));
  J_.setZero(index(rows()), index(model.nv));
}

void LoopClosures::evaluate(const State<double>& x, const Kinematics& k) noexcept {
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    const Index row = index(ends_[l].first_row);
    ends_[l].offset = {loops_[l].offset, 0, 0};
    if (loops_[l].motion)
      std::ranges::copy((*loops_[l].motion)(std::array{x.t}), ends_[l].offset.begin());
    const LoopRows rows{*model_, x, k, loops_[l], ends_[l], row, g_, rate_, gamma_, J_};
    visit_loop(loops_[l].type, [&](auto type) { type.evaluate(rows); });
  }
}

LoopWrench LoopClosures::wrench(std::size_t loop, const Eigen::VectorXd& lambda) const {
  const LoopEnds& e = ends_[loop];
  return visit_loop(loops_[loop].type,
                    [&](auto type) { return type.wrench(e, lambda.data() + e.first_row); });
}

}  // namespace twinarm
