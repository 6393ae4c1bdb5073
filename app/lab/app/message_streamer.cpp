#include "app/lab/app/message_streamer.h"

#include <pthread.h>

#include <algorithm>
#include <cmath>

#include "app/film/filmed_run.h"
#include "app/lab/app/clients.h"
#include "app/support/progress.h"

namespace twinarm {
namespace {

constexpr double kGlassEvery = 0.2, kGlassStanding = 0.05, kKnobsEvery = 0.4, kIdle = 0.1;  // [s]
constexpr double kFailureEvery = 5;                                                         // [s]
constexpr double kRate = 60, kSlowRate = 30;  // frames a second, to few clients and to more
constexpr std::size_t kManyClients = 2;
// A run whose frames cannot stand so evenly, by its step, may send so much more of them.
constexpr double kMore = 1.05;

}  // namespace

MessageStreamer::MessageStreamer(LabSession& session, Clients& audience,
                                 const std::vector<GalleryScene>& gallery, Post post)
    : session_(session), audience_(audience), gallery_(gallery), post_(std::move(post)) {}

void MessageStreamer::begin() {
  thread_ = std::thread([this] { work(); });
}

void MessageStreamer::end() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  session_.shown().wake();
  thread_.join();
}

void MessageStreamer::ask(std::function<void(MessageStreamer&)> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  session_.shown().wake();
}

void MessageStreamer::work() {
  pthread_setname_np(pthread_self(), "lab painter");
  for (;;) {
    const LabNow now = session_.shown().now();
    double left = kIdle;
    try {
      take_scene(now);
      do_jobs();
      look_at_clients();
      left = paint(now);
    } catch (const std::exception& error) {
      show_failure(error.what());
    }
    {
      const std::lock_guard lock(mutex_);
      if (stop_) return;
    }
    session_.shown().wait(now, std::min(left, kIdle));
  }
}

double MessageStreamer::paint(const LabNow& now) {
  const double rate = clients_.size() > kManyClients ? kSlowRate : kRate;
  session_.set_rate(rate);
  look_at_knobs(now);
  tell_state(now);
  const double left = tell_frame(now, kMore * rate);
  tell_glass(now);
  return left;
}

// What fails may fail again with each frame: the same failure is shown every few seconds.
void MessageStreamer::show_failure(const std::string& why) {
  if (why == failure_ && !is_due(last_failure_, kFailureEvery)) return;
  failure_ = why;
  last_failure_ = Clock::now();
  session_.note("error", "the lab cannot draw this: " + why);
}

void MessageStreamer::do_jobs() {
  std::deque<std::function<void(MessageStreamer&)>> jobs;
  {
    const std::lock_guard lock(mutex_);
    jobs.swap(jobs_);
  }
  for (const auto& job : jobs) job(*this);
}

// A newcomer is told everything, the scene first and each frame once.
void MessageStreamer::look_at_clients() {
  std::vector<ClientId> clients = audience_.view().clients;
  for (const ClientId client : clients) {
    if (std::ranges::find(clients_, client) != clients_.end()) continue;
    post_(client, scene_channel, shared_bytes(view_->scene_message()), false);
    if (last_frame_) post_(client, frame_channel, last_frame_, true);
    state_.clear();  // told anew, to all: who has the hand may have changed
  }
  clients_ = std::move(clients);
}

// The scene of this instant, with plans of the painter's own.
void MessageStreamer::take_scene(const LabNow& now) {
  if (now.change_number == change_number_) return;
  const auto plan_of = [](const std::shared_ptr<LabScene::Plan>& plan) {
    return std::shared_ptr<const SimulatePlan>(plan, &plan->prepared);
  };
  const std::shared_ptr<const SimulatePlan> plan = plan_of(now.scene->view);
  const VariantSet& lanes = now.scene->order.lanes;
  std::vector<std::shared_ptr<const SimulatePlan>> lane_plans;
  for (const auto& lane : now.scene->lane_views) lane_plans.push_back(plan_of(lane));
  const std::lock_guard drawing(view_mutex_);
  if (now.scene_number != scene_number_) {
    view_ = std::make_unique<LabView>(static_cast<std::uint32_t>(now.scene_number), plan,
                                      now.scene->header, now.scene->order.words,
                                      ViewVariants{lanes, std::move(lane_plans)});
    last_frame_.reset();
  } else {
    view_->change(plan, std::move(lane_plans));
  }
  if (now.scene_number != scene_number_)
    unchanged_ = now.scene->order.changes.empty() ? knobs_of(*plan)
                                                  : knobs_of(now.scene->scene->plan()->prepared);
  glass_.reset();
  knobs_ = knobs_of(*plan);
  know_starts(unchanged_, knobs_);
  std::erase_if(knobs_, [&](const LabParameter& knob) { return knob.path == lanes.path; });
  last_knobs_ = {};
  scene_number_ = now.scene_number;
  change_number_ = now.change_number;
  tell_scene();
}

