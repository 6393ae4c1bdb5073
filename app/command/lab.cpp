// `twinarm lab`: interactive simulation in the browser (docs/use/lab.md).
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cctype>
#include <cstdlib>
#include <thread>

#include "app/command/command.h"
#include "app/data/json_writer.h"
#include "app/device/devices.h"
#include "app/lab/app/audit_log.h"
#include "app/lab/app/lab_routes.h"
#include "app/lab/app/message_streamer.h"
#include "app/lab/session/lab_session.h"
#include "app/support/program.h"
#include "app/support/progress.h"
#include "collision/mesh_files/assimp_reader.h"
#include "collision/sandbox/fork_server.h"
#include "collision/sandbox/isolated_parser.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

struct LabOptions {
  std::filesystem::path scene;       // empty: the first of the gallery
  std::string variants;              // "integrator=semi-implicit,rk4"; empty: the gallery's
  std::vector<std::string> changes;  // "integrator=rk4"
  std::string overlays;              // "energy,couplings"; empty: the page's own
  std::string listen = "127.0.0.1";
  int port = 0;       // 0: any free port
  int history = 256;  // memory for the timeline [MB]
  bool no_browser = false, json = false;
};

void add_options(const OptionAdder& add, LabOptions& options) {
  add.input("scene", options.scene, "",
            "scene, URDF or recording; default: the first scene of the gallery");
  add.group("Run");
  add("--variants", options.variants,
      "run variants side by side, one per value: PATH=VALUE,VALUE.., such as "
      "integrator=semi-implicit,rk4 or coupling.stiffness=500,2000")
      ->type_name("PATH=VALUES");
  add("--set", options.changes, "PATH=VALUE: start with this parameter; may be repeated");
  add("--show", options.overlays, "overlays to show: couplings,contacts .., as the page names them")
      ->type_name("NAME,..");
  add("--history", options.history, "memory for the timeline [MB]; 256 MB hold a few minutes")
      ->check(between(1, 65536));
  add.group("Server");
  add("--port", options.port, "port of the server; default: any free port")
      ->check(between(0, 65535))
      ->default_str("");
  add("--listen", options.listen,
      "address to bind; one that is not loopback lets others in who have the page's address with "
      "its token");
  add("--no-browser", options.no_browser, "only print the address");
  add("--json", options.json, "print {\"schema\": 1, \"url\": \"..\"} as the first line");
}

// A scene of the gallery by name or file, or any other file; default: the first of the gallery.
BuildRequest requested_scene(const LabOptions& options, const std::vector<GalleryScene>& gallery) {
  if (options.scene.empty()) return order_to_open(gallery.front());
  std::error_code ignored;
  for (const GalleryScene& scene : gallery)
    if (scene.name == options.scene.string() ||
        std::filesystem::equivalent(scene.file, options.scene, ignored))
      return order_to_open(scene);
  check_input(options.scene, "scene", kModelEndings, "scene, URDF or recording");
  BuildRequest request;
  request.file = options.scene;
  request.name = options.scene.stem().string();
  request.words.title = request.name;
  request.words.file = options.scene.filename().string();
  return request;
}

bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.rfind("127.", 0) == 0;
}

BuildRequest first_request(const LabOptions& options, const std::vector<GalleryScene>& gallery) {
  BuildRequest request = requested_scene(options, gallery);
  if (!options.variants.empty()) request.variants = parse_variants(options.variants);
  request.is_shared = !is_loopback(options.listen);
  return request;
}

// Faults of the variants' changes name --variants.
BuildResult first_scene(const LabOptions& options, const std::vector<GalleryScene>& gallery) try {
  return build(first_request(options, gallery));
} catch (const InputError& error) {
  throw error.changed([](Diagnostic& fault) {
    if (fault.where.starts_with("--set ")) fault.where.replace(0, 5, "--variants");
  });
}

// What the page does when it is opened (app/web/src/pages/address.ts).
std::string query_of(const LabOptions& options) {
  std::string query;
  const auto add = [&](const char* key, const std::string& value) {
    query += fmt::format("&{}=", key);
    for (const unsigned char c : value)
      query += std::isalnum(c) ? std::string(1, static_cast<char>(c)) : fmt::format("%{:02X}", c);
  };
  for (const std::string& change : options.changes) add("set", change);
  if (!options.overlays.empty()) add("show", options.overlays);
  return query;
}

// If there is a display. Does not wait for the browser.
void open_browser(const std::string& url) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  const std::filesystem::path program = find_program("xdg-open");
  if (program.empty()) return;
  const int quiet = open("/dev/null", O_RDWR | O_CLOEXEC);
  const pid_t child = start_program({program.string(), url}, quiet, quiet, quiet);
  close(quiet);
  if (child != 0) std::thread([child] { exit_code_of(child); }).detach();
}

// Rejects devices that open files or sockets here: with --listen the page may be on another
// machine.
void check_shared_device(const LabCommand& command) {
  if (command.what != "input" || command.name != "device") return;
  if (stays_inside(command.spec)) return;
  throw InputError({{"command", 0, "hand, spec",
                     "'" + command.spec +
                         "' opens a file, a device or a socket of the machine that runs the lab; "
                         "with --listen this is not allowed",
                     "choose virtual:synthetic or another virtual device, or start the lab without "
                     "--listen (over ssh -L)",
                     "lab.not-allowed"}});
}

