#include "app/lab/session/session_commands.h"

#include "app/lab/parameters/gallery.h"
#include "app/support/files.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// They come many times a second, and the next frame shows them.
bool is_movement(LabCommand::Do what) {
  using Do = LabCommand::Do;
  return what == Do::tip || what == Do::joint || what == Do::turn || what == Do::axes ||
         what == Do::pull;
}

}  // namespace

void SessionCommands::act(const LabCommand& command) {
  using Do = LabCommand::Do;
  s_.has_news = s_.has_news || !is_movement(command.what);
  switch (command.what) {
    case Do::play:
      if (command.on && s_.status.dead) return;
      s_.status.playing = command.on;
      if (command.on) s_.status.at.reset();
      return;
    case Do::step:
      s_.status.playing = false;
      s_.status.at.reset();
      if (!s_.status.dead) s_.loop.step_once(command.count);
      return;
    case Do::speed:
      s_.status.speed = command.value;
      s_.loop.set_pace(command.value);
      return;
    case Do::look:
      s_.status.at = command.at;
      if (command.at) s_.status.playing = false;
      return;
    case Do::set:
      return change(command.names, {});
    case Do::branch:
      return change(command.names, command.at ? command.at : std::optional(s_.loop.run().time()));
    case Do::preset:
      return open_preset(command.name);
    case Do::scene:
      return open_from_gallery(command.name);
    case Do::reset:
      return order(BuildRequest::What::reset);
    case Do::restore:
      s_.pending.add({0, true, {}});
      return order(BuildRequest::What::change);
    default:
      return act_on_hand(command);
  }
}

void SessionCommands::act_on_hand(const LabCommand& command) {
  using Do = LabCommand::Do;
  const double stamp = command.stamp;
  const auto index = static_cast<std::size_t>(command.count);
  if (command.what == Do::drop) {
    s_.hand.release();
    return s_.loop.run().drop();
  }
  s_.loop.repeat_inputs(false);  // who moves it now outranks who did
  if (command.what == Do::hand) return choose_hand(command.name, command.spec);
  s_.input_came = command.came;
  switch (command.what) {
    case Do::tip:
      lead_by(LabHand::Source::drag);
      return s_.hand.tip(command.goal, stamp);
    case Do::joint:
      lead_by(LabHand::Source::joints);
      return s_.hand.joint(index, command.value, stamp);
    case Do::turn:
      lead_by(LabHand::Source::drag);
      return s_.hand.turn(command.point.x(), command.point.y(), command.point.z(), stamp);
    case Do::axes:
      lead_by(LabHand::Source::drag);
      return s_.hand.axes(command.rates, stamp);
    case Do::button:
      return s_.hand.button(index, command.on, stamp);
    case Do::pull:
      if (!s_.loop.run().pull(static_cast<int>(command.count), command.point, command.goal, stamp))
        s_.inbox.note("note", "no force moves that body");
      return;
    default:
      return;
  }
}

// Who grabs the robot leads it from then on.
void SessionCommands::lead_by(LabHand::Source source) {
  if (s_.hand.source() == source) return;
  s_.hand.choose(source);
  s_.has_news = true;
}

void SessionCommands::choose_hand(const std::string& source, const std::string& spec) {
  using Source = LabHand::Source;
  static const std::vector<std::pair<std::string, Source>> all{{"scene", Source::scene},
                                                               {"drag", Source::drag},
                                                               {"joints", Source::joints},
                                                               {"device", Source::device}};
  for (const auto& [name, kind] : all)
    if (name == source) return s_.hand.choose(kind, spec);
  throw InputError({{"command", 0, "hand, source", "there is no '" + source + "'",
                     "give scene, drag, joints or device", "lab.choice"}});
}

// From now on, or from an instant that is remembered.
void SessionCommands::change(const std::vector<std::string>& texts, std::optional<double> at) {
  Asked asked;
  for (const std::string& text : texts) {
    const Change change = parse_change(text);
    if (is_of_lanes(s_.status, change))
      throw InputError(
          {{"command", 0, text, "it is what the lanes differ by",
            "turn another knob, or open the scene without lanes", "lab.lanes-differ"}});
    asked.changes.push_back(change);
  }
  s_.pending.add(std::move(asked));
  if (!at) return order(BuildRequest::What::change);
  s_.status.playing = false;
  order(BuildRequest::What::branch, *at);
}

