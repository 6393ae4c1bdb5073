#include "app/lab/lab_routes.h"

#include <stdlib.h>

#include <algorithm>
#include <charconv>

#include "app/output_file.h"
#include "app/web/replay_page.h"
#include "solver/fault.h"
#include "solver/whole_file.h"

namespace twinarm {
namespace {

constexpr double kMostPixels = 1920;

Bytes bytes_of(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

HttpReply reply_of(int status, const std::string& text) {
  HttpReply reply;
  reply.status = status;
  reply.body = bytes_of(text + "\n");
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
  for (const Fault& fault : error.faults()) words += to_string(fault) + "\n";
  words.pop_back();
  return reply_of(422, words);
}

// The value of a key in "a=1&b=x%20y"; empty where there is none.
std::string query_value(const std::string& query, const std::string& key) {
  for (std::size_t begin = 0; begin < query.size();) {
    const std::size_t end = std::min(query.find('&', begin), query.size());
    const std::string part = query.substr(begin, end - begin);
    begin = end + 1;
    if (part.rfind(key + "=", 0) != 0) continue;
    std::string value;
    for (std::size_t i = key.size() + 1; i < part.size(); ++i) {
      unsigned code = 0;
      if (part[i] == '%' && i + 2 < part.size() &&
          std::from_chars(&part[i + 1], &part[i + 3], code, 16).ptr == &part[i + 3]) {
        value += static_cast<char>(code);
        i += 2;
      } else {
        value += part[i] == '+' ? ' ' : part[i];
      }
    }
    return value;
  }
  return "";
}

double number_of(const std::string& query, const std::string& key, double otherwise) {
  const std::string text = query_value(query, key);
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
         name.find("..") == std::string::npos && std::all_of(name.begin(), name.end(), is_good);
}

std::filesystem::path temporary_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "twinarm-lab-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw InputError({{name, 0, "", "a temporary folder cannot be made", "set TMPDIR"}});
  return name;
}

std::string after(const std::string& path, const std::string& start) {
  return path.rfind(start, 0) == 0 ? path.substr(start.size()) : "";
}

}  // namespace

LabRoutes::LabRoutes(LabSession& session, LabPainter& painter,
                     const std::vector<GalleryScene>& gallery, std::string page,
                     std::string missing)
    : session_(session),
      painter_(painter),
      gallery_(gallery),
      page_(bytes_of(std::move(page))),
      missing_(std::move(missing)),
      folder_(temporary_folder()) {}

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
  answer_later(request, answer);
}

void LabRoutes::answer_picture(const std::string& name, const Answer& answer) const {
  for (const GalleryScene& scene : gallery_)
    if (scene.name + ".png" == name && !scene.picture.empty())
      return answer(file_of("image/png", bytes_of(read_whole_file(scene.picture)), false));
  answer(not_found());
}

void LabRoutes::answer_later(const HttpRequest& request, const Answer& answer) {
  painter_.ask([this, request, answer](LabPainter& painter) {
    const std::string& path = request.path;
    try {
      if (const std::string hash = after(path, "/mesh/"); !hash.empty()) {
        const Bytes mesh = painter.view().mesh(hash);
        answer(mesh ? file_of("application/octet-stream", mesh, true) : not_found());
      } else if (const std::string picture = after(path, "/texture/"); !picture.empty()) {
        const Bytes texture = painter.view().texture(picture);
        answer(texture ? file_of("image/png", texture, true) : not_found());
      } else if (path == "/history") {
        const double from = number_of(request.query, "from", 0);
        answer(file_of("application/octet-stream", bytes_of(painter.history(from)), false));
      } else if (path == "/frame.png") {
        const auto size = [&](const char* key, double otherwise) {
          return static_cast<int>(
              std::clamp(number_of(request.query, key, otherwise), 64.0, kMostPixels));
        };
        answer(file_of("image/png",
                       bytes_of(painter.picture(size("width", 960), size("height", 540))), false));
      } else if (path == "/save") {
        answer(save());
      } else if (path == "/share") {
        answer(share());
      } else if (path == "/scene") {
        const LabNow now = session_.now();
        answer(file_of("application/toml; charset=utf-8",
                       bytes_of(now.scene->scene->text(now.status->changes)), false));
      } else {
        answer(not_found());
      }
    } catch (const InputError& error) {
      answer(faults_of(error));
    }
  });
}

HttpReply LabRoutes::save() const {
  const std::filesystem::path file = folder_ / "save.twinrec";
  session_.save(file);
  HttpReply reply = file_of("application/octet-stream", bytes_of(read_whole_file(file)), false);
  reply.file_name = "lab.twinrec";
  return reply;
}

HttpReply LabRoutes::share() const {
  const std::filesystem::path file = folder_ / "share.twinrec";
  session_.save(file);
  HttpReply reply = file_of("text/html; charset=utf-8", bytes_of(replay_page(file).html), false);
  reply.file_name = "lab.html";
  return reply;
}

// What is no scene by itself (a mesh) waits in the folder for the one that names it.
void LabRoutes::answer_open(const HttpRequest& request, const Answer& answer) {
  const std::string name = query_value(request.query, "name");
  if (!is_plain(name))
    return answer(reply_of(422, "name: '" + name + "' is none for a file; use letters, digits, -"));
  try {
    const std::filesystem::path file = folder_ / name;
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    write_whole_file(file, request.body);
    const std::string end = file.extension().string();
    if (end != ".toml" && end != ".urdf" && end != ".twinrec") return answer(reply_of(200, "kept"));
    Order order;
    order.file = file;
    order.name = file.stem().string();
    order.words.title = order.name;
    order.words.file = name;
    order.done = [answer](const std::string& faults) {
      answer(faults.empty() ? reply_of(200, "opened") : reply_of(422, faults));
    };
    session_.open(std::move(order));
  } catch (const InputError& error) {
    answer(faults_of(error));
  }
}

}  // namespace twinarm
