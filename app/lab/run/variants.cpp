#include "app/lab/run/variants.h"

#include <fmt/format.h>

#include <utility>

namespace twinarm {
namespace {

// What the hand did in a step of the run, for a step of a lane: the same where both are as long.
HandStep told_at(double t, double h, HandStep told) {
  const double later = t - told.t;
  if (later != 0)
    for (std::size_t j = 0; j < told.hand.theta.size(); ++j)
      told.hand.theta[j] += later * told.hand.theta_dot[j];
  told.t = t;
  told.h = h;
  return told;
}

}  // namespace

LabLanes::LabLanes(const LaneSet& set, std::vector<std::unique_ptr<LabScene::Plan>> plans,
                   const LabFrame* from, const LabNames& names) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    Lane lane;
    lane.name = set.values[i + 1];
    const LaneFrame start = from ? from->lanes[i] : LaneFrame{};
    if (start.stopped) {
      lane.last = start.frame;
      lane.stopped = true;
    } else {
      lane.nobody = std::make_unique<LabHand>();
      lane.run = std::make_unique<LabRun>(std::move(plans[i]), *lane.nobody, start.frame.get());
      if (from) lane.run->keep_books(*start.frame, names);
    }
    lanes_.push_back(std::move(lane));
  }
}

void LabLanes::follow(const LabRun& run) {
  for (Lane& lane : lanes_) {
    if (lane.stopped) continue;
    const double h = lane.run->step_length();
    while (lane.run->time() + 0.5 * h < run.time()) {
      LabInput input = run.input();
      const double t = lane.run->view().simulation().state().t;
      if (input.hand) input.hand = told_at(t, h, *input.hand);
      if (lane.run->step(input)) continue;
      stop(lane);
      break;
    }
  }
}

void LabLanes::stop(Lane& lane) {
  lane.stopped = true;
  const PostMortem* found = lane.run->post_mortem();
  const std::string why = found ? found->reason : "";  // none: a number is not finite
  words_.push_back(fmt::format("the lane {} stopped at {:.4g} s{}{}; the others go on", lane.name,
                               lane.run->time(), why.empty() ? "" : ": ", why));
}

void LabLanes::add_to(LabFrame& frame, LabNames& names) {
  frame.lanes.clear();
  for (Lane& lane : lanes_) {
    if (lane.run) lane.last = std::make_shared<const LabFrame>(lane.run->frame(names));
    if (lane.stopped) lane.run.reset();
    frame.lanes.push_back({lane.last, lane.stopped});
  }
}

std::vector<std::string> LabLanes::take_words() {
  return std::exchange(words_, {});
}

}  // namespace twinarm
