// What the session does when it is told something.
#include <algorithm>

#include "app/lab/parameters/presets.h"
#include "app/lab/session/lab_session.h"
#include "app/support/find_assets.h"
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

void LabSession::take_commands() {
  std::deque<LabCommand> commands;
  std::deque<Built> built;
  std::optional<long> failed;
  {
    const std::lock_guard lock(mutex_);
    commands.swap(commands_);
    built.swap(built_);
    std::swap(failed, failed_);
  }
  for (const LabCommand& command : commands) try {
      act(command);
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults()) note("error", to_string(fault));
    } catch (const std::exception& error) {
      note("error", error.what());
    }
  if (failed) done_with(*failed);
  for (Built& one : built) {
    const auto done = one.order.done;
    try {
      adopt(std::move(one));
      publish();  // its start is seen and remembered, however soon steps follow
      if (done) done("");
    } catch (const std::exception& error) {
      note("error", error.what());
      if (done) done(error.what());
    }
  }
}

void LabSession::act(const LabCommand& command) {
  using Do = LabCommand::Do;
  is_news_ = is_news_ || !is_movement(command.what);
  switch (command.what) {
    case Do::play:
      if (command.on && status_.dead) return;
      status_.playing = command.on;
      if (command.on) status_.at.reset();
      return;
    case Do::step:
      status_.playing = false;
      status_.at.reset();
      if (!status_.dead) steps_left_ = command.count;
      return;
    case Do::speed:
      status_.speed = command.value;
      pace_.begin(Clock::now(), run_->time(), status_.speed);
      return;
    case Do::look:
      status_.at = command.at;
      if (command.at) status_.playing = false;
      return;
    case Do::set:
      return change(command.names, {});
    case Do::branch:
      return change(command.names, command.at ? command.at : std::optional(run_->time()));
    case Do::preset:
      return preset(command.name);
    case Do::scene:
      return open_from_gallery(command.name);
    case Do::reset:
      return order(Order::What::reset, 0);
    case Do::restore:
      ask({0, true, {}});
      return order(Order::What::change, 0);
    default:
      return act_on_hand(command);
  }
}

void LabSession::act_on_hand(const LabCommand& command) {
  using Do = LabCommand::Do;
  const double stamp = command.stamp;
  const auto index = static_cast<std::size_t>(command.count);
  if (command.what == Do::drop) {
    hand_.release();
    return run_->drop();
  }
  does_again_ = false;  // who moves it now outranks who did
  if (command.what == Do::hand) return choose_hand(command.name, command.spec);
  input_came_ = command.came;
  switch (command.what) {
    case Do::tip:
      lead_by(LabHand::Source::drag);
      return hand_.tip(command.goal, stamp);
    case Do::joint:
      lead_by(LabHand::Source::joints);
      return hand_.joint(index, command.value, stamp);
    case Do::turn:
      lead_by(LabHand::Source::drag);
      return hand_.turn(command.point.x(), command.point.y(), command.point.z(), stamp);
    case Do::axes:
      lead_by(LabHand::Source::drag);
      return hand_.axes(command.rates, stamp);
    case Do::button:
      return hand_.button(index, command.on, stamp);
    case Do::pull:
      if (!run_->pull(static_cast<int>(command.count), command.point, command.goal, stamp))
        note("note", "no force moves that body");
      return;
    default:
      return;
  }
}

// Who grabs the robot leads it from then on.
void LabSession::lead_by(LabHand::Source source) {
  if (hand_.source() == source) return;
  hand_.choose(source);
  is_news_ = true;
}

void LabSession::choose_hand(const std::string& source, const std::string& spec) {
  using Source = LabHand::Source;
  static const std::vector<std::pair<std::string, Source>> all{{"scene", Source::scene},
                                                               {"drag", Source::drag},
                                                               {"joints", Source::joints},
                                                               {"device", Source::device}};
  for (const auto& [name, kind] : all)
    if (name == source) return hand_.choose(kind, spec);
  throw InputError({{"command", 0, "hand, source", "there is no '" + source + "'",
                     "give scene, drag, joints or device"}});
}

// From now on, or from an instant that is remembered.
void LabSession::change(const std::vector<std::string>& texts, std::optional<double> at) {
  Asked asked;
  for (const std::string& text : texts) {
    const Change change = parse_change(text);
    if (is_of_lanes(change))
      throw InputError({{"command", 0, text, "it is what the lanes differ by",
                         "turn another knob, or open the scene without lanes"}});
    asked.changes.push_back(change);
  }
  ask(std::move(asked));
  if (!at) return order(Order::What::change, 0);
  status_.playing = false;
  order(Order::What::branch, *at);
}

