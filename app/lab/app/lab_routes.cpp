#include "app/lab/app/lab_routes.h"

#include <sys/stat.h>

#include <algorithm>
#include <charconv>

#include "app/lab/app/uploads.h"
#include "app/page/pages.h"
#include "app/render/gl/painter.h"
#include "app/support/files.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr double kMaxPixels = 1920;

HttpReply reply_of(int status, const std::string& text) {
  HttpReply reply;
  reply.status = status;
  reply.body = shared_bytes(text + "\n");
  return reply;
}

HttpReply not_found() {
  return reply_of(404, "there is no such page; the lab is at /");
}

HttpReply file_of(const std::string& type, Bytes body, bool lasts) {
  HttpReply reply;
  reply.type = type;
  reply.body = std::move(body);
  reply.lasts = lasts;
  return reply;
}

HttpReply faults_of(const InputError& error) {
  std::string words;
  for (const Diagnostic& fault : error.faults()) words += to_string(fault) + "\n";
  words.pop_back();
  return reply_of(422, words);
}

// What `work` throws is answered.
void answer_faults(const LabRoutes::Answer& answer, const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    answer(faults_of(error));
  } catch (const std::exception& error) {
    answer(reply_of(500, error.what()));
  }
}

double number_of(const std::string& query, const std::string& key, double otherwise) {
  const std::string text = query_value(query, key).value_or("");
  double value = 0;
  const auto end = text.data() + text.size();
  const bool is_number =
      !text.empty() && std::from_chars(text.data(), end, value).ptr == end && std::isfinite(value);
  return is_number ? value : otherwise;
}

// A name that a page gives a file: letters, digits and the like, no way out of its folder.
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

HttpReply reply_of_painter(MessageStreamer& painter, const HttpRequest& request) {
  const std::string& path = request.path;
  if (path == "/history") {
    const double from = number_of(request.query, "from", 0);
    return file_of("application/octet-stream", shared_bytes(painter.history(from)), false);
  }
  const std::string mesh = after(path, "/mesh/"), texture = after(path, "/texture/");
  const Bytes found = mesh.empty() ? painter.view().texture(texture) : painter.view().mesh(mesh);
  if (!found) return not_found();
  return file_of(mesh.empty() ? "image/png" : "application/octet-stream", found, true);
}

}  // namespace

LabRoutes::LabRoutes(LabSession& session, MessageStreamer& painter, const Clients& audience,
                     const std::vector<GalleryScene>& gallery, std::string page,
                     std::string missing)
    : session_(session),
      painter_(painter),
      audience_(audience),
      gallery_(gallery),
      page_(shared_bytes(std::move(page))),
      missing_(std::move(missing)),
      folder_(make_temporary_folder("twinarm-lab")),
      uploads_(folder_ / "uploads"),
      errands_([this](const std::string& why) { session_.note("error", why); }) {}

LabRoutes::~LabRoutes() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void LabRoutes::answer(const HttpRequest& request, const Answer& answer) {
  if (request.method == "POST") {
    if (request.path != "/open") return answer(not_found());
    return answer_open(request, answer);
  }
  if (request.path == "/")
    return answer(page_->empty() ? reply_of(503, missing_)
                                 : file_of("text/html; charset=utf-8", page_, false));
  if (const std::string name = after(request.path, "/gallery/"); !name.empty())
    return answer_picture(name, answer);
  for (const char* path : {"/frame.png", "/save", "/share", "/scene"})
    if (request.path == path) return ask_errands(request, answer);
  for (const char* start : {"/mesh/", "/texture/", "/history"})
    if (request.path.rfind(start, 0) == 0) return ask_painter(request, answer);
  answer(not_found());
}

void LabRoutes::answer_picture(const std::string& name, const Answer& answer) const {
  for (const GalleryScene& scene : gallery_)
    if (scene.name + ".png" == name && !scene.picture.empty())
      return answer(file_of("image/png", shared_bytes(read_whole_file(scene.picture)), false));
  answer(not_found());
}

void LabRoutes::end() {
  errands_.end();
}

void LabRoutes::ask_painter(const HttpRequest& request, const Answer& answer) {
  painter_.ask([request, answer](MessageStreamer& painter) {
    answer_faults(answer, [&] { answer(reply_of_painter(painter, request)); });
  });
}

void LabRoutes::ask_errands(const HttpRequest& request, const Answer& answer) {
  do_errand(answer, [this, request, answer] { answer(run_errand(request)); });
}

void LabRoutes::do_errand(const Answer& answer, std::function<void()> errand) {
  const bool is_taken = errands_.add([this, errand = std::move(errand), answer] {
    mkdir(folder_.c_str(), S_IRWXU);  // cleaners of temporary folders may have removed it
    answer_faults(answer, errand);
  });
  if (!is_taken) answer(reply_of(503, "too much was asked for at once; try again"));
}

HttpReply LabRoutes::run_errand(const HttpRequest& request) const {
  if (request.path == "/frame.png") return picture(request);
  const LabNow now = session_.shown().now();
  if (request.path == "/scene") {
    HttpReply reply = file_of("application/toml; charset=utf-8",
                              shared_bytes(now.scene->scene->text(now.status->changes)), false);
    reply.file_name = "lab.toml";
    return reply;
  }
  const std::filesystem::path file = folder_ / "lab.twinrec";
  session_.timeline().save(file);
  const bool is_page = request.path == "/share";
  HttpReply reply =
      is_page ? file_of("text/html; charset=utf-8", shared_bytes(replay_page(file).html), false)
              : file_of("application/octet-stream", shared_bytes(read_whole_file(file)), false);
  reply.file_name = is_page ? "lab.html" : "lab.twinrec";
  return reply;
}

// What was drawn last, by the program's own renderer.
HttpReply LabRoutes::picture(const HttpRequest& request) const {
  const auto size = [&](const char* key, double otherwise) {
    return static_cast<int>(std::clamp(number_of(request.query, key, otherwise), 64.0, kMaxPixels));
  };
  Painter painter(Backend::osmesa, size("width", 960), size("height", 540), Quality::draft);
  return file_of("image/png", shared_bytes(encode_png(painter.paint(painter_.drawn()))), false);
}

void LabRoutes::answer_open(const HttpRequest& request, const Answer& answer) {
  const std::string name = query_value(request.query, "name").value_or("");
  if (!audience_.has_hand(query_value(request.query, "secret").value_or("")))
    return answer(reply_of(403, "another page has control; ask for it"));
  if (!is_plain(name))
    return answer(reply_of(422, "name: '" + name + "' is none for a file; use letters, digits, -"));
  do_errand(answer, [this, name, body = request.body, answer] { open(name, body, answer); });
}

// What is no scene by itself (a mesh) waits in the folder for the one that names it.
void LabRoutes::open(const std::string& name, const std::string& bytes, const Answer& answer) {
  const BroughtFile brought = brought_file(name, bytes);
  if (!brought.fault.empty()) return answer(reply_of(422, name + ": " + brought.fault));
  const std::filesystem::path file = uploads_.write(brought.path, bytes);
  if (!brought.opens) return answer(reply_of(202, "kept"));
  BuildRequest order;
  order.file = file;
  if (session_.shown().now().scene->order.is_shared) order.roots = {uploads_.path(), find_assets()};
  order.name = file.stem().string();
  order.words.title = order.name;
  order.words.file = name;
  order.done = [answer](const std::string& faults) {
    answer(faults.empty() ? reply_of(200, "opened") : reply_of(422, faults));
  };
  session_.open(std::move(order));
}

}  // namespace twinarm
