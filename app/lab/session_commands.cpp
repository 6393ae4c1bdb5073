// What the session does when it is told something.
#include <algorithm>

#include "app/lab/knobs/presets.h"
#include "app/lab/lab_session.h"
#include "solver/fault.h"

namespace twinarm {
namespace {

// In the place of one to the same path.
void put(std::vector<Change>& changes, const Change& change) {
  const auto is_same = [&](const Change& other) { return other.path == change.path; };
  const auto found = std::find_if(changes.begin(), changes.end(), is_same);
  if (found == changes.end())
    changes.push_back(change);
  else
    found->value = change.value;
}

}  // namespace

void LabSession::take_commands() {
  std::deque<LabCommand> commands;
  std::deque<Built> built;
  bool has_failed = false;
  {
    const std::lock_guard lock(mutex_);
    commands.swap(commands_);
    built.swap(built_);
    std::swap(has_failed, has_failed_);
  }
  for (const LabCommand& command : commands) try {
      act(command);
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults()) note("error", to_string(fault));
    }
  if (has_failed) wanted_ = status_.changes;  // as it was
  for (Built& one : built) {
    const auto done = one.order.done;
    try {
      adopt(std::move(one));
      if (done) done("");
    } catch (const InputError& error) {
      std::string words;
      for (const Fault& fault : error.faults()) words += to_string(fault) + "\n";
      note("error", words);
      if (done) done(words);
    }
  }
}

void LabSession::act(const LabCommand& command) {
  using Do = LabCommand::Do;
  is_news_ = true;
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
      pace_.begin(Clock::now(), run_->time());
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
    default:
      return act_on_hand(command);
  }
}

void LabSession::act_on_hand(const LabCommand& command) {
  using Do = LabCommand::Do;
  LabHand& hand = run_->hand();
  input_stamp_ = command.stamp;
  input_came_ = command.came;
  switch (command.what) {
    case Do::hand:
      return hand.choose(command.name, command.spec);
    case Do::tip:
      return hand.drag_tip(command.goal);
    case Do::joint:
      return hand.drag_joint(static_cast<std::size_t>(command.count), command.value);
    case Do::turn:
      return hand.turn_stylus(command.point);
    case Do::axes:
      return hand.axes(command.rates);
    case Do::button:
      return hand.button(static_cast<std::size_t>(command.count), command.on);
    case Do::pull:
      return run_->pull(static_cast<int>(command.count), command.point, command.goal);
    case Do::drop:
      hand.release();
      return run_->drop();
    default:
      return;
  }
}

// From now on, or from an instant that is remembered.
void LabSession::change(const std::vector<std::string>& texts, std::optional<double> at) {
  std::vector<Change> changes = wanted_;
  for (const std::string& text : texts) put(changes, parse_change(text));
  wanted_ = std::move(changes);
  if (!at) return order(Order::What::change, 0);
  status_.playing = false;
  order(Order::What::branch, *at);
}

void LabSession::preset(const std::string& name) {
  const Preset* preset = find_preset(name);
  if (!preset)
    throw InputError({{"command", 0, "preset", "there is no '" + name + "'",
                       "the state lists them under presets"}});
  Order order;
  order.file = find_asset_scene(preset->scene);
  order.name = preset->name;
  order.words.title = preset->what;
  order.words.file = preset->scene;
  order.hand = preset->hand;
  for (const std::string& text : preset->changes) put(order.changes, parse_change(text));
  workshop_->order(std::move(order));
}

void LabSession::open_from_gallery(const std::string& name) {
  const GalleryScene* scene = find_scene(gallery_, name);
  if (!scene)
    throw InputError({{"command", 0, "scene", "there is no '" + name + "'",
                       "the state lists them under gallery"}});
  workshop_->order(order_of(*scene));
}

void LabSession::order(Order::What what, double at) {
  Order order;
  order.what = what;
  order.scene = scene_->scene;
  order.name = scene_->order.name;
  order.words = scene_->order.words;
  order.changes = wanted_;
  order.at = at;
  workshop_->order(std::move(order));
}

// Between two steps: the run goes on as it was ordered.
void LabSession::adopt(Built built) {
  const Order& order = built.order;
  const bool goes_on = order.what == Order::What::change || order.what == Order::What::branch;
  if (goes_on && built.scene != scene_->scene) return;  // meanwhile another one was opened
  std::shared_ptr<const LabFrame> from;
  if (order.what == Order::What::branch) {
    from = keep_branch(order);
    if (!from) return note("error", "that instant is not remembered any more");
  } else if (goes_on) {
    from = std::make_shared<const LabFrame>(run_->frame());
  }
  auto run = from ? std::make_unique<LabRun>(std::move(built.run), *from)
                  : std::make_unique<LabRun>(std::move(built.run));
  for (const std::string& warning : run->warnings()) note("warning", warning);
  if (!goes_on) forget();
  if (order.what == Order::What::open) {
    ++status_.scene;
    status_.scene_name = order.name;
  }
  wanted_ = status_.changes = order.changes;
  scene_ = std::make_shared<const Built>(std::move(built));
  run_ = std::move(run);
  ++change_number_;
  status_.dead.reset();
  is_stale_ = is_news_ = true;
  pace_.begin(Clock::now(), run_->time());
}

void LabSession::forget() {
  const std::lock_guard lock(mutex_);
  history_.clear();
  before_.clear();
  status_.branch.reset();
  status_.at.reset();
  status_.playing = true;
}

}  // namespace twinarm
