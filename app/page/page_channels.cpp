#include "app/page/page_channels.h"

#include <algorithm>

#include "solver/support/number_text.h"

namespace twinarm {

// Pairs are those that touch in a frame of the page.
PageChannels::PageChannels(const FilmedRun& run)
    : run_(run), channels_(run.plan.input, run.recording->header()) {
  std::vector<std::pair<int, int>> pairs;
  for (const RunInstant& instant : run_.shown)
    for (const RecordedContact& c : instant.contacts) pairs.emplace_back(c.a, c.b);
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [a, b] : pairs) channels_.add_pair(a, b);
  if (const SceneModel* scene = run_.plan.input.scene.get())
    channels_.add_led_joints(run_.plan.input.robot.coordinates, scene->couplings);
  values_.resize(channels_.all().size());
}

void PageChannels::add_frame(const RecordedFrame& frame, const Moment& moment) {
  times_.push_back(frame.t);
  channels_.values(frame, moment, run_.plan.input.couplings.get(), now_);
  for (std::size_t i = 0; i < now_.size(); ++i) values_[i].push_back(now_[i]);
  end_ = works_by_row(frame, run_.recording->rows().size());
  works_.insert(works_.end(), end_.begin(), end_.end());
  const std::vector<double> momenta = momenta_by_row(frame, run_.recording->momentum_rows().size());
  momenta_.insert(momenta_.end(), momenta.begin(), momenta.end());
}

void PageChannels::write(JsonWriter& json, PageBytes& bytes) const {
  bytes.add(json, "times", times_);
  json.key("channels").begin_array();
  for (std::size_t i = 0; i < channels_.all().size(); ++i) {
    const RunColumn& channel = channels_.all()[i];
    json.begin_object();
    write_channel(json, channel);
    bytes.add(json, "values", values_[i]);
    json.end_object();
  }
  json.end_array();
  json.key("ledger").begin_object();
  json.key("rows").texts(run_.recording->rows());
  json.key("end").list(end_, [&](const double work) { json.text(number_text(work)); });
  bytes.add(json, "works", works_);
  json.end_object();
  json.key("momentum").begin_object();
  json.key("rows").texts(run_.recording->momentum_rows());
  bytes.add(json, "values", momenta_);
  json.end_object();
  std::vector<std::string> bodies;
  const Model<double>& model = run_.model();
  bodies.assign(model.body_name.begin() + 1, model.body_name.end());
  json.key("bodies").texts(bodies);
}

}  // namespace twinarm
