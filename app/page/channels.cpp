
#include <zlib.h>

#include "app/data/html_page.h"
#include "app/page/page_layers.h"
#include "app/robot/robot_output.h"

namespace twinarm {

void PageBytes::write_place(JsonWriter& json, const void* data, std::size_t count, std::size_t size,
                            char kind) {
  const std::size_t at = append_array(bytes_, data, count * size);
  json.object({{"at", at}, {"count", count}, {"type", kind + std::to_string(8 * size)}});
}

std::string PageBytes::packed() const {
  uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
  std::string deflated(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes_.data()),
                               static_cast<uLong>(bytes_.size()), 8);
  if (result != Z_OK) throw std::runtime_error("zlib: compress2 failed");
  deflated.resize(size);
  return base64_of(deflated);
}

// With the contacts of all frames of the page.
PageChannels::PageChannels(const FilmedRun& run)
    : run_(run), channels_(run.plan.input, run.recording->header()) {
  std::vector<std::pair<int, int>> pairs;
  for (const RunInstant& instant : run_.shown)
    for (const RecordedContact& c : instant.contacts) pairs.emplace_back(c.a, c.b);
  std::ranges::sort(pairs);
  for (const auto& [a, b] : pairs) channels_.add_pair(a, b);
  if (const SceneModel* scene = run_.plan.input.scene.get())
    channels_.add_led_joints(run_.plan.input.robot.coordinates, scene->couplings);
  values_.resize(channels_.all().size());
}

void PageChannels::add_frame(const RecordedFrame& frame, const Snapshot& snapshot) {
  times_.push_back(frame.t);
  channels_.values(frame, snapshot, run_.plan.input.couplings.get(), now_);
  for (std::size_t i = 0; i < now_.size(); ++i) values_[i].push_back(now_[i]);
  end_ = works_by_row(frame, run_.recording->rows().size());
  works_.insert(works_.end(), end_.begin(), end_.end());
  const std::vector<double> momenta = momenta_by_row(frame, run_.recording->momentum_rows().size());
  momenta_.insert(momenta_.end(), momenta.begin(), momenta.end());
}

void PageChannels::write(JsonWriter& json, PageBytes& bytes) const {
  bytes.add(json, "times", times_);
  std::size_t channel = 0;
  json.key("channels").list(channels_.all(), [&](const RunColumn& column) {
    json.object([&] {
      write_channel(json, column);
      bytes.add(json, "values", values_[channel++]);
    });
  });
  json.key("energy_balance").object([&] {
    json.key("rows").texts(run_.recording->rows());
    json.key("end").list(end_, [&](const double work) { json.text(number_text(work)); });
    bytes.add(json, "works", works_);
  });
  json.key("momentum").object([&] {
    json.key("rows").texts(run_.recording->momentum_rows());
    bytes.add(json, "values", momenta_);
  });
  const std::vector<std::string>& names = run_.model().body_name;
  json.key("bodies").texts({names.begin() + 1, names.end()});
}

RunChannels::RunChannels(const SimulateInput& input, const RecordingHeader& header)
    : all_(run_columns(input.robot)),
      geometries_(header.geometries),
      columns_(all_.size()),
      pulls_(header.couplings.size()) {
  elastic_ = all_.size();
  if (pulls_ > 0) add("elastic_energy", "J", "energy", "springs");
  first_pull_ = all_.size();
  for (std::size_t c = 0; c < pulls_; ++c) {
    const bool is_couple = input.scene && c < input.scene->couplings.size() &&
                           kind_of_coupling(*input.scene, c) == ShownCouplingForce::Kind::couple;
    add("coupling/" + header.couplings[c], is_couple ? "N m" : "N", "coupling",
        header.couplings[c]);
  }
}

std::size_t RunChannels::add(const std::string& name, const std::string& unit,
                             const std::string& kind, const std::string& of) {
  all_.push_back({name, unit, kind, of});
  return all_.size() - 1;
}

std::size_t RunChannels::place_of(const std::string& name) const {
  return static_cast<std::size_t>(std::ranges::find(all_, name, &RunColumn::name) - all_.begin());
}

bool RunChannels::add_pair(int a, int b) {
  if (pairs_.size() >= kMaxPairs || !pairs_.try_emplace({a, b}, all_.size()).second) return false;
  const std::string pair = name_of_pair(geometries_, a, b);
  add("contact/" + pair, "N", "contact", pair);
  return true;
}

// Each joint once, if it has a recorded column.
void RunChannels::add_led_joints(const Coordinates& coordinates,
                                 const std::vector<SceneCoupling>& couplings) {
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    for (const std::string& name : couplings[c].driven.turned) {
      const NamedJoint* joint = coordinates.find(name);
      if (!joint || joint->components().size() != 1) continue;
      const std::string of = component_name(coordinates, *joint, joint->components().front());
      const std::size_t column = place_of("q/" + of);
      if (column == all_.size() || place_of("target/" + of) < all_.size()) continue;
      const std::string unit = all_[column].unit;
      const std::size_t target = add("target/" + of, unit, "target", of);
      led_.push_back({c, column, target, add("error/" + of, unit, "error", of), *joint});
    }
  }
}

void RunChannels::values(const RecordedFrame& frame, const Snapshot& snapshot,
                         SceneCouplings* couplings, std::vector<double>& values) const {
  values.assign(all_.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < std::min(frame.values.size(), columns_); ++i)
    values[i] = frame.values[i];
  if (pulls_ > 0) values[elastic_] = snapshot.elastic;
  for (std::size_t c = 0; c < pulls_; ++c)
    values[first_pull_ + c] =
        c < frame.coupling_forces.size() ? frame.coupling_forces[c].norm() : 0;
  std::map<std::size_t, Vector3> forces;
  for (const auto& [pair, place] : pairs_) forces[place] = Vector3::Zero();
  for (const RecordedContact& c : frame.contacts)
    if (const auto pair = pairs_.find({c.a, c.b}); pair != pairs_.end())
      forces[pair->second] += c.force;
  for (const auto& [place, force] : forces) values[place] = force.norm();
  if (!couplings) return;
  for (const Led& led : led_) {
    const TargetSample& kvr = couplings->target(led.coupling, frame.t);
    values[led.target] = coordinates_of(led.joint, kvr.x).front();
    values[led.error] = values[led.column] - values[led.target];
  }
}

void write_channel(JsonWriter& json, const RunColumn& channel) {
  json.members(
      {{"name", channel.name}, {"unit", channel.unit}, {"kind", channel.kind}, {"of", channel.of}});
}

}  // namespace twinarm
