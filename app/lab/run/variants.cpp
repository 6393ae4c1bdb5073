#include "app/lab/run/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "solver/support/diagnostics.h"

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

LabVariants::LabVariants(const VariantSet& set, std::vector<std::unique_ptr<LabScene::Plan>> plans,
                         const LabFrame* from, const LabNames& names) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    Lane lane;
    lane.name = set.values[i + 1];
    const VariantFrame start = from ? from->lanes[i] : VariantFrame{};
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

void LabVariants::follow(const LabRun& run) {
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

void LabVariants::stop(Lane& lane) {
  lane.stopped = true;
  const PostMortem* found = lane.run->post_mortem();
  const std::string why = found ? found->reason : "";  // none: a number is not finite
  words_.push_back(fmt::format("the lane {} stopped at {:.4g} s{}{}; the others go on", lane.name,
                               lane.run->time(), why.empty() ? "" : ": ", why));
}

void LabVariants::add_to(LabFrame& frame, LabNames& names) {
  frame.lanes.clear();
  for (Lane& lane : lanes_) {
    if (lane.run) lane.last = std::make_shared<const LabFrame>(lane.run->frame(names));
    if (lane.stopped) lane.run.reset();
    frame.lanes.push_back({lane.last, lane.stopped});
  }
}

std::vector<std::string> LabVariants::take_words() {
  return std::exchange(words_, {});
}

namespace {

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  for (const char c : text) {
    if (c == '[') ++depth;
    if (c == ']') --depth;
    if (c == ',' && depth == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  return values;
}

}  // namespace

VariantSet parse_lanes(const std::string& text) {
  const std::size_t equals = text.find('=');
  VariantSet lanes;
  lanes.path = text.substr(0, equals);
  if (equals != std::string::npos) lanes.values = split_values(text.substr(equals + 1));
  if (const auto fault = fault_of(lanes))
    throw InputError({{"", 0, "--lanes " + text, fault->problem, fault->fix, "option.lanes"}});
  return lanes;
}

std::optional<LaneFault> fault_of(const VariantSet& lanes) {
  const std::vector<std::string>& values = lanes.values;
  const auto is_empty = [](const std::string& value) { return value.empty(); };
  if (lanes.path.empty() || values.empty() || std::ranges::any_of(values, is_empty))
    return LaneFault{"a path or a value is missing", "write integrator=semi-implicit,rk4"};
  if (values.size() < 2 || values.size() > VariantSet::kMax)
    return LaneFault{std::to_string(values.size()) + " values make no lanes", "give 2 to 7 values"};
  for (auto value = values.begin(); value != values.end(); ++value)
    if (std::find(values.begin(), value, *value) != value)
      return LaneFault{"'" + *value + "' stands there twice", "give each value once"};
  return std::nullopt;
}

void put(std::vector<Change>& changes, const Change& change) {
  std::erase_if(changes, [&](const Change& other) { return other.path == change.path; });
  changes.push_back(change);
}

}  // namespace twinarm
