// twinarm lab: a laboratory in the browser (docs/use/lab.md).
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <thread>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/device/devices.h"
#include "app/lab/app/lab_routes.h"
#include "app/lab/app/message_streamer.h"
#include "app/lab/session/lab_session.h"
#include "app/support/progress.h"
#include "app/web/web_bundle.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

struct LabOptions {
  std::filesystem::path scene;  // empty: the first of the gallery
  std::string lanes;            // "integrator=semi-implicit,rk4"; empty: as the gallery says
  std::string listen = "127.0.0.1";
  int port = 0;        // 0: any that is free
  int remember = 256;  // of a run [MB]
  bool no_browser = false, json = false;
};

void add_options(CLI::App& command, LabOptions& options) {
  add_input_option(command, "scene", options.scene,
                   "a scene, a URDF or a recording; left out: the first of the gallery");
  command.get_option("scene")->required(false);
  command
      .add_option("--lanes", options.lanes,
                  "runs of the scene side by side, one for each value: PATH=VALUE,VALUE.., as "
                  "integrator=semi-implicit,rk4 or coupling.stiffness=500,2000")
      ->type_name("PATH=VALUES");
  command.add_option("--port", options.port, "of the server; left out: any that is free")
      ->check(between(0, 65535));
  command
      .add_option("--listen", options.listen,
                  "address: another than 127.0.0.1 lets others on the network in who have the "
                  "page's address with its token")
      ->capture_default_str();
  command
      .add_option("--remember", options.remember,
                  "megabytes of frames: how far back one can go, some minutes at 256")
      ->check(between(1, 65536))
      ->capture_default_str();
  command.add_flag("--no-browser", options.no_browser, "only print the address");
  command.add_flag("--json", options.json, "print {\"url\": \"..\"} as the first line");
}

// Of what was asked for; else the gallery's first.
BuildRequest scene_asked_for(const LabOptions& options, const std::vector<GalleryScene>& gallery) {
  BuildRequest order;
  if (options.scene.empty()) return order_to_open(gallery.front());
  std::error_code ignored;
  for (const GalleryScene& scene : gallery)
    if (scene.name == options.scene.string() ||
        std::filesystem::equivalent(scene.file, options.scene, ignored))
      return order_to_open(scene);
  order.file = options.scene;
  order.name = options.scene.stem().string();
  order.words.title = order.name;
  order.words.file = options.scene.filename().string();
  return order;
}

bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.rfind("127.", 0) == 0;
}

BuildRequest first_order(const LabOptions& options, const std::vector<GalleryScene>& gallery) {
  BuildRequest order = scene_asked_for(options, gallery);
  if (!options.lanes.empty()) order.lanes = parse_lanes(options.lanes);
  order.is_shared = !is_loopback(options.listen);
  return order;
}

// Where there is a screen, and a program that knows the browser. It is not waited for.
void open_browser(const std::string& url) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {0, 1, 2})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_RDWR, 0);
  std::string program = "xdg-open", address = url;
  char* const words[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, words[0], &quiet, nullptr, words, environ) == 0)
    std::thread([child] { waitpid(child, nullptr, 0); }).detach();
  posix_spawn_file_actions_destroy(&quiet);
}

// Of a page that may be on another machine, where others are let in at all.
void refuse_what_opens(const LabCommand& command) {
  if (command.what != LabCommand::Do::hand || command.name != "device") return;
  if (stays_inside(command.spec)) return;
  throw InputError({{"command", 0, "hand, spec",
                     "'" + command.spec +
                         "' opens a file, a device or a socket of the machine that the lab runs "
                         "on, and with --listen pages on other machines may not ask for that",
                     "take virtual:synthetic or the like, or start the lab without --listen (over "
                     "ssh -L)",
                     "lab.not-allowed"}});
}

LabCommand drop_all() {
  LabCommand command;
  command.what = LabCommand::Do::drop;
  return command;
}

