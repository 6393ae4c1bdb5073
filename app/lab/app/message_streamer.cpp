#include "app/lab/app/message_streamer.h"

#include <pthread.h>

namespace twinarm {

constexpr double kIdle = 0.1;  // [s]
// At most so many a second.
constexpr double kInspections = 5, kInspectionsPaused = 20, kLimits = 2.5, kFailures = 0.2,
                 kNaming = 1;
constexpr double kRate = 60, kSlowRate = 30;  // [frames/s], to few clients and to many
constexpr double kStates = 1;  // of an unchanged state: its arrival shows that the lab runs
constexpr std::size_t kManyClients = 2;
// Factor of the rate, for frames that the step does not permit to be evenly spaced.
constexpr double kRateMargin = 1.05;

MessageStreamer::MessageStreamer(LabSession& session, Clients& clients,
                                 const std::vector<GalleryScene>& gallery, Post post)
    : session_(session), clients_(clients), gallery_(gallery), post_(std::move(post)) {}

void MessageStreamer::end() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  session_.shown().wake();
  thread_.join();
}

void MessageStreamer::post(std::function<void(MessageStreamer&)> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  session_.shown().wake();
}

void MessageStreamer::work(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "lab streamer");
  for (;;) {
    const LabNow now = session_.shown().now();
    double left = kIdle;
    try {
      take_scene(now);
      do_jobs();
      greet_new_clients();
      const double rate = greeted_.clients.size() > kManyClients ? kSlowRate : kRate;
      session_.set_rate(rate);
      update_limits(now);
      send_state(now);
      left = send_frame(now, kRateMargin * rate);
      update_scene();
      send_inspections(now);
    } catch (const std::exception& error) {
      show_failure(error.what());
    }
    if (stop.stop_requested()) return;
    session_.shown().wait(now, std::min(left, kIdle));
  }
}