// Session, message streamer and server, each with its thread.
class Lab {
 public:
  Lab(const LabOptions& options, std::vector<GalleryScene> gallery)
      : gallery_(std::move(gallery)),
        is_private_(is_loopback(options.listen)),
        session_(first_scene(options, gallery_), gallery_,
                 static_cast<std::size_t>(options.history) << 20),
        streamer_(session_, clients_, gallery_,
                  [this](ClientId client, MessageStreamer::Channel channel, Bytes bytes) {
                    server_->send(client, channel, std::move(bytes),
                                  channel == MessageStreamer::frame_channel);
                  }),
        routes_(session_, streamer_, clients_, gallery_) {
    ServerOptions server;
    server.address = options.listen;
    server.port = static_cast<std::uint16_t>(options.port);
    server.token = random_token();
    if (!is_private_) server.max_of_address = 24;  // others keep places
    server_ = std::make_unique<LabServer>(server, handlers());
    streamer_.begin();
  }
  // Ends each thread before those that it calls.
  ~Lab() {
    session_.end();
    streamer_.end();
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
    handlers.may_post = [this](const std::string& query) {
      const ClientId client = clients_.controller(query_value(query, "secret").value_or(""));
      if (client != 0) log(client, "open " + query_value(query, "name").value_or(""));
      return client != 0;
    };
    handlers.opened = [this](ClientId client, const std::string& address) {
      clients_.opened(client, address);
      streamer_.look_again();
    };
    handlers.closed = [this](ClientId client) {
      // Releases what the closed page was dragging.
      if (clients_.has_control(client)) session_.push(LabCommand());
      clients_.closed(client);
      session_.shown().wake();
    };
    handlers.message = [this](ClientId client, const std::string& text) { handle(client, text); };
    return handlers;
  }

  void handle(ClientId client, const std::string& text) {
    try {
      LabCommand command = parse_command(text);
      if (needs_control(command.what) && !clients_.has_control(client))
        return note(client, "warning", "another client has control; request it");
      if (!is_private_) check_shared_device(command);
      if (!is_private_ && needs_control(command.what))
        log(client, text_of_command(text), is_movement(command.what));
      if (command.what == "layers") {
        clients_.want_layers(client, std::move(command.names));
      } else if (command.what == "inspect") {
        clients_.want_inspection(client,
                                 command.on ? std::optional<long>(command.count) : std::nullopt);
      } else if (command.what == "request_control") {
        clients_.take(client);
      } else if (command.what == "grant_control") {
        if (!clients_.give(client, static_cast<ClientId>(command.count)))
          note(client, "warning", "only the client in control grants it, to a connected client");
        else
          log(client, "grant_control to " + clients_.name(clients_.view().controller));
      } else {
        return session_.push(std::move(command));
      }
      streamer_.look_again();
    } catch (const InputError& error) {
      for (const Diagnostic& fault : error.faults()) note(client, "error", to_string(fault));
    }
  }

  // Clients without control share one note a second: they hide no other notes.
  void note(ClientId client, const char* level, const std::string& text) {
    if (clients_.has_control(client) || notes_.passes(std::chrono::steady_clock::now(), 1))
      session_.note(level, text);
  }

  void log(ClientId client, const std::string& change, bool is_movement = false) {
    if (!is_private_) audit_.add(clients_.name(client), change, is_movement);
  }

  std::vector<GalleryScene> gallery_;
  bool is_private_;  // listens on loopback only
  Clients clients_;
  AuditLog audit_;                     // these two: used by the server's thread only
  RateLimiter notes_;                  // of clients without control
  std::unique_ptr<LabServer> server_;  // ends last: the others send through it
  LabSession session_;
  MessageStreamer streamer_;
  LabRoutes routes_;
};

int run_lab(const LabOptions& options) try {
  twinarm_assimp_reader();  // opens its module for the server too
  const ForkServer before_threads;
  isolate_parsers();
  Lab lab(options, read_gallery());
  const std::string url = lab.url() + query_of(options);
  if (options.json)
    fmt::print("{{\"schema\": {}, \"url\": \"{}\"}}\n", kJsonSchema, url);
  else
    fmt::print("The lab is at {}\nCtrl-C ends it.\n", url);
  std::fflush(stdout);
  if (!options.no_browser) open_browser(url);
  while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return 0;
} catch (const std::exception&) {
  if (!is_interrupted()) throw;
  return 0;  // while the first scene is read or built: Ctrl-C ends the lab then, too
}

}  // namespace

Command lab_command() {
  return {10, "lab",
          "Run an interactive simulation in the browser\n\n"
          "Examples:\n"
          "  twinarm lab\n"
          "  twinarm lab assets/scenes/hand_and_obstacles.toml\n"
          "  twinarm lab assets/scenes/pendulum.toml --set integrator=rk4 --set step=0.2\n\n"
          "Prints the address of the page and opens it in a browser; Ctrl-C ends it. To run it "
          "on HOST: ssh -L 8080:127.0.0.1:8080 HOST, then on HOST: twinarm lab --port 8080 "
          "--no-browser",
          add_options, run_lab};
}

}  // namespace twinarm
