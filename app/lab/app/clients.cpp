#include "app/lab/app/clients.h"

#include "app/lab/server/http_text.h"

namespace twinarm {

void Clients::opened(ClientId client, const std::string& address) {
  const std::lock_guard lock(mutex_);
  now_.clients[client].address = address;
  if (now_.controller == 0) now_.controller = client;
}

void Clients::closed(ClientId client) {
  const std::lock_guard lock(mutex_);
  now_.clients.erase(client);
  std::erase(now_.waiting, client);
  if (now_.controller == client) now_.controller = 0;
  if (now_.controller != 0) return;
  if (!now_.waiting.empty()) {
    now_.controller = now_.waiting.front();
    now_.waiting.erase(now_.waiting.begin());
  } else if (now_.clients.size() == 1) {
    now_.controller = now_.clients.begin()->first;
  }
}

void Clients::take(ClientId client) {
  const std::lock_guard lock(mutex_);
  if (!now_.clients.contains(client) || now_.controller == client) return;
  if (now_.controller == 0)
    now_.controller = client;
  else if (std::ranges::find(now_.waiting, client) == now_.waiting.end())
    now_.waiting.push_back(client);
}

bool Clients::give(ClientId from, ClientId to) {
  const std::lock_guard lock(mutex_);
  if (now_.controller != from || !now_.clients.contains(to)) return false;
  now_.controller = to;
  std::erase(now_.waiting, to);
  return true;
}

bool Clients::has_control(ClientId client) const {
  const std::lock_guard lock(mutex_);
  return now_.controller == client;
}

ClientId Clients::controller(std::string_view secret) const {
  const std::lock_guard lock(mutex_);
  const auto found = now_.clients.find(now_.controller);
  return found != now_.clients.end() && is_secret(secret, found->second.secret) ? now_.controller
                                                                                : 0;
}

std::string Clients::name(ClientId client) const {
  const std::lock_guard lock(mutex_);
  const auto found = now_.clients.find(client);
  return "client " + std::to_string(client) + " at " +
         (found == now_.clients.end() ? "" : found->second.address);
}

void Clients::want_layers(ClientId client, std::vector<std::string> names) {
  const std::lock_guard lock(mutex_);
  if (const auto found = now_.clients.find(client); found != now_.clients.end())
    found->second.layers = std::move(names);
}

void Clients::want_inspection(ClientId client, std::optional<long> body) {
  const std::lock_guard lock(mutex_);
  if (const auto found = now_.clients.find(client); found != now_.clients.end())
    found->second.inspected = body;
}

std::vector<std::string> Clients::View::layers() const {
  std::set<std::string> all;
  for (const auto& [id, client] : clients) all.insert(client.layers.begin(), client.layers.end());
  return {all.begin(), all.end()};
}

namespace {

void write_changes(JsonWriter& json, const std::vector<Change>& changes) {
  json.key("changes").list(
      changes, [&](const Change& change) { json.text(change.path + "=" + change.value); });
}

void write_time(JsonWriter& json, const LabStatus& status) {
  json.members({{"playing", status.playing},
                {"speed", status.speed},
                {"time", status.time},
                {"first", status.first},
                {"last", status.last},
                {"at", status.at}});
  json.key("branch").or_null(status.branch, [&](const auto& branch) {
    json.object([&] {
      json.put("from", branch.from);
      write_changes(json, branch.changes);
      json.put("number", branch.number);
    });
  });
  json.members(
      {{"speed_ratio", status.pace}, {"step", status.step}, {"step_us", 1e6 * status.step_time}});
}

// A recorded operator motion to start with; empty without the assets.
const std::string& example_trace() {
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

void write_variants(JsonWriter& json, const LabStatus& status) {
  json.key("variants");
  if (status.variants.empty()) return json.null();
  std::vector<std::optional<double>> stopped(1);  // the first one's stop is in `dead`
  stopped.insert(stopped.end(), status.variant_ends.begin(), status.variant_ends.end());
  json.object(
      {{"path", status.variants.path}, {"values", status.variants.values}, {"stopped", stopped}});
}

void write_hand(JsonWriter& json, const OperatorStatus& hand) {
  json.key("input").begin_object();
  json.members({{"source", hand.source},
                {"spec", hand.spec},
                {"mapping", hand.mapping},
                {"q", hand.q},
                {"device_name", hand.device},
                {"mode", hand.mode},
                {"gripper", hand.gripper_closed}});
  if (!example_trace().empty()) json.key("trace").text(example_trace());
  json.end_object();
}

void write_end(JsonWriter& json, const LabStatus& status) {
  json.key("failure").or_null(status.failure, [&](const RunFailure& failure) {
    json.object({{"words", failure.words},
                 {"time", failure.time},
                 {"from", failure.from},
                 {"trying", failure.trying},
                 {"remedies", [&] { write_remedies(failure.remedies, json); }}});
  });
}

}  // namespace

std::string state_message(const LabStatus& status, const Clients::View& clients,
                          const std::vector<LabParameter>& parameters,
                          const std::vector<GalleryScene>& gallery) {
  return json_text([&](JsonWriter& json) {
    json.members({{"kind", "state"}, {"scene", status.scene}, {"name", status.scene_name}});
    write_changes(json, status.changes);
    write_variants(json, status);
    json.members(
        {{"controller", clients.controller != 0 ? std::optional(clients.controller) : std::nullopt},
         {"clients", clients.clients.size()},
         {"control_requests", clients.waiting}});
    write_time(json, status);
    write_hand(json, status.hand);
    write_parameters(parameters, json.key("parameters"));
    json.key("presets").list(all_presets(), [&](const Preset& preset) {
      json.object({{"name", preset.name}, {"what", preset.what}});
    });
    json.key("gallery").list(gallery, [&](const GalleryScene& scene) {
      json.object({{"name", scene.name}, {"title", scene.title}, {"look", scene.look}});
    });
    write_end(json, status);
    json.key("notes").list(status.notes, [&](const LabNote& note) {
      json.object({{"n", note.number}, {"level", note.level}, {"text", note.text}});
    });
  });
}

std::string addressed(const std::string& state, ClientId you, const std::string& secret) {
  return "{\"you\": " + std::to_string(you) + ", \"secret\": \"" + secret + "\", " +
         state.substr(state.find_first_not_of("{ \n"));
}

}  // namespace twinarm
