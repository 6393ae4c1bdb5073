// Makes the messages: scene, state, frames, glass. A thread of its own; at most 60 frames a second
// for one or two pages, 30 for more. Whatever takes long and is asked for over HTTP is done here
// too, one thing after the other.
#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "app/lab/app/clients.h"
#include "app/lab/inspector/body_inspector.h"
#include "app/lab/parameters/gallery.h"
#include "app/lab/parameters/parameters.h"
#include "app/lab/server/lab_server.h"
#include "app/lab/session/lab_session.h"
#include "app/lab/stream/lab_view.h"
#include "app/render/list/draw_list.h"

namespace twinarm {

// So many a second, and no more: what is evenly spaced goes on without a wait, and of what comes in
// a burst two may go at once. After a pause nothing is made up for.
class RateLimiter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Until the next may go [s]; 0: now.
  double wait(Time now) const {
    return std::max(0.0, std::chrono::duration<double>(next_ - now).count());
  }
  // One goes now, at so many a second.
  void take(Time now, double per_second) {
    const auto interval =
        std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(1 / per_second));
    next_ = std::max(next_, now - interval) + interval;
  }

 private:
  Time next_{};
};

class MessageStreamer {
 public:
  // Where messages go: to one client. From the painter's thread.
  enum Channel { scene_channel, state_channel, frame_channel, glass_channel };
  using Post = std::function<void(ClientId, Channel, Bytes, bool is_binary)>;

  // All must outlive it.
  MessageStreamer(LabSession& session, Clients& audience, const std::vector<GalleryScene>& gallery,
                  Post post);
  ~MessageStreamer() { end(); }
  void begin();
  void end();

  // From any thread: to be done by the painter's, which alone may touch its view.
  void ask(std::function<void(MessageStreamer&)> job);
  void look_again() { session_.shown().wake(); }  // something about clients has changed

  // A copy of what was drawn last, for whoever paints it elsewhere. From any thread.
  DrawList drawn();

  // Of the painter's thread.
  LabView& view() { return *view_; }
  std::string history(double from);

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  double paint(const LabNow& now);
  void show_failure(const std::string& why);
  void do_jobs();
  void look_at_clients();
  void take_scene(const LabNow& now);
  void tell_scene();
  void tell_state(const LabNow& now);
  double tell_frame(const LabNow& now, double per_second);
  void tell_glass(const LabNow& now);
  void look_at_knobs(const LabNow& now);
  void to_all(Channel channel, const std::string& message, bool is_binary);
  bool is_due(Clock::time_point& last, double interval) const;

  LabSession& session_;
  Clients& audience_;
  const std::vector<GalleryScene>& gallery_;
  Post post_;

  std::mutex view_mutex_;  // of what view_ has drawn
  std::mutex mutex_;       // of the next two
  std::deque<std::function<void(MessageStreamer&)>> jobs_;
  bool stop_ = false;

  std::unique_ptr<LabView> view_;
  std::vector<ClientId> clients_;  // that have been told the scene
  struct SentInspection {
    long scene = 0;
    std::uint64_t number = 0;  // LabNow's
    long body = 0;
    bool stands = false;
    bool operator==(const SentInspection&) const = default;
  };
  std::optional<BodyInspector> glass_;
  std::map<ClientId, SentInspection> told_glass_;
  std::vector<LabParameter> knobs_, unchanged_;  // now; of the scene as it was opened
  long scene_number_ = -1, change_number_ = -1;
  std::uint64_t revision_ = 0;  // of the view's scene message that was told
  std::uint32_t frame_ = 0;
  std::string state_;  // that was told last
  // What the last frame was made of.
  struct LastSentFrame {
    std::shared_ptr<const LabFrame> frame, before;
    std::vector<std::string> layers;
    bool stands = false, looked_back = false, stopped = false;
    bool operator==(const LastSentFrame&) const = default;
  };
  LastSentFrame told_frame_;
  RateLimiter frames_;
  Bytes last_frame_;
  Clock::time_point last_glass_{}, last_knobs_{}, last_failure_{};
  std::string failure_;  // the last one that was shown
  std::thread thread_;
};

}  // namespace twinarm