void SessionCommands::open_preset(const std::string& name) {
  const Preset* preset = find_preset(name);
  if (!preset)
    throw InputError({{"command", 0, "preset", "there is no '" + name + "'",
                       "the state lists them under presets", "lab.unknown-name"}});
  BuildRequest order;
  order.file = find_assets() / "scenes" / preset->scene;
  order.name = preset->name;
  order.words.title = preset->what;
  order.words.file = preset->scene;
  order.hand = preset->hand;
  for (const std::string& text : preset->changes) put(order.changes, parse_change(text));
  open_(std::move(order));
}

void SessionCommands::open_from_gallery(const std::string& name) {
  const GalleryScene* scene = find_scene(gallery_, name);
  if (!scene)
    throw InputError({{"command", 0, "scene", "there is no '" + name + "'",
                       "the state lists them under gallery", "lab.unknown-name"}});
  open_(order_to_open(*scene));
}

void SessionCommands::order(BuildRequest::What what, double at) {
  const std::shared_ptr<const BuildResult> now = s_.timeline.scene();
  BuildRequest order;
  order.what = what;
  order.scene = now->scene;
  order.name = now->order.name;
  order.words = now->order.words;
  order.changes = s_.status.changes;
  order.asked = s_.pending.all();
  order.lanes = now->order.lanes;
  order.at = at;
  open_(std::move(order));
}

// Where a run that goes on begins; null where that is no longer remembered.
Timeline::Frame SessionCommands::start_of(const BuildRequest& order) {
  if (order.what == BuildRequest::What::change)
    return std::make_shared<const LabFrame>(s_.loop.frame());
  Timeline::Frame from = s_.timeline.branch(order.at);
  if (!from) return nullptr;
  s_.loop.repeat_inputs(s_.timeline.known_input(from->recorded.step).goes_on);
  LabBranch branch;
  branch.from = from->recorded.t;
  branch.changes = order.changes;
  branch.number = s_.status.branch ? s_.status.branch->number + 1 : 1;
  s_.status.branch = std::move(branch);
  s_.status.at.reset();
  s_.status.playing = true;
  return from;
}

void SessionCommands::adopt(BuildResult built) {
  const BuildRequest order = built.order;
  if (!order.asked.empty()) s_.pending.finish(order.asked.back().number);
  const bool goes_on =
      order.what == BuildRequest::What::change || order.what == BuildRequest::What::branch;
  if (goes_on && built.scene != s_.timeline.scene()->scene) return;  // another one was opened
  Timeline::Frame from;
  if (goes_on && !(from = start_of(order)))
    return s_.inbox.note("error", "that instant is not remembered any more");
  auto run = std::make_unique<LabRun>(std::move(built.run), s_.hand, from.get());
  LabVariants lanes(order.lanes, std::move(built.lanes), from.get(), s_.loop.names());
  if (from) run->keep_books(*from, s_.loop.names());
  for (const std::string& warning : run->warnings())
    if (!goes_on) s_.inbox.note("warning", warning);
  if (!run->begun_anew().empty()) s_.inbox.note("note", run->begun_anew());
  if (!goes_on) forget();
  if (order.what == BuildRequest::What::open) {
    s_.pending.clear();
    ++s_.status.scene;
    s_.status.scene_name = order.name;
    if (!order.hand.empty()) choose_hand(order.hand, "");
  }
  s_.status.changes = order.changes;
  s_.status.lanes = order.lanes;
  s_.timeline.begin(std::make_shared<const BuildResult>(std::move(built)), run->led());
  s_.loop.begin(std::move(run), std::move(lanes));
  ++s_.change_number;
  s_.changed_at = s_.loop.run().time();
  s_.status.dead.reset();
  s_.is_stale = s_.has_news = true;
  s_.loop.set_pace(s_.status.speed);
}

void SessionCommands::forget() {
  s_.timeline.forget();
  s_.loop.names() = {};
  s_.loop.repeat_inputs(false);
  s_.status.branch.reset();
  s_.status.at.reset();
  s_.status.playing = true;
}

}  // namespace twinarm
