#include "app/lab/app/lab_routes.h"

#include "app/page/pages.h"
#include "app/render/gl/painter.h"
#include "app/web/web_bundle.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

constexpr double kMaxPixels = 1920;

HttpReply reply_of(int status, const std::string& text) {
  return {.status = status, .body = shared_bytes(text + "\n")};
}

HttpReply not_found() {
  return reply_of(404, "unknown path; the lab is at /");
}

HttpReply file_of(const std::string& type, Bytes body, const std::string& download_name = "") {
  return {.type = type, .body = std::move(body), .file_name = download_name};
}

// Exceptions of `work` become the answer.
void answer_faults(const LabRoutes::Answer& answer, const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    answer(reply_of(422, error.what()));
  } catch (const std::exception& error) {
    answer(reply_of(500, error.what()));
  }
}

double number_of(const std::string& query, const std::string& key, double otherwise) {
  return parse_number(query_value(query, key).value_or("")).value_or(otherwise);
}

// A file name of a client: letters, digits and a few others, inside its folder.
bool is_plain(const std::string& name) {
  const auto is_good = [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '_' || c == '-' || c == ' ' || c == '/';
  };
  return !name.empty() && name.size() < 200 && name.front() != '/' && name.front() != '.' &&
         name.find("..") == std::string::npos && std::ranges::all_of(name, is_good);
}

std::string after(const std::string& path, const std::string& start) {
  return path.rfind(start, 0) == 0 ? path.substr(start.size()) : "";
}

HttpReply streamer_reply(MessageStreamer& streamer, const HttpRequest& request) {
  const std::string& path = request.path;
  if (path == "/history") {
    const double from = number_of(request.query, "from", 0);
    return file_of("application/octet-stream", shared_bytes(streamer.history(from)));
  }
  const bool is_mesh = path.starts_with("/mesh/");
  const Bytes found = streamer.view().store().file(after(path, is_mesh ? "/mesh/" : "/texture/"));
  if (!found) return not_found();
  HttpReply reply = file_of(is_mesh ? "application/octet-stream" : "image/png", found);
  reply.lasts = true;
  return reply;
}

HttpReply gallery_picture(const std::vector<GalleryScene>& gallery, const std::string& name) {
  for (const GalleryScene& scene : gallery)
    if (scene.name + ".png" == name && !scene.picture.empty())
      return file_of("image/png", shared_bytes(read_whole_file(scene.picture)));
  return not_found();
}

}  // namespace

LabRoutes::LabRoutes(LabSession& session, MessageStreamer& streamer, const Clients& clients,
                     const std::vector<GalleryScene>& gallery)
    : session_(session),
      streamer_(streamer),
      clients_(clients),
      gallery_(gallery),
      page_(shared_bytes(std::string(web_bundle().lab))),
      uploads_(files_.folder() / "uploads"),
      tasks_([this](const std::string& why) { session_.note("error", why); }) {}

void LabRoutes::answer(const HttpRequest& request, const Answer& answer) {
  if (request.method == "POST")
    return request.path == "/open" ? answer_open(request, answer) : answer(not_found());
  if (request.path == "/")
    return answer(page_->empty() ? reply_of(503, std::string(web_bundle().missing))
                                 : file_of("text/html; charset=utf-8", page_));
  if (const std::string name = after(request.path, "/gallery/"); !name.empty())
    return answer(gallery_picture(gallery_, name));
  for (const char* path : {"/frame.png", "/save", "/share", "/scene"})
    if (request.path == path)
      return add_task(answer, [this, request, answer] { answer(task_reply(request)); });
  for (const char* start : {"/mesh/", "/texture/", "/history"})
    if (request.path.starts_with(start))
      return streamer_.post([request, answer](MessageStreamer& streamer) {
        answer_faults(answer, [&] { answer(streamer_reply(streamer, request)); });
      });
  answer(not_found());
}

void LabRoutes::add_task(const Answer& answer, std::function<void()> task, bool is_upload) {
  const auto work = [this, task = std::move(task), answer] {
    files_.make_again();
    answer_faults(answer, task);
  };
  const bool is_taken = tasks_.add(work, is_upload);
  if (!is_taken) answer(reply_of(503, "too many requests are waiting; try again"));
}

HttpReply LabRoutes::task_reply(const HttpRequest& request) const {
  if (request.path == "/frame.png") return rendered(request);
  const LabNow now = session_.shown().now();
  if (request.path == "/scene")
    return file_of("application/toml; charset=utf-8",
                   shared_bytes(now.scene->scene->text(now.status->changes)), "lab.toml");
  const std::filesystem::path file = files_.folder() / "lab.twinrec";
  session_.timeline().save(file);
  if (request.path == "/share")
    return file_of("text/html; charset=utf-8", shared_bytes(replay_page(file).html), "lab.html");
  return file_of("application/octet-stream", shared_bytes(read_whole_file(file)), "lab.twinrec");
}

// What was drawn last, by the program's own renderer.
HttpReply LabRoutes::rendered(const HttpRequest& request) const {
  const auto size = [&](const char* key, double otherwise) {
    return static_cast<int>(std::clamp(number_of(request.query, key, otherwise), 64.0, kMaxPixels));
  };
  Painter painter(Backend::osmesa, size("width", 960), size("height", 540), Quality::draft);
  return file_of("image/png", shared_bytes(encode_png(painter.paint(streamer_.drawn()))));
}

void LabRoutes::answer_open(const HttpRequest& request, const Answer& answer) {
  const std::string name = query_value(request.query, "name").value_or("");
  const ClientId client = clients_.controller(query_value(request.query, "secret").value_or(""));
  if (!client) return answer(reply_of(403, "another client has control; request it"));
  if (!is_plain(name))
    return answer(reply_of(422, "invalid file name '" + name + "'; use letters, digits, -"));
  const auto task = [=, this, body = request.body] { open(client, name, body, answer); };
  add_task(answer, task, true);
}

void LabRoutes::open(ClientId client, const std::string& name, const std::string& bytes,
                     const Answer& answer) {
  const UploadedFile upload = classify_upload(name, bytes);
  if (!upload.fault.empty()) return answer(reply_of(422, name + ": " + upload.fault));
  const std::filesystem::path file = uploads_.write(client, upload.path, bytes);
  if (!upload.opens) return answer(reply_of(202, "kept"));
  BuildRequest request;
  request.file = file;
  request.is_uploaded = true;
  if (session_.shown().now().scene->request.is_shared)
    request.roots = {uploads_.path(), find_assets()};
  request.name = file.stem().string();
  request.words = {request.name, name, {}};
  request.done = [answer](const std::string& faults) {
    answer(faults.empty() ? reply_of(200, "opened") : reply_of(422, faults));
  };
  session_.open(std::move(request));
}

}  // namespace twinarm