// Session, painter and server, each with its thread; a message goes to whom it concerns.
class Lab {
 public:
  Lab(const LabOptions& options, std::vector<GalleryScene> gallery)
      : gallery_(std::move(gallery)),
        is_private_(is_loopback(options.listen)),
        session_(build(first_order(options, gallery_)), gallery_,
                 static_cast<std::size_t>(options.remember) << 20),
        painter_(session_, audience_, gallery_,
                 [this](ClientId client, MessageStreamer::Channel channel, Bytes bytes,
                        bool binary) { server_->send(client, channel, std::move(bytes), binary); }),
        routes_(session_, painter_, audience_, gallery_, std::string(web_bundle().lab),
                std::string(web_bundle().missing)) {
    ServerOptions server;
    server.address = options.listen;
    server.port = static_cast<std::uint16_t>(options.port);
    server.token = random_token();
    server_ = std::make_unique<LabServer>(server, handlers());
    painter_.begin();
  }
  // Threads end before those that they call.
  ~Lab() {
    session_.end();
    painter_.end();
    routes_.end();
    server_.reset();
  }
  std::string url() const { return server_->url(); }

 private:
  ServerHandlers handlers() {
    ServerHandlers handlers;
    handlers.http = [this](const HttpRequest& request,
                           const std::function<void(HttpReply)>& answer) {
      routes_.answer(request, answer);
    };
    handlers.opened = [this](ClientId client) {
      audience_.opened(client);
      painter_.look_again();
    };
    handlers.closed = [this](ClientId client) {
      // What a page held that is gone would be held for ever.
      if (audience_.has_hand(client)) session_.push(drop_all());
      audience_.closed(client);
      session_.shown().wake();
    };
    handlers.message = [this](ClientId client, const std::string& text) { hear(client, text); };
    return handlers;
  }

  void hear(ClientId client, const std::string& text) {
    try {
      LabCommand command = parse_command(text);
      if (needs_hand(command.what) && !audience_.has_hand(client))
        return session_.note("warning", "somebody else has the hand; ask for it");
      if (!is_private_) refuse_what_opens(command);
      switch (command.what) {
        case LabCommand::Do::layers:
          audience_.want_layers(client, std::move(command.names));
          break;
        case LabCommand::Do::glass:
          audience_.want_glass(client,
                               command.on ? std::optional<long>(command.count) : std::nullopt);
          break;
        case LabCommand::Do::take:
          audience_.take(client);
          break;
        case LabCommand::Do::give:
          if (!audience_.give(client, static_cast<ClientId>(command.count)))
            session_.note("warning", "the hand cannot be given to who is not there");
          break;
        default:
          return session_.push(std::move(command));
      }
      painter_.look_again();
    } catch (const InputError& error) {
      for (const Diagnostic& fault : error.faults()) session_.note("error", to_string(fault));
    }
  }

  std::vector<GalleryScene> gallery_;
  bool is_private_;  // no other machine is let in
  Clients audience_;
  std::unique_ptr<LabServer> server_;  // ends last: the others post to it
  LabSession session_;
  MessageStreamer painter_;
  LabRoutes routes_;
};

int run_lab(const LabOptions& options) {
  Lab lab(options, read_gallery());
  if (options.json)
    fmt::print("{{\"url\": \"{}\"}}\n", lab.url());
  else
    fmt::print("The lab is at {}\nCtrl-C ends it.\n", lab.url());
  std::fflush(stdout);
  if (!options.no_browser) open_browser(lab.url());
  while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return 0;
}

}  // namespace

Command lab_command() {
  return {
      10, "lab",
      "A laboratory in the browser: grab the robot, turn the gains, look at every force\n\n"
      "Example:  twinarm lab assets/scenes/hand_and_obstacles.toml\n\n"
      "Prints the page's address and opens it where there is a browser; Ctrl-C ends it. On another "
      "machine: ssh -L 8080:127.0.0.1:8080 HOST, and there: twinarm lab --port 8080 --no-browser",
      add_options, run_lab};
}

}  // namespace twinarm
