// What the lab answers over HTTP (docs/reference/lab_protocol.md).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/lab/app/message_streamer.h"
#include "app/lab/app/uploads.h"
#include "app/lab/server/lab_server.h"
#include "app/lab/session/lab_session.h"

namespace twinarm {

class LabRoutes {
 public:
  // All must outlive it. `page`: empty where the program was built without its pages; `missing`
  // says why then.
  LabRoutes(LabSession& session, MessageStreamer& painter, const Clients& audience,
            const std::vector<GalleryScene>& gallery, std::string page, std::string missing);
  ~LabRoutes();  // uploaded files are removed
  LabRoutes(const LabRoutes&) = delete;
  LabRoutes& operator=(const LabRoutes&) = delete;

  void end();  // nothing is answered any more
  // By the server's thread. What takes long is answered later: by the painter's thread what only it
  // knows, by one of their own what would hold it up.
  using Answer = std::function<void(HttpReply)>;
  void answer(const HttpRequest& request, const Answer& answer);

 private:
  void answer_picture(const std::string& name, const Answer& answer) const;
  void ask_painter(const HttpRequest& request, const Answer& answer);
  void ask_errands(const HttpRequest& request, const Answer& answer);
  HttpReply picture(const HttpRequest& request) const;
  void do_errand(const Answer& answer, std::function<void()> errand);
  void answer_open(const HttpRequest& request, const Answer& answer);
  void open(const std::string& name, const std::string& bytes, const Answer& answer);
  HttpReply run_errand(const HttpRequest& request) const;

  LabSession& session_;
  MessageStreamer& painter_;
  const Clients& audience_;
  const std::vector<GalleryScene>& gallery_;
  Bytes page_;
  std::string missing_;
  std::filesystem::path folder_;  // of temporary files
  UploadFolder uploads_;          // of the errands' thread
  TaskQueue errands_;
};

}  // namespace twinarm
