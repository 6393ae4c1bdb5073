// Makes and sends the messages scene, state, frame and inspection, in its own thread: at most 60
// frames a second to one or two clients, 30 to more. Also answers HTTP requests that need the view.
#pragma once

#include <thread>

#include "app/lab/app/clients.h"
#include "app/lab/inspector/body_inspector.h"
#include "app/lab/server/rate_limiter.h"
#include "app/lab/session/lab_session.h"
#include "app/lab/stream/lab_view.h"
#include "app/render/list/draw_list.h"

namespace twinarm {

class MessageStreamer {
 public:
  // All are text but for frame_channel.
  enum Channel { scene_channel, state_channel, frame_channel, inspection_channel };
  // Sends to one client; called from the streamer's thread.
  using Post = std::function<void(ClientId, Channel, Bytes)>;

  // All must outlive it.
  MessageStreamer(LabSession& session, Clients& clients, const std::vector<GalleryScene>& gallery,
                  Post post);
  ~MessageStreamer() { end(); }
  void begin() {
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }
  void end();

  // From any thread: to be executed by the streamer's thread.
  void post(std::function<void(MessageStreamer&)> job);
  void look_again() { session_.shown().wake(); }  // after a change of the clients
  DrawList drawn();                               // a copy of what was drawn last

  // From the streamer's thread.
  LabView& view() { return *view_; }
  std::string history(double from);

 private:
  using Clock = std::chrono::steady_clock;

  void work(const std::stop_token& stop);
  void show_failure(const std::string& why);
  void do_jobs();
  void greet_new_clients();
  void take_scene(const LabNow& now);
  void update_scene();
  void send_scene();
  void send_state(const LabNow& now);
  double send_frame(const LabNow& now, double per_second);
  void send_inspections(const LabNow& now);
  void update_limits(const LabNow& now);

  LabSession& session_;
  Clients& clients_;
  const std::vector<GalleryScene>& gallery_;
  Post post_;

  std::mutex view_mutex_;  // of what view_ has drawn
  std::mutex mutex_;       // of the next one
  std::deque<std::function<void(MessageStreamer&)>> jobs_;

  std::unique_ptr<LabView> view_;
  Clients::View greeted_;  // those that have got the scene
  struct SentInspection {
    long scene = 0;
    std::uint64_t number = 0;  // LabNow::number
    long body = 0;
    bool paused = false;
    bool operator==(const SentInspection&) const = default;
  };
  std::optional<BodyInspector> inspector_;
  std::map<ClientId, SentInspection> sent_inspections_;
  std::vector<LabParameter> parameters_, unchanged_;  // present; of the scene as opened
  long scene_number_ = -1, change_number_ = -1;
  std::uint64_t revision_ = 0, naming_ = 0;  // of the scene message sent last
  std::string state_;                        // sent last
  struct LastSentFrame {                     // what it was made of
    std::shared_ptr<const LabFrame> frame, before;
    std::vector<std::string> layers;
    FrameFacts facts;  // without the age of the input
    bool operator==(const LastSentFrame&) const = default;
  };
  LastSentFrame sent_frame_;
  RateLimiter frames_, inspections_, limits_, failures_, naming_limit_, states_;
  Bytes last_frame_;
  std::string failure_;  // shown last
  std::jthread thread_;
};

}  // namespace twinarm
