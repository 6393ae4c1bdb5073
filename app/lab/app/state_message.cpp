#include "app/lab/app/state_message.h"

#include <filesystem>

#include "app/data/json_writer.h"
#include "app/lab/parameters/presets.h"
#include "app/support/find_assets.h"

namespace twinarm {
namespace {

long as_long(ClientId client) {
  return static_cast<long>(client);
}

void write_changes(JsonWriter& json, const std::vector<Change>& changes) {
  json.key("changes").list(
      changes, [&](const Change& change) { json.text(change.path + "=" + change.value); });
}

void write_audience(JsonWriter& json, const Audience::View& audience) {
  json.key("holder");
  if (audience.holder != 0)
    json.count(as_long(audience.holder));
  else
    json.null();
  json.key("clients").count(static_cast<long>(audience.clients.size()));
  json.key("asked").list(audience.asked,
                         [&](const ClientId client) { json.count(as_long(client)); });
}

void write_time(JsonWriter& json, const LabStatus& status) {
  json.members({{"playing", status.playing},
                {"speed", status.speed},
                {"time", status.time},
                {"first", status.first},
                {"last", status.last}});
  json.key("at");
  if (status.at)
    json.number(*status.at);
  else
    json.null();
  json.key("branch");
  if (status.branch) {
    json.begin_object();
    json.key("from").number(status.branch->from);
    write_changes(json, status.branch->changes);
    json.key("number").count(status.branch->number);
    json.end_object();
  } else {
    json.null();
  }
  json.members({{"pace", status.pace}, {"step", status.step}, {"step_us", 1e6 * status.step_time}});
}

// A recorded hand to begin with; empty where the assets are not there.
const std::string& recorded_hand() {
  static const std::string file = [] {
    try {
      const auto trace = std::filesystem::absolute(find_assets()) / "traces/synthetic_seed1.csv";
      return std::filesystem::is_regular_file(trace) ? trace.lexically_normal().string() : "";
    } catch (const std::exception&) {
      return std::string();
    }
  }();
  return file;
}

void write_lanes(JsonWriter& json, const LabStatus& status) {
  json.key("lanes");
  if (status.lanes.empty()) return json.null();
  json.begin_object();
  json.members({{"path", status.lanes.path}, {"values", status.lanes.values}});
  json.key("stopped").begin_array();
  json.null();  // the first, of which `dead` tells
  for (const std::optional<double>& end : status.lane_ends)
    if (end)
      json.number(*end);
    else
      json.null();
  json.end_array();
  json.end_object();
}

void write_hand(JsonWriter& json, const LabHandStatus& hand) {
  json.key("hand").begin_object();
  json.members({{"source", hand.source},
                {"spec", hand.spec},
                {"mapping", hand.mapping},
                {"q", hand.q},
                {"felt", hand.felt},
                {"mode", hand.mode},
                {"gripper", hand.gripper_closed}});
  if (!recorded_hand().empty()) json.key("trace").text(recorded_hand());
  json.end_object();
}

void write_end(JsonWriter& json, const LabStatus& status) {
  json.key("dead");
  if (!status.dead) return json.null();
  const LabEnd& dead = *status.dead;
  json.begin_object();
  json.members({{"words", dead.words},
                {"time", dead.time},
                {"from", dead.from},
                {"quantity", dead.quantity},
                {"body", dead.body},
                {"spring", dead.spring}});
  json.key("remedies");
  write_remedies(dead.remedies, json);
  json.end_object();
}

void write_notes(JsonWriter& json, const std::vector<LabNote>& notes) {
  json.key("notes").list(notes, [&](const LabNote& note) {
    json.object({{"n", note.number}, {"level", note.level}, {"text", note.text}});
  });
}

}  // namespace

std::string state_message(const LabStatus& status, const Audience::View& audience,
                          const std::vector<Knob>& knobs,
                          const std::vector<GalleryScene>& gallery) {
  JsonWriter json;
  json.begin_object();
  json.members({{"kind", "state"},
                {"scene", status.scene},
                {"name", status.scene_name},
                {"building", status.building}});
  write_changes(json, status.changes);
  write_lanes(json, status);
  write_audience(json, audience);
  write_time(json, status);
  write_hand(json, status.hand);
  json.key("knobs");
  write_knobs(knobs, json);
  json.key("presets");
  write_presets(json);
  json.key("gallery");
  write_gallery(gallery, json);
  write_end(json, status);
  write_notes(json, status.notes);
  json.end_object();
  return json.str();
}

std::string addressed(const std::string& state, ClientId you, const std::string& secret) {
  return "{\"you\": " + std::to_string(you) + ", \"secret\": \"" + secret + "\", " +
         state.substr(state.find_first_not_of("{ \n"));
}

}  // namespace twinarm