bool LabSession::is_of_lanes(const Change& change) const {
  return !status_.lanes.empty() && change.path == status_.lanes.path;
}

void LabSession::preset(const std::string& name) {
  const Preset* preset = find_preset(name);
  if (!preset)
    throw InputError({{"command", 0, "preset", "there is no '" + name + "'",
                       "the state lists them under presets"}});
  Order order;
  order.file = find_assets() / "scenes" / preset->scene;
  order.name = preset->name;
  order.words.title = preset->what;
  order.words.file = preset->scene;
  order.hand = preset->hand;
  for (const std::string& text : preset->changes) put(order.changes, parse_change(text));
  open(std::move(order));
}

void LabSession::open_from_gallery(const std::string& name) {
  const GalleryScene* scene = find_scene(gallery_, name);
  if (!scene)
    throw InputError({{"command", 0, "scene", "there is no '" + name + "'",
                       "the state lists them under gallery"}});
  open(order_to_open(*scene));
}

void LabSession::ask(Asked asked) {
  asked.number = ++asked_count_;
  asked_.push_back(std::move(asked));
}

void LabSession::done_with(long number) {
  while (!asked_.empty() && asked_.front().number <= number) asked_.pop_front();
}

void LabSession::order(Order::What what, double at) {
  Order order;
  order.what = what;
  order.scene = scene_->scene;
  order.name = scene_->order.name;
  order.words = scene_->order.words;
  order.changes = status_.changes;
  order.asked.assign(asked_.begin(), asked_.end());
  order.lanes = scene_->order.lanes;
  order.at = at;
  open(std::move(order));
}

// Where a run that goes on begins; null where that is no longer remembered.
LabHistory::Frame LabSession::start_of(const Order& order) {
  if (order.what == Order::What::change) return std::make_shared<const LabFrame>(frame_of_run());
  const std::lock_guard lock(mutex_);
  if (history_.empty() || order.at < history_.frame(0)->recorded.t - 1e-9) return nullptr;
  const std::size_t n = history_.at(order.at);
  LabHistory::Frame from = history_.frame(n);
  before_ = history_.cut(n);
  does_again_ = before_.size() > 1;
  LabBranch branch;
  branch.from = from->recorded.t;
  branch.changes = order.changes;
  branch.number = status_.branch ? status_.branch->number + 1 : 1;
  status_.branch = std::move(branch);
  status_.at.reset();
  status_.playing = true;
  return from;
}

// Between two steps: the run goes on as it was ordered.
void LabSession::adopt(Built built) {
  const Order order = built.order;
  if (!order.asked.empty()) done_with(order.asked.back().number);
  const bool goes_on = order.what == Order::What::change || order.what == Order::What::branch;
  if (goes_on && built.scene != scene_->scene) return;  // meanwhile another one was opened
  LabHistory::Frame from;
  if (goes_on && !(from = start_of(order)))
    return note("error", "that instant is not remembered any more");
  auto run = std::make_unique<LabRun>(std::move(built.run), hand_, from.get());
  LabLanes lanes(order.lanes, std::move(built.lanes), from.get(), names_);
  if (from) run->keep_books(*from, names_);
  for (const std::string& warning : run->warnings())
    if (!goes_on) note("warning", warning);
  if (!run->begun_anew().empty()) note("note", run->begun_anew());
  if (!goes_on) forget();
  if (order.what == Order::What::open) {
    asked_.clear();
    ++status_.scene;
    status_.scene_name = order.name;
    if (!order.hand.empty()) choose_hand(order.hand, "");
  }
  {
    const std::lock_guard lock(mutex_);
    status_.changes = order.changes;
    status_.lanes = order.lanes;
    scene_ = std::make_shared<const Built>(std::move(built));
    run_ = std::move(run);
    lanes_ = std::move(lanes);
    history_.begin_segment(order.changes);
  }
  ++change_number_;
  changed_at_ = run_->time();
  status_.dead.reset();
  is_stale_ = is_news_ = true;
  pace_.begin(Clock::now(), run_->time(), status_.speed);
}

void LabSession::forget() {
  const std::lock_guard lock(mutex_);
  history_ = before_ = LabHistory(history_.most_bytes());
  names_ = {};
  rows_.reset();
  does_again_ = false;
  status_.branch.reset();
  status_.at.reset();
  status_.playing = true;
}

}  // namespace twinarm
