// What commands do to the run, between two steps: at once, or by an order to the thread that builds
// scenes, whose result is taken over here.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/session/session_state.h"

namespace twinarm {

class SessionCommands {
 public:
  SessionCommands(SessionState& state, const std::vector<GalleryScene>& gallery,
                  std::function<void(BuildRequest)> open)
      : s_(state), gallery_(gallery), open_(std::move(open)) {}
  // Throws InputError: nothing of it holds.
  void act(const LabCommand& command);
  // The run goes on as it was ordered. Throws what building it throws.
  void adopt(BuildResult built);

 private:
  void act_on_hand(const LabCommand& command);
  void lead_by(LabHand::Source source);
  void choose_hand(const std::string& source, const std::string& spec);
  void change(const std::vector<std::string>& texts, std::optional<double> at);
  void open_preset(const std::string& name);
  void open_from_gallery(const std::string& name);
  void order(BuildRequest::What what, double at = 0);
  Timeline::Frame start_of(const BuildRequest& order);
  void forget();

  SessionState& s_;
  const std::vector<GalleryScene>& gallery_;
  std::function<void(BuildRequest)> open_;
};

}  // namespace twinarm