// A failure may repeat with each frame.
void MessageStreamer::show_failure(const std::string& why) {
  const bool is_due = failures_.passes(Clock::now(), kFailures, 1);
  if (why == failure_ && !is_due) return;
  failure_ = why;
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

// New clients get the scene first, and each frame once.
void MessageStreamer::greet_new_clients() {
  Clients::View current = clients_.view();
  for (const auto& [client, its] : current.clients) {
    if (greeted_.clients.contains(client)) continue;
    post_(client, scene_channel, shared_bytes(view_->scene_message()));
    if (last_frame_) post_(client, frame_channel, last_frame_);
    state_.clear();  // sent to all clients: control may have changed
  }
  greeted_ = std::move(current);
}

void MessageStreamer::take_scene(const LabNow& now) {
  if (now.change_number == change_number_) return;
  const auto plan_of = [](const std::shared_ptr<LabScene::Plan>& plan) {
    return std::shared_ptr<const SimulatePlan>(plan, &plan->prepared);
  };
  const std::shared_ptr<const SimulatePlan> plan = plan_of(now.scene->view);
  const VariantSet& variants = now.scene->request.variants;
  std::vector<std::shared_ptr<const SimulatePlan>> variant_plans;
  for (const auto& variant : now.scene->variant_views) variant_plans.push_back(plan_of(variant));
  const std::lock_guard drawing(view_mutex_);
  if (now.scene_number != scene_number_) {
    view_ = std::make_unique<LabView>(static_cast<std::uint32_t>(now.scene_number), plan,
                                      now.scene->header, now.scene->request.words,
                                      ViewVariants{variants, std::move(variant_plans)});
    last_frame_.reset();
    unchanged_ = now.scene->request.changes.empty()
                     ? parameters_of(*plan)
                     : parameters_of(now.scene->scene->plan()->prepared);
  } else {
    view_->change(plan, std::move(variant_plans));
  }
  inspector_.reset();
  parameters_ = parameters_of(*plan);
  set_initial_values(unchanged_, parameters_);
  std::erase_if(parameters_,
                [&](const LabParameter& parameter) { return parameter.path == variants.path; });
  limits_ = {};
  scene_number_ = now.scene_number;
  change_number_ = now.change_number;
  send_scene();
}

// New names wait up to a second: in a heap contacts begin at each step, and a message is long.
void MessageStreamer::update_scene() {
  const bool has_names = view_->naming() != naming_;
  if (view_->revision() != revision_ ||
      (has_names && naming_limit_.passes(Clock::now(), kNaming, 1)))
    send_scene();
}

void MessageStreamer::send_scene() {
  revision_ = view_->revision();
  naming_ = view_->naming();
  const Bytes message = shared_bytes(view_->scene_message());
  for (const auto& [client, its] : greeted_.clients) post_(client, scene_channel, message);
}

void MessageStreamer::update_limits(const LabNow& now) {
  if (!now.frame || !limits_.passes(Clock::now(), kLimits, 1)) return;
  SimulatePlan& plan = now.scene->parameters->prepared;
  // The pose of a run that has diverged is meaningless: then as its post-mortem, at the start pose.
  const bool is_start = now.status->failure && plan.input.scene;
  const State<double> x = is_start ? plan.input.scene->start
                                   : instant_of(now.frame->recorded, plan.input.robot.model).x;
  const auto is_number = [](double value) { return std::isfinite(value); };
  if (std::ranges::all_of(x.q, is_number) && std::ranges::all_of(x.qd, is_number))
    predict_limits(plan, x, parameters_, is_start ? ", at the start pose" : "");
}

void MessageStreamer::send_state(const LabNow& now) {
  std::string state = state_message(*now.status, greeted_, parameters_, gallery_);
  if (state == state_ && !states_.passes(Clock::now(), kStates, 1)) return;
  state_ = std::move(state);
  for (const auto& [client, its] : greeted_.clients)
    post_(client, state_channel, shared_bytes(addressed(state_, client, its.secret)));
}

// Sends each frame once. Returns the time until the next may be sent [s]; a newer one may replace
// it until then.
double MessageStreamer::send_frame(const LabNow& now, double per_second) {
  if (!now.frame) return kIdle;
  LastSentFrame wanted{now.frame,
                       now.before,
                       greeted_.layers(),
                       {sent_frame_.facts.number, !now.status->playing, now.status->at.has_value(),
                        now.status->failure.has_value()}};
  if (wanted == sent_frame_) return kIdle;
  const Clock::time_point time = Clock::now();
  if (const double left = frames_.wait(time); left > 0) return left;
  frames_.take(time, per_second);
  ++wanted.facts.number;
  sent_frame_ = std::move(wanted);
  view_->name_rows(*now.rows);
  FrameFacts facts = sent_frame_.facts;
  if (now.frame->input_stamp != 0) facts.input_age = as_seconds(Clock::now() - now.input_came);
  std::unique_lock drawing(view_mutex_);
  std::string frame = view_->frame(*now.frame, now.before.get(), sent_frame_.layers, facts);
  drawing.unlock();
  update_scene();
  last_frame_ = shared_bytes(std::move(frame));
  for (const auto& [client, its] : greeted_.clients) post_(client, frame_channel, last_frame_);
  return kIdle;
}

DrawList MessageStreamer::drawn() {
  const std::lock_guard lock(view_mutex_);
  return view_ ? view_->drawn() : DrawList();
}

// Sends each inspection once.
void MessageStreamer::send_inspections(const LabNow& now) {
  std::map<ClientId, SentInspection> wanted;
  const bool paused = !now.status->playing;
  for (const auto& [client, its] : greeted_.clients)
    if (its.inspected) wanted[client] = {now.scene_number, now.number, *its.inspected, paused};
  if (wanted == sent_inspections_ || !now.frame) return;
  const double per_second = paused ? kInspectionsPaused : kInspections;
  if (!inspections_.passes(Clock::now(), per_second, 1)) return;
  if (!inspector_)
    inspector_.emplace(std::move(now.scene->scene->plan(now.status->changes)->prepared));
  for (const auto& [client, inspection] : wanted) {
    if (const auto before = sent_inspections_.find(client);
        before != sent_inspections_.end() && before->second == inspection)
      continue;
    const InspectRequest request{static_cast<std::size_t>(std::max(0L, inspection.body)), paused,
                                 static_cast<unsigned>(now.scene_number), now.rows.get()};
    post_(client, inspection_channel, shared_bytes(inspector_->message(*now.frame, request)));
  }
  sent_inspections_ = std::move(wanted);
}

std::string MessageStreamer::history(double from) {
  const auto frames = session_.timeline().frames(from);
  std::vector<const LabFrame*> all;
  for (const auto& frame : frames) all.push_back(frame.get());
  return view_->history(all);
}

}  // namespace twinarm
