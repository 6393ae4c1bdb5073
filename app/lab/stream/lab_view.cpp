#include "app/lab/stream/lab_view.h"

namespace twinarm {
namespace {

bool is_finite(const State<double>& x) {
  const auto finite = [](double value) { return std::abs(value) < 1e12; };
  return std::ranges::all_of(x.q, finite) && std::ranges::all_of(x.qd, finite);
}

}  // namespace

LabView::LabView(std::uint32_t number, std::shared_ptr<const SimulatePlan> plan,
                 const RecordingHeader& header, SceneWords words, ViewVariants variants)
    : plan_(std::move(plan)),
      words_(std::move(words)),
      snapshots_(*plan_),
      stage_(plan_->input.scene
                 ? make_scene_view(*plan_->input.scene)
                 : make_scene_view(plan_->input.robot.robot, plan_->input.robot.model)),
      channels_(plan_->input, header, snapshots_.components()),
      variants_(std::move(variants), plan_->input, channels_) {
  columns_.scene = number;
  legends_.resize(layer_names().size());
  const Snapshot start = snapshots_.at_start();
  extend_by_reach(stage_, plan_->input.robot, start);
  variants_.place(stage_.instants.front(), stage_.extent);
  const bool follows_device = std::ranges::any_of(
      snapshots_.components(),
      [](const SceneCoupling& c) { return c.target.kind == CouplingTarget::Kind::device; });
  set_live_view(stage_, start, follows_device);
  store_.take(stage_.list);
}

void LabView::take_legend(std::size_t layer, const Drawn& from, std::size_t end) {
  for (std::size_t i = from.legend; i < end; ++i) {
    const LegendLine& line = stage_.list.legend[i];
    std::vector<LegendLine>& known = legends_[layer];
    const auto same = std::ranges::find(known, line.text, &LegendLine::text);
    if (same != known.end() && same->value == line.value) continue;
    if (same == known.end())
      known.push_back(line);
    else
      *same = line;
    ++revision_;
  }
}

// Each layer ends in the columns, drawn or not.
void LabView::draw_layers(const Snapshot& snapshot, const std::vector<std::string>& wanted) {
  const DrawList& list = stage_.list;
  const std::vector<Drawn> drawn = draw(stage_, snapshot, wanted);
  columns_.clear_entries();
  std::size_t next = 0;
  for (std::size_t layer = 0; layer < legends_.size(); ++layer) {
    const bool is_drawn =
        next + 1 < drawn.size() &&
        (layer == 0 ? !drawn[next].overlay
                    : drawn[next].overlay && layer_names()[layer] == drawn[next].overlay->name);
    if (is_drawn) {
      const Drawn &from = drawn[next], &to = drawn[next + 1];
      for (std::size_t i = from.instance; i < to.instance; ++i) columns_.add(list.instances[i]);
      for (std::size_t i = from.label; i < to.label; ++i) columns_.add(list.labels[i]);
      take_legend(layer, from, to.legend);
      ++next;
    }
    columns_.end_layer();
  }
}

void LabView::take_values(const LabFrame& frame, const Snapshot& snapshot) {
  if (channels_.add_pairs(frame)) ++naming_;
  channels_.values(frame, snapshot, snapshots_.couplings(), columns_.channels);
  variants_.values(frame, snapshot, rows_, columns_.channels);
  columns_.works = works_by_row(frame.recorded, rows_.size());
}

// Of all bodies, and of their target robots.
void LabView::take_poses(const Snapshot& snapshot) {
  const std::vector<Pose>& links = snapshot.k.X_WL;
  columns_.link.assign(7 * links.size(), std::numeric_limits<float>::quiet_NaN());
  columns_.target = columns_.link;
  put_poses(links, 0, links.size(), columns_.link);
  for (const ShownTargetRobot& target : snapshot.targets) {
    const auto [first, last] = plan_->input.scene->bodies_of_robot(target.robot);
    put_poses(target.X_WL, static_cast<std::size_t>(first), static_cast<std::size_t>(last) + 1,
              columns_.target);
  }
}

void LabView::change(std::shared_ptr<const SimulatePlan> plan,
                     std::vector<std::shared_ptr<const SimulatePlan>> variants) {
  snapshots_.change(*plan);
  variants_.change(std::move(variants));
  const SceneModel* scene = plan->input.scene.get();
  stage_.scene = scene;
  stage_.model = scene ? &scene->model : &plan->input.robot.model;
  plan_ = std::move(plan);  // last: until here the old one is referred to
}

void LabView::name_rows(const std::vector<std::string>& rows) {
  if (rows_ == rows) return;
  rows_ = rows;
  ++naming_;
}

std::string LabView::frame(const LabFrame& now, const LabFrame* before,
                           const std::vector<std::string>& layers, const FrameFacts& facts) {
  Snapshot snapshot = snapshots_.of(now);
  if (before) snapshot.before = snapshots_.poses(*before);
  variants_.look(now);
  variants_.show(before, snapshot);
  const bool is_whole = is_finite(snapshot.x);
  if (is_whole && !facts.stopped) grow_scales(stage_, snapshot);
  if (is_whole && !facts.looked_back) extend_trails(stage_, snapshot);
  draw_layers(snapshot, is_whole ? layers : std::vector<std::string>{});
  if (store_.take(stage_.list)) ++revision_;
  take_values(now, snapshot);
  take_poses(snapshot);
  columns_.number = facts.number;
  columns_.flags =
      (facts.paused ? 1u : 0u) | (facts.looked_back ? 2u : 0u) | (facts.stopped ? 4u : 0u);
  columns_.time = now.recorded.t;
  columns_.stamp = now.input_stamp;
  columns_.age = facts.input_age;
  columns_.step = static_cast<std::uint64_t>(now.recorded.step);
  return frame_bytes(columns_);
}

std::string LabView::history(const std::vector<const LabFrame*>& frames) {
  for (const LabFrame* frame : frames)
    if (channels_.add_pairs(*frame)) ++naming_;
  HistoryColumns all;
  all.scene = columns_.scene;
  all.channel_count = static_cast<std::uint32_t>(channels_.all().size());
  all.row_count = static_cast<std::uint32_t>(rows_.size());
  for (const LabFrame* frame : frames) {
    variants_.look(*frame);
    take_values(*frame, snapshots_.of(*frame));
    all.time.push_back(frame->recorded.t);
    all.channels.insert(all.channels.end(), columns_.channels.begin(), columns_.channels.end());
    all.works.insert(all.works.end(), columns_.works.begin(), columns_.works.end());
  }
  return history_bytes(all);
}

}  // namespace twinarm