void MessageStreamer::tell_scene() {
  revision_ = view_->revision();
  to_all(scene_channel, view_->scene_message(), false);
}

void MessageStreamer::look_at_knobs(const LabNow& now) {
  if (!now.frame || !is_due(last_knobs_, kKnobsEvery)) return;
  SimulatePlan& plan = now.scene->knobs->prepared;
  const State<double> x = instant_of(now.frame->recorded, plan.input.robot.model).x;
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (std::ranges::all_of(x.q, is_finite) && std::ranges::all_of(x.qd, is_finite))
    predict_knobs(plan, x, knobs_);
}

// To each its own, since it says who is who.
void MessageStreamer::tell_state(const LabNow& now) {
  std::string state = state_message(*now.status, audience_.view(), knobs_, gallery_);
  if (state == state_) return;
  state_ = std::move(state);
  for (const ClientId client : clients_)
    post_(client, state_channel, shared_bytes(addressed(state_, client, audience_.secret(client))),
          false);
}

// What has been told is not told again, whatever else is new. How long the next has to wait [s]:
// what is new too soon is told then, or what is newer than that.
double MessageStreamer::tell_frame(const LabNow& now, double per_second) {
  if (!now.frame) return kIdle;
  LastSentFrame wanted{now.frame,
                       now.before,
                       audience_.layers(),
                       !now.status->playing,
                       now.status->at.has_value(),
                       now.status->dead.has_value()};
  if (wanted == told_frame_) return kIdle;
  const Clock::time_point time = Clock::now();
  if (const double left = frames_.wait(time); left > 0) return left;
  frames_.take(time, per_second);
  told_frame_ = std::move(wanted);
  view_->name_rows(*now.rows);
  FrameFacts facts;
  facts.number = ++frame_;
  facts.stands = told_frame_.stands;
  facts.looked_back = told_frame_.looked_back;
  facts.stopped = told_frame_.stopped;
  facts.input_age = now.frame->input_stamp != 0 ? as_seconds(Clock::now() - now.input_came) : 0.0;
  std::unique_lock drawing(view_mutex_);
  std::string frame = view_->frame(*now.frame, now.before.get(), told_frame_.layers, facts);
  drawing.unlock();
  if (view_->revision() != revision_) tell_scene();
  last_frame_ = shared_bytes(std::move(frame));
  for (const ClientId client : clients_) post_(client, frame_channel, last_frame_, true);
  return kIdle;
}

DrawList MessageStreamer::drawn() {
  const std::lock_guard lock(view_mutex_);
  return view_ ? view_->drawn() : DrawList();
}

// What has been told is not told again: where time stands, it would cost the same each time.
void MessageStreamer::tell_glass(const LabNow& now) {
  std::map<ClientId, SentInspection> wanted;
  const bool stands = !now.status->playing;
  for (const auto& [client, body] : audience_.glass())
    wanted[client] = {now.scene_number, now.number, body, stands};
  if (wanted == told_glass_ || !now.frame) return;
  if (!is_due(last_glass_, stands ? kGlassStanding : kGlassEvery)) return;
  if (!glass_) glass_.emplace(std::move(now.scene->scene->plan(now.status->changes)->prepared));
  for (const auto& [client, told] : wanted) {
    if (const auto before = told_glass_.find(client);
        before != told_glass_.end() && before->second == told)
      continue;
    InspectRequest question;
    question.body = static_cast<std::size_t>(std::max(0L, told.body));
    question.stands = stands;
    question.scene = static_cast<unsigned>(now.scene_number);
    question.ledger = now.rows.get();
    post_(client, glass_channel, shared_bytes(glass_->message(*now.frame, question)), false);
  }
  told_glass_ = std::move(wanted);
}

std::string MessageStreamer::history(double from) {
  const auto frames = session_.timeline().frames(from);
  std::vector<const LabFrame*> all;
  for (const auto& frame : frames) all.push_back(frame.get());
  return view_->history(all);
}

void MessageStreamer::to_all(Channel channel, const std::string& message, bool is_binary) {
  const Bytes bytes = shared_bytes(message);
  for (const ClientId client : clients_) post_(client, channel, bytes, is_binary);
}

bool MessageStreamer::is_due(Clock::time_point& last, double interval) const {
  const Clock::time_point now = Clock::now();
  if (as_seconds(now - last) < interval) return false;
  last = now;
  return true;
}

}  // namespace twinarm
