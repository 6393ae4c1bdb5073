#include "app/page/pages.h"

#include "app/data/html_page.h"
#include "app/page/page_layers.h"
#include "app/support/text.h"
#include "app/support/version.h"
#include "app/web/web_bundle.h"

namespace twinarm {
namespace {

// Throws InputError if the program was built without templates; `instead`: an alternative.
void require_form(std::string_view form, std::string_view missing, const std::string& instead) {
  if (form.empty())
    throw InputError("page", "there is no page to fill in", std::string(missing) + "; " + instead,
                     "page.missing");
}

std::string fill_form(std::string_view form, const std::string& title, const std::string& json,
                      const PageBytes& bytes) {
  // "</script>" in a name would end the block of the JSON.
  const std::vector<std::pair<std::string, std::string>> parts{
      {"@TITLE@", escaped(title)},
      {"@RUN@", replace_all(json, "<", "\\u003c")},
      {"@BYTES@", bytes.packed()}};
  std::string html;
  for (const auto& [mark, text] : parts) {  // each once, in this order
    const std::size_t at = form.find(mark);
    html += std::string(form.substr(0, at)) + text;
    form.remove_prefix(at + mark.size());
  }
  return html + std::string(form);
}

constexpr double kMaxRate = 120;     // frames per second: twice what screens show, for slow motion
constexpr double kMaxFrames = 1500;  // of a page
constexpr std::size_t kMaxEntries = 400'000;                // of all its draw lists together
constexpr double kInspectAspect = 1, kReplayAspect = 1.35;  // of the views

// Between two frames: the last frame of the recording is included, none is repeated.
double interval_of(double duration, std::size_t recorded) {
  const double own = static_cast<double>(std::max<std::size_t>(recorded, 2) - 1) / duration;
  const double rate = std::min({kMaxRate, kMaxFrames / duration, own});
  return duration / std::max(1.0, std::ceil(duration * rate - 1e-6));
}

FilmedRun open_film(const std::filesystem::path& file, Progress& progress) {
  const Recording recording(file);
  const double first = recording.frame(0).t, last = recording.frame(recording.size() - 1).t;
  RobotOptions options;
  options.model = file;
  FilmTimes times;
  times.is_film = last > first;
  times.interval = interval_of(std::max(last - first, 1e-9), recording.size());
  if (!times.is_film) times.at = last;
  return film_run(options, times, "auto", progress);
}

// Fewer frames if draw lists are long; keeps the last one.
void reduce_contacts(FilmedRun& run, std::size_t entries_a_frame) {
  const std::size_t count = run.shown.size();
  const std::size_t stride = (count * entries_a_frame + kMaxEntries - 1) / kMaxEntries;
  if (stride < 2) return;
  std::vector<RunInstant> kept;
  for (std::size_t i = 0; i < count; i += stride) kept.push_back(run.shown[i]);
  if ((count - 1) % stride != 0) kept.push_back(run.shown.back());
  run.shown = std::move(kept);
}

}  // namespace

std::string inspect_page(const SimulateInput& input, const State<double>& x,
                         const std::string& inspection, const InspectedJson& words) {
  const WebBundle bundle = web_bundle();
  require_form(bundle.inspect, bundle.missing, "--json needs none");
  const SceneModel* scene = input.scene.get();
  const Model<double>& model = input.robot.model;
  SceneView view = scene ? make_scene_view(*scene) : make_scene_view(input.robot.robot, model);
  const Snapshot snapshot =
      scene ? snapshot_of(*scene, *input.couplings, x, {}) : snapshot_of(model, x);
  look_ahead(view, snapshot);
  look_at(view, snapshot);
  settle(view);
  measure(view, snapshot, Measured::of_picture);
  set_view(view, {}, kInspectAspect);
  PageLayers layers(view);
  layers.add_frame(snapshot);
  layers.add_apart(snapshot);
  layers.show_at_first({"joints"});

  PageBytes bytes;
  const std::string text = json_text([&](JsonWriter& json) {
    json.members({{"title", words.title},
                  {"state", words.state},
                  {"command", command_line(words.command)},
                  {"version", kProgramVersion},
                  {"inspection", inspection}});
    layers.write(json, bytes);
    write_view(json, view);
  });
  return fill_form(bundle.inspect, words.title, text, bytes);
}

ReplayPage replay_page(const std::filesystem::path& file) {
  const WebBundle bundle = web_bundle();
  require_form(bundle.replay, bundle.missing, "--csv and --json need none");
  Progress progress(true);
  FilmedRun run = open_film(file, progress);
  SceneView view = view_of(run);
  set_view(view, {}, kReplayAspect);
  draw(view, run.snapshot(run.shown.back()), parse_overlays("all"));
  reduce_contacts(run, view.list.instances.size());
  PageLayers layers(view);
  PageChannels channels(run);
  for (const RunInstant& instant : run.shown) {
    check_interrupt();
    const Snapshot snapshot = run.snapshot(instant);
    layers.add_frame(snapshot);
    channels.add_frame(run.recording->frame(run.recording->at(instant.x.t, "export")), snapshot);
  }
  ReplayPage page;
  page.frames = run.shown.size();
  const double duration = run.shown.back().x.t - run.shown.front().x.t;
  if (duration > 0) page.rate = static_cast<double>(page.frames - 1) / duration;

  PageBytes bytes;
  const std::string text = json_text([&](JsonWriter& json) {
    write_facts(json, run, view, page.rate);
    channels.write(json, bytes);
    layers.write(json, bytes);
    write_view(json, view);
  });
  page.html = fill_form(bundle.replay, view.name, text, bytes);
  return page;
}

}  // namespace twinarm
