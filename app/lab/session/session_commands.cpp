#include "app/lab/session/lab_session.h"

#include "app/support/text.h"

namespace twinarm {
namespace {

// Values at the start: with another one the run restarts.
bool is_of_start(const Change& change) {
  return change.path.starts_with("robot[") && change.path.find("].q.") != std::string::npos;
}

// By name, in a list of the message `state`. Throws InputError: there is none.
template <class Entry>
const Entry& named(const std::string& name, const std::vector<Entry>& all, const char* kind,
                   const std::string& list) {
  const auto found = std::ranges::find(all, name, &Entry::name);
  if (found == all.end())
    throw InputError({{"command", 0, kind, "there is no '" + name + "'",
                       "choose one of `" + list + "` in the message state", "lab.unknown-name"}});
  return *found;
}

}  // namespace

void SessionCommands::act(const LabCommand& command) {
  const std::string_view what = command.what;
  s_.has_news = s_.has_news || !is_movement(what);
  if (what == "play") {
    if (command.on && s_.status.failure) return;
    s_.status.playing = command.on;
    if (command.on) s_.status.at.reset();
  } else if (what == "step") {
    s_.status.playing = false;
    s_.status.at.reset();
    if (!s_.status.failure) s_.loop.request_steps(command.count);
  } else if (what == "speed") {
    s_.status.speed = command.value;
    s_.loop.set_pace(command.value);
  } else if (what == "seek") {
    s_.status.at = command.at;
    if (command.at) s_.status.playing = false;
  } else if (what == "set") {
    change(command.names, {});
  } else if (what == "branch") {
    change(command.names, command.at ? command.at : std::optional(s_.loop.run().view().time()));
  } else if (what == "preset") {
    open_preset(command.name);
  } else if (what == "scene") {
    open_(order_to_open(named(command.name, gallery_, "scene", "gallery")));
  } else if (what == "edit") {
    edit({command.name, command.spec});
  } else if (what == "reset") {
    request(BuildRequest::What::reset);
  } else if (what == "reset_parameters") {
    s_.add({0, true, {}});
    request(BuildRequest::What::change);
  } else {
    act_on_input(command);
  }
}

void SessionCommands::act_on_input(const LabCommand& command) {
  using Source = OperatorInput::Source;
  const std::string_view what = command.what;
  const auto index = static_cast<std::size_t>(command.count);
  if (what == "release") {
    s_.hand.release();
    return s_.loop.run().release_mouse();
  }
  s_.loop.repeat_inputs(false);  // new input takes precedence over repeated input
  if (what == "input") return choose_source(command.name, command.spec);
  s_.input_came = command.came;
  s_.hand.set_stamp(command.stamp);
  if (what == "joint") {
    switch_source(Source::joints);
    s_.hand.joint(index, command.value);
  } else if (what == "button") {
    s_.hand.button(index, command.on);
  } else if (what == "drag_body") {
    if (!s_.loop.run().drag(static_cast<int>(command.count), command.point, command.goal))
      s_.inbox.note("note", "the body is fixed or has prescribed motion: no force moves it");
  } else {
    switch_source(Source::drag);
    if (what == "drag_stylus") s_.hand.tip(command.goal);
    if (what == "rotate_stylus") s_.hand.rotate_stylus(command.point);
    if (what == "axes") s_.hand.axes(command.rates);
  }
}

void SessionCommands::switch_source(OperatorInput::Source source) {
  if (s_.hand.source() == source) return;
  s_.hand.choose(source);
  s_.has_news = true;
}

void SessionCommands::choose_source(const std::string& source, const std::string& spec) {
  for (std::size_t i = 0; i < OperatorInput::kSourceNames.size(); ++i)
    if (source == OperatorInput::kSourceNames[i])
      return s_.hand.choose(static_cast<OperatorInput::Source>(i), spec);
  throw InputError({{"command", 0, "hand, source", "there is no '" + source + "'",
                     "give scene, drag, joints or device", "lab.choice"}});
}

// From now on, or from an instant of the history.
void SessionCommands::change(const std::vector<std::string>& texts, std::optional<double> at) {
  PendingChange pending;
  for (const std::string& text : texts) {
    const Change change = parse_change(text);
    if (is_varied(s_.status, change))
      throw InputError({{"command", 0, text, "this parameter is varied between the variants",
                         "change another parameter, or open the scene without variants",
                         "lab.variants-differ"}});
    pending.changes.push_back(change);
  }
  const bool is_restart = std::ranges::any_of(pending.changes, is_of_start);
  s_.add(std::move(pending));
  if (is_restart) return request(BuildRequest::What::reset);
  if (!at) return request(BuildRequest::What::change);
  s_.status.playing = false;
  request(BuildRequest::What::branch, *at);
}

void SessionCommands::open_preset(const std::string& name) {
  const Preset& preset = named(name, all_presets(), "preset", "presets");
  BuildRequest request;
  request.file = find_assets() / "scenes" / preset.scene;
  request.name = preset.name;
  request.words = {preset.what, preset.scene, {}};
  request.hand = preset.hand;
  for (const std::string& text : preset.changes) put(request.changes, parse_change(text));
  open_(std::move(request));
}

void SessionCommands::edit(const SceneEdit& edit) {
  if (std::ranges::find(SceneEdit::kNames, edit.what) == SceneEdit::kNames.end())
    throw InputError(
        {{"command", 0, "edit, what", "there is no '" + edit.what + "'",
          name_remedy(edit.what, {SceneEdit::kNames.begin(), SceneEdit::kNames.end()}, "edits"),
          "lab.unknown-name"}});
  BuildRequest request = request_of(BuildRequest::What::open);
  request.edit = edit;
  if (edit.what == "link-spring" || edit.what == "joint-springs") request.hand = "drag";
  open_(std::move(request));
}

void SessionCommands::request(BuildRequest::What what, double at) {
  BuildRequest request = request_of(what);
  request.at = at;
  open_(std::move(request));
}

BuildRequest SessionCommands::request_of(BuildRequest::What what) const {
  const std::shared_ptr<const BuildResult> now = s_.timeline.scene();
  BuildRequest request;
  request.what = what;
  request.scene = now->scene;
  request.name = now->request.name;
  request.words = now->request.words;
  request.changes = s_.status.changes;
  request.pending = s_.pending;
  request.variants = now->request.variants;
  return request;
}

// First frame of a continued run; null: no longer in the history.
Timeline::Frame SessionCommands::start_of(const BuildRequest& request) {
  if (request.what == BuildRequest::What::change)
    return std::make_shared<const LabFrame>(s_.loop.frame());
  Timeline::Frame from = s_.timeline.branch(request.at);
  if (!from) return nullptr;
  s_.hand.renew();  // without the velocity and the force that the run left has given it
  s_.loop.repeat_inputs(true);
  const int number = s_.status.branch ? s_.status.branch->number + 1 : 1;
  s_.status.branch = LabBranch{from->recorded.t, request.changes, number};
  s_.status.at.reset();
  s_.status.playing = true;
  return from;
}

void SessionCommands::adopt(BuildResult built) {
  const BuildRequest request = built.request;
  if (!request.pending.empty()) s_.finish(request.pending.back().number);
  const bool goes_on =
      request.what == BuildRequest::What::change || request.what == BuildRequest::What::branch;
  if (goes_on && built.scene != s_.timeline.scene()->scene) return;  // another scene was opened
  Timeline::Frame from;
  if (!goes_on) s_.hand.restart();
  if (goes_on && !(from = start_of(request)))
    return s_.inbox.note("error", "that time is no longer in the history");
  auto run = std::make_unique<LabRun>(std::move(built.run), s_.hand, from.get());
  LabVariants variants(request.variants, std::move(built.variants), from.get(), s_.loop.names());
  if (from) run->carry_over_energy(*from, s_.loop.names());
  if (request.what == BuildRequest::What::open && !request.edit)
    for (const std::string& warning : run->warnings()) s_.inbox.note("warning", warning);
  if (!run->restart_reason().empty()) s_.inbox.note("note", run->restart_reason());
  if (!goes_on) {
    s_.timeline.clear();
    s_.loop.names() = {};
    s_.loop.repeat_inputs(false);
    s_.status.branch.reset();
    s_.status.at.reset();
    s_.status.playing = request.pending.empty() || s_.status.playing;  // a start pose, in pause
  }
  if (request.what == BuildRequest::What::open) {
    s_.pending.clear();
    ++s_.status.scene;
    s_.status.scene_name = request.name;
    if (!request.hand.empty()) choose_source(request.hand, "");
  }
  s_.status.changes = request.changes;
  s_.status.variants = request.variants;
  s_.timeline.begin(std::make_shared<const BuildResult>(std::move(built)),
                    run->input_override().couplings());
  s_.loop.begin(std::move(run), std::move(variants));
  ++s_.change_number;
  s_.changed_at = s_.loop.run().view().time();
  s_.status.failure.reset();
  s_.is_stale = s_.has_news = true;
  s_.loop.set_pace(s_.status.speed);
}

}  // namespace twinarm
