// HTTP requests of the lab (docs/reference/lab_protocol.md).
#pragma once

#include "app/lab/app/message_streamer.h"
#include "app/lab/app/uploads.h"

namespace twinarm {

class LabRoutes {
 public:
  // All must outlive it.
  LabRoutes(LabSession& session, MessageStreamer& streamer, const Clients& clients,
            const std::vector<GalleryScene>& gallery);

  void end() { tasks_.end(); }
  // From the server's thread. Longer work is answered later: by the streamer's thread if it needs
  // the view, else by the task queue.
  using Answer = std::function<void(HttpReply)>;
  void answer(const HttpRequest& request, const Answer& answer);

 private:
  void add_task(const Answer& answer, std::function<void()> task, bool is_upload = false);
  HttpReply task_reply(const HttpRequest& request) const;
  HttpReply rendered(const HttpRequest& request) const;
  void answer_open(const HttpRequest& request, const Answer& answer);
  void open(ClientId client, const std::string& name, const std::string& bytes,
            const Answer& answer);

  LabSession& session_;
  MessageStreamer& streamer_;
  const Clients& clients_;
  const std::vector<GalleryScene>& gallery_;
  Bytes page_;  // empty: the program was built without its pages
  TemporaryFiles files_{"twinarm-lab"};
  UploadFolder uploads_;  // used by the tasks' thread only
  TaskQueue tasks_;
};

}  // namespace twinarm
