// What the lab answers over HTTP (docs/lab_protocol.md).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/lab/lab_painter.h"
#include "app/lab/lab_session.h"
#include "app/lab/server/lab_server.h"

namespace twinarm {

class LabRoutes {
 public:
  // All must outlive it. `page`: empty where the program was built without its pages; `missing`
  // says why then.
  LabRoutes(LabSession& session, LabPainter& painter, const std::vector<GalleryScene>& gallery,
            std::string page, std::string missing);
  ~LabRoutes();  // what pages have brought goes with it
  LabRoutes(const LabRoutes&) = delete;
  LabRoutes& operator=(const LabRoutes&) = delete;

  // By the server's thread. What takes long is answered later, by the painter's.
  using Answer = std::function<void(HttpReply)>;
  void answer(const HttpRequest& request, const Answer& answer);

 private:
  void answer_picture(const std::string& name, const Answer& answer) const;
  void answer_later(const HttpRequest& request, const Answer& answer);
  void answer_open(const HttpRequest& request, const Answer& answer);
  HttpReply save() const;
  HttpReply share() const;

  LabSession& session_;
  LabPainter& painter_;
  const std::vector<GalleryScene>& gallery_;
  Bytes page_;
  std::string missing_;
  std::filesystem::path folder_;  // of files that pages have brought
};

}  // namespace twinarm
