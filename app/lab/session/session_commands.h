// Executes commands between two steps: at once, or by a request to the scene builder thread whose
// result is adopted later.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/session/session_status.h"

namespace twinarm {

class SessionCommands {
 public:
  SessionCommands(SessionState& state, const std::vector<GalleryScene>& gallery,
                  std::function<void(BuildRequest)> open)
      : s_(state), gallery_(gallery), open_(std::move(open)) {}
  // Throws InputError; the command then has no effect.
  void act(const LabCommand& command);
  // Continues or begins the run with a built scene. Throws InputError.
  void adopt(BuildResult built);

 private:
  void act_on_input(const LabCommand& command);
  void switch_source(OperatorInput::Source source);
  void choose_source(const std::string& source, const std::string& spec);
  void change(const std::vector<std::string>& texts, std::optional<double> at);
  void open_preset(const std::string& name);
  void open_from_gallery(const std::string& name);
  void edit(const SceneEdit& edit);
  void request(BuildRequest::What what, double at = 0);
  BuildRequest request_of(BuildRequest::What what) const;
  Timeline::Frame start_of(const BuildRequest& request);

  SessionState& s_;
  const std::vector<GalleryScene>& gallery_;
  std::function<void(BuildRequest)> open_;
};

}  // namespace twinarm
