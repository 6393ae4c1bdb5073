#include "app/web/page_channels.h"

#include <algorithm>
#include <map>

#include "app/dynamics/robot_table.h"
#include "collision/import/number_text.h"

namespace twinarm {
namespace {

// "links/arm1/x": what kind of quantity it is, and of what.
std::pair<std::string, std::string> kind_and_owner(const std::string& column) {
  const std::size_t slash = column.find('/');
  if (slash == std::string::npos) return {"energy", column.substr(0, column.find("_energy"))};
  const std::string head = column.substr(0, slash), rest = column.substr(slash + 1);
  if (head == "q") return {"coordinate", rest};
  if (head == "qd") return {"rate", rest};
  return {"position", rest.substr(0, rest.rfind('/'))};
}

}  // namespace

PageChannels::PageChannels(const FilmedRun& run) : run_(run), header_(run.recording->header()) {
  for (const RecordedColumn& column : header_.columns) {
    const auto [kind, of] = kind_and_owner(column.name);
    add_channel(column.name, column.unit, kind, of);
  }
  elastic_ = channels_.size();
  if (!header_.couplings.empty()) add_channel("elastic_energy", "J", "energy", "springs");
  first_pull_ = channels_.size();
  for (const std::string& name : header_.couplings)
    add_channel("coupling/" + name, "N", "coupling", name);
  find_pairs();
  find_led_joints();
}

std::size_t PageChannels::add_channel(const std::string& name, const std::string& unit,
                                      const std::string& kind, const std::string& of) {
  channels_.push_back({name, unit, kind, of, {}});
  return channels_.size() - 1;
}

std::string PageChannels::name_of_geometry(int id) const {
  const auto i = static_cast<std::size_t>(id);
  return i < header_.geometries.size() ? header_.geometries[i] : std::to_string(id);
}

// Those that touch in a frame of the page.
void PageChannels::find_pairs() {
  for (const RunInstant& instant : run_.shown)
    for (const RecordedContact& c : instant.contacts) pairs_.emplace_back(c.a, c.b);
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  first_pair_ = channels_.size();
  for (const auto& [a, b] : pairs_) {
    const std::string pair = name_of_geometry(a) + "-" + name_of_geometry(b);
    add_channel("contact/" + pair, "N", "contact", pair);
  }
}

// Joints that a hand turns, each once; of the recorded columns the one of the same name.
void PageChannels::find_led_joints() {
  if (!run_.plan.input.scene) return;
  const Coordinates& coordinates = run_.plan.input.robot.coordinates;
  const auto place_of = [&](const std::string& name) {
    const auto is_it = [&](const PageChannel& channel) { return channel.name == name; };
    return static_cast<std::size_t>(std::find_if(channels_.begin(), channels_.end(), is_it) -
                                    channels_.begin());
  };
  const auto& couplings = run_.plan.input.scene->couplings;
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    if (couplings[c].target == CouplingTarget::Kind::start) continue;
    for (const std::string& turned : couplings[c].driven.turned) {
      const NamedJoint* joint = coordinates.find(turned);
      if (!joint || joint->components().size() != 1) continue;
      const std::string of = component_name(coordinates, *joint, joint->components().front());
      const std::size_t column = place_of("q/" + of);
      if (column == channels_.size() || place_of("target/" + of) < channels_.size()) continue;
      const std::string unit = channels_[column].unit;
      const std::size_t target = add_channel("target/" + of, unit, "target", of);
      led_.push_back({c, column, target, add_channel("error/" + of, unit, "error", of), joint, 0});
    }
  }
}

void PageChannels::add_led(double t) {
  for (const Led& led : led_) {
    const KvrSample& kvr = run_.plan.input.couplings->target(led.coupling, t);
    const double target = coordinates_of(*led.joint, kvr.x)[led.component];
    channels_[led.target].values.push_back(target);
    channels_[led.error].values.push_back(channels_[led.column].values.back() - target);
  }
}

void PageChannels::add_contacts(const RecordedFrame& frame) {
  std::map<std::pair<int, int>, Vector3> forces;
  for (const RecordedContact& c : frame.contacts) {
    const auto [place, is_new] = forces.try_emplace({c.a, c.b}, Vector3::Zero());
    place->second += c.force;
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto found = forces.find(pairs_[i]);
    const double size = found == forces.end() ? 0 : found->second.norm();
    channels_[first_pair_ + i].values.push_back(size);
  }
}

void PageChannels::add_frame(const RecordedFrame& frame, const Moment& moment) {
  times_.push_back(frame.t);
  for (std::size_t i = 0; i < frame.values.size() && i < header_.columns.size(); ++i)
    channels_[i].values.push_back(frame.values[i]);
  if (!header_.couplings.empty()) channels_[elastic_].values.push_back(moment.elastic);
  for (std::size_t c = 0; c < header_.couplings.size(); ++c) {
    PageChannel& channel = channels_[first_pull_ + c];
    channel.values.push_back(c < frame.pulls.size() ? frame.pulls[c].norm() : 0);
    if (c < moment.pulls.size() && moment.pulls[c].kind == ShownPull::Kind::couple)
      channel.unit = "N m";
  }
  add_contacts(frame);
  add_led(frame.t);
  add_ledgers(frame);
}

void PageChannels::add_ledgers(const RecordedFrame& frame) {
  end_.assign(run_.recording->rows().size(), 0);
  for (std::size_t i = 0; i < frame.rows.size(); ++i) end_.at(frame.rows[i]) = frame.works[i];
  works_.insert(works_.end(), end_.begin(), end_.end());
  const std::size_t first = momenta_.size();
  momenta_.resize(first + 6 * run_.recording->momentum_rows().size(), 0);
  for (std::size_t i = 0; i < frame.momentum_rows.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c)
      momenta_.at(first + 6 * frame.momentum_rows[i] + c) =
          frame.momenta.at(2 * i + c / 3)[static_cast<Eigen::Index>(c % 3)];
}

void PageChannels::write(JsonWriter& json, PageBytes& bytes) const {
  bytes.add(json, "times", times_);
  json.key("channels").begin_array();
  for (const PageChannel& channel : channels_) {
    json.begin_object();
    json.key("name").text(channel.name);
    json.key("unit").text(channel.unit);
    json.key("kind").text(channel.kind);
    json.key("of").text(channel.of);
    bytes.add(json, "values", channel.values);
    json.end_object();
  }
  json.end_array();
  json.key("ledger").begin_object();
  json.key("rows").texts(run_.recording->rows());
  json.key("end").begin_array();
  for (const double work : end_) json.text(number_text(work));
  json.end_array();
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
