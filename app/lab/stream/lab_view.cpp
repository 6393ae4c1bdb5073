#include "app/lab/stream/lab_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/draw/overlays/overlays.h"
#include "app/lab/stream/frame_bytes.h"
#include "app/lab/stream/lab_snapshot.h"
#include "app/lab/stream/live_view.h"
#include "app/lab/stream/scene_message.h"

namespace twinarm {
namespace {

bool is_finite(const State<double>& x) {
  const auto finite = [](double value) { return std::abs(value) < 1e12; };
  return std::all_of(x.q.begin(), x.q.end(), finite) &&
         std::all_of(x.qd.begin(), x.qd.end(), finite);
}

}  // namespace

struct LabView::Impl {
  Impl(std::uint32_t number, std::shared_ptr<const SimulatePlan> of, const RecordingHeader& header,
       SceneWords said, ViewVariants beside)
      : plan(std::move(of)),
        words(std::move(said)),
        moments(*plan),
        stage(plan->input.scene ? make_stage(*plan->input.scene)
                                : make_stage(plan->input.robot.robot, plan->input.robot.model)),
        channels(plan->input, header, moments.pulls()),
        lanes(std::move(beside), plan->input, channels) {
    columns.scene = number;
    legends.resize(layer_names().size());
    const Snapshot start = moments.at_start();
    look_around(stage, plan->input.robot, start);
    lanes.place(stage.instants.front(), stage.extent);
    set_live_view(stage, start, moments.follows_device());
    store.take(stage.list);
  }

  void draw_layers(const Snapshot& moment, const std::vector<std::string>& wanted);
  void take_legend(std::size_t layer, const Drawn& from, std::size_t end);
  void take_values(const LabFrame& frame, const Snapshot& moment);
  void take_places(const Snapshot& moment);

  std::shared_ptr<const SimulatePlan> plan;
  SceneWords words;
  LabMoments moments;
  SceneView stage;
  LabChannels channels;
  VariantViews lanes;
  MeshStore store;
  std::vector<std::string> rows;
  std::vector<std::vector<LegendLine>> legends;  // by layer
  FrameColumns columns;
  std::uint64_t revision = 1;
};

void LabView::Impl::take_legend(std::size_t layer, const Drawn& from, std::size_t end) {
  for (std::size_t i = from.legend; i < end; ++i) {
    const LegendLine& line = stage.list.legend[i];
    std::vector<LegendLine>& known = legends[layer];
    const auto same = std::find_if(known.begin(), known.end(), [&](const LegendLine& other) {
      return other.text == line.text;
    });
    if (same != known.end() && same->value == line.value) continue;
    if (same == known.end())
      known.push_back(line);
    else
      *same = line;
    ++revision;
  }
}

// Layers in their own order, each of which closes in the columns, drawn or not.
void LabView::Impl::draw_layers(const Snapshot& moment, const std::vector<std::string>& wanted) {
  const DrawList& list = stage.list;
  std::vector<Drawn> drawn = draw(stage, moment, wanted);
  drawn.push_back({nullptr, list.instances.size(), list.labels.size(), list.legend.size()});
  columns.clear_entries();
  std::size_t next = 0;
  for (std::size_t layer = 0; layer < legends.size(); ++layer) {
    const bool is_drawn =
        next + 1 < drawn.size() &&
        (layer == 0 ? !drawn[next].overlay
                    : drawn[next].overlay && layer_names()[layer] == drawn[next].overlay->name);
    if (is_drawn) {
      const Drawn &from = drawn[next], &to = drawn[next + 1];
      for (std::size_t i = from.instance; i < to.instance; ++i) columns.add(list.instances[i]);
      for (std::size_t i = from.label; i < to.label; ++i) columns.add(list.labels[i]);
      take_legend(layer, from, to.legend);
      ++next;
    }
    columns.end_layer();
  }
}

void LabView::Impl::take_values(const LabFrame& frame, const Snapshot& moment) {
  if (channels.add_pairs(frame)) ++revision;
  channels.values(frame, moment, moments.couplings(), columns.channels);
  lanes.values(frame, moment, rows, columns.channels);
  columns.works = works_by_row(frame.recorded, rows.size());
}

// Of all bodies, and of their kinematic twins.
void LabView::Impl::take_places(const Snapshot& moment) {
  const std::vector<Pose>& links = moment.k.X_WL;
  columns.link.assign(7 * links.size(), std::numeric_limits<float>::quiet_NaN());
  columns.twin = columns.link;
  put_places(links, 0, links.size(), columns.link);
  for (const ShownTargetRobot& twin : moment.twins) {
    const auto [first, last] = plan->input.scene->bodies_of_robot(twin.robot);
    put_places(twin.X_WL, static_cast<std::size_t>(first), static_cast<std::size_t>(last) + 1,
               columns.twin);
  }
}

LabView::LabView(std::uint32_t number, std::shared_ptr<const SimulatePlan> plan,
                 const RecordingHeader& header, SceneWords words, ViewVariants lanes)
    : impl_(std::make_unique<Impl>(number, std::move(plan), header, std::move(words),
                                   std::move(lanes))) {}

LabView::~LabView() = default;

void LabView::change(std::shared_ptr<const SimulatePlan> plan,
                     std::vector<std::shared_ptr<const SimulatePlan>> lanes) {
  impl_->moments.change(*plan);
  impl_->lanes.change(std::move(lanes));
  const SceneModel* scene = plan->input.scene.get();
  impl_->stage.scene = scene;
  impl_->stage.model = scene ? &scene->model : &plan->input.robot.model;
  impl_->plan = std::move(plan);  // the old one goes when nothing looks at it any more
}

void LabView::name_rows(const std::vector<std::string>& rows) {
  if (impl_->rows == rows) return;
  impl_->rows = rows;
  ++impl_->revision;
}

std::uint64_t LabView::revision() const {
  return impl_->revision;
}

std::string LabView::scene_message() const {
  return twinarm::scene_message({impl_->columns.scene, *impl_->plan, impl_->words, impl_->moments,
                                 impl_->stage, impl_->store, impl_->legends, impl_->channels.all(),
                                 impl_->rows});
}

std::shared_ptr<const std::string> LabView::mesh(const std::string& hash) const {
  return impl_->store.mesh(hash);
}

std::shared_ptr<const std::string> LabView::texture(const std::string& hash) const {
  return impl_->store.texture(hash);
}

std::string LabView::frame(const LabFrame& now, const LabFrame* before,
                           const std::vector<std::string>& layers, const FrameFacts& facts) {
  Snapshot moment = impl_->moments.of(now);
  if (before) moment.before = impl_->moments.places(*before);
  impl_->lanes.look(now);
  impl_->lanes.show(before, moment);
  FrameColumns& columns = impl_->columns;
  const bool is_whole = is_finite(moment.x);
  if (is_whole && !facts.stopped) grow_scales(impl_->stage, moment);
  if (is_whole && !facts.looked_back) leave_trail(impl_->stage, moment);
  impl_->draw_layers(moment, is_whole ? layers : std::vector<std::string>{});
  if (impl_->store.take(impl_->stage.list)) ++impl_->revision;
  impl_->take_values(now, moment);
  impl_->take_places(moment);
  columns.number = facts.number;
  columns.flags =
      (facts.stands ? 1u : 0u) | (facts.looked_back ? 2u : 0u) | (facts.stopped ? 4u : 0u);
  columns.time = now.recorded.t;
  columns.stamp = now.input_stamp;
  columns.age = facts.input_age;
  columns.step = static_cast<std::uint64_t>(now.recorded.step);
  return frame_bytes(columns);
}

const DrawList& LabView::drawn() const {
  return impl_->stage.list;
}

std::string LabView::history(const std::vector<const LabFrame*>& frames) {
  for (const LabFrame* frame : frames)
    if (impl_->channels.add_pairs(*frame)) ++impl_->revision;
  FrameColumns& columns = impl_->columns;
  HistoryColumns all;
  all.scene = columns.scene;
  all.channel_count = static_cast<std::uint32_t>(impl_->channels.all().size());
  all.row_count = static_cast<std::uint32_t>(impl_->rows.size());
  for (const LabFrame* frame : frames) {
    impl_->lanes.look(*frame);
    impl_->take_values(*frame, impl_->moments.of(*frame));
    all.time.push_back(frame->recorded.t);
    all.channels.insert(all.channels.end(), columns.channels.begin(), columns.channels.end());
    all.works.insert(all.works.end(), columns.works.begin(), columns.works.end());
  }
  return history_bytes(all);
}

const std::vector<std::string>& LabView::notes() const {
  return impl_->stage.cast.notes;
}

}  // namespace twinarm
