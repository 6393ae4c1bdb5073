// A lab with several clients, without its threads: the bytes choose which of them acts next. Left
// out: the server, the tasks, the clock, the trial of fixes, and the child process in which an
// upload is tried. What the threads call may throw nothing but an InputError.
#include <nlohmann/json.hpp>
#include <set>

#include "app/device/devices.h"
#include "app/lab/app/clients.h"
#include "app/lab/app/uploads.h"
#include "app/lab/session/lab_session.h"
#include "app/support/files.h"
#include "app/support/text.h"
#include "solver/support/input_file.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = TWINARM_SOURCE_DIR, kSeeds = kSource / "tests/fuzz/seeds",
               kRobot = kSource / "assets/robots/teaching/double_pendulum.urdf";

class ScheduledLab {
 public:
  explicit ScheduledLab(Bytes bytes) : bytes_(bytes) {
    reporter_.set_rate(1e9);  // a frame of each step
    open(order_to_open(gallery_[0]));
    build_waiting();
    turn();
    come_or_leave(ids_[0]);
  }
  void act_all() {
    constexpr int kMaxActs = 300, kMaxBuilds = 8;
    for (int n = 0; n < kMaxActs && builds_ < kMaxBuilds && !bytes_.empty(); ++n) act();
    if (!ids_[0]) come_or_leave(ids_[0]);
    for (ClientId& client : ids_)
      if (&client != &ids_[0] && client) come_or_leave(client);
    turn_often();  // what the clients have ordered
    const long scenes = state_.status.scene;
    say(ids_[0], R"({"do": "scene", "name": "first"})");
    turn_often();
    require(state_.status.scene == scenes + 1 && state_.loop.run().view().time() > 0,
            "the run steps no more");
  }

 private:
  std::string take_text(std::size_t size) {
    const std::string text(bytes_.substr(0, size));
    bytes_.remove_prefix(text.size());
    return text;
  }
  unsigned take() { return bytes_.empty() ? 0 : static_cast<unsigned char>(take_text(1)[0]); }
  // One of lab_message, with changed digits and letters.
  std::string take_message() {
    static const std::vector<std::string> known = [] {
      std::set<std::string> texts;
      for (const auto& file : fs::directory_iterator(kSeeds / "lab_message"))
        texts.insert(read_whole_file(file));
      return std::vector(texts.begin(), texts.end());
    }();
    std::string text = known[take() % known.size()];
    for (unsigned n = take() % 3; n > 0; --n) {
      char& c = text[take() % text.size()];
      if (std::isdigit(static_cast<unsigned char>(c)) != 0)
        c = "0123456789-.e"[take() % 13];
      else if (std::isalpha(static_cast<unsigned char>(c)) != 0)
        c = static_cast<char>(take());
    }
    return text;
  }
  void act() {
    const unsigned what = take() % 16;
    ClientId& client = ids_[take() % ids_.size()];
    if (what == 0)
      come_or_leave(client);
    else if (what < 6)
      say(what < 4 ? clients_.view().controller : client, take_message());
    else if (what == 6)
      say(client, take_text(take()));
    else if (what == 7)
      upload(client);
    else if (what < 10)
      build_waiting();
    else
      turn();
    check();
  }

  // As `twinarm lab --listen` does.
  void come_or_leave(ClientId& client) {
    if (!client) return clients_.opened(client = ++count_);
    if (clients_.has_control(client)) state_.inbox.push(LabCommand{});  // release
    clients_.closed(std::exchange(client, 0));
  }
  void say(ClientId client, const std::string& text) {
    const ClientId controller = clients_.view().controller;
    noted([&] {
      LabCommand command = parse_command(text);
      text_of_command(text);
      if (!client || (needs_control(command.what) && client != controller)) return;
      const bool is_device = command.what == "input" && command.name == "device";
      if (is_device && !stays_inside(command.spec)) return;
      if (command.what == "layers")
        clients_.want_layers(client, std::move(command.names));
      else if (command.what == "inspect")
        clients_.want_inspection(client, command.on ? std::optional(command.count) : std::nullopt);
      else if (command.what == "request_control")
        clients_.take(client);
      else if (command.what == "grant_control")
        clients_.give(client, static_cast<ClientId>(command.count));
      else if (client == controller)
        state_.inbox.push(std::move(command));
      else
        fail("a client without control changes the run");
    });
    require(client == controller || !controller || controller == clients_.view().controller,
            "a client takes control from another");
  }
  void upload(ClientId client) {
    const char* kNames[] = {"a.stl", "a.stl/b.obj", "s.toml", "b/c/d.png", "arm.xml", "n.txt"};
    const char* name = kNames[take() % std::size(kNames)];
    const unsigned kind = take() % 3;
    const std::string text = kind == 0 ? scene_ : kind == 1 ? robot_ : take_text(take());
    const Clients::View view = clients_.view();
    if (!client || client != view.controller) return;
    require(clients_.controller(view.clients.at(client).secret) == client,
            "the secret is another's");
    require(clients_.has_control(client), "a client without control uploads");
    noted([&] {
      const UploadedFile upload = classify_upload(name, text);
      if (!upload.fault.empty()) return;
      BuildRequest request;
      request.file = uploads_.write(client, upload.path, text);
      request.roots = {uploads_.path(), find_assets()};
      request.name = request.file.stem();
      if (upload.opens) open(std::move(request));
    });
  }

  // As the builder's thread does.
  void open(BuildRequest request) {
    request.is_shared = true;
    waiting_ = std::move(request);
  }
  void build_waiting() {
    if (!waiting_) return;
    ++builds_;
    const BuildRequest request = *std::exchange(waiting_, {});
    const bool is_built = noted([&] { state_.inbox.push(build(request)); });
    if (!is_built && !request.pending.empty())
      state_.inbox.push_refused(request.pending.back().number);
  }

  // Until an order is carried out and a step taken.
  void turn_often() {
    for (int n = 0; n < 3; ++n) {
      build_waiting();
      turn();
    }
  }
  // As the run's thread does, with one step.
  void turn() {
    LabStatus& status = state_.status;
    Inbox::Contents contents = state_.inbox.take();
    for (const LabCommand& command : contents.commands) noted([&] { commands_.act(command); });
    if (contents.refused) state_.finish(*contents.refused);
    for (BuildResult& built : contents.built)
      if (noted([&] { commands_.adopt(std::move(built)); })) reporter_.publish();
    if (state_.loop.has_single_steps() || status.playing) {
      state_.loop.request_steps(1);
      state_.is_stale = true;
      if (!state_.loop.take_steps([] {})) {
        status.playing = false;
        state_.loop.request_steps(0);
        if (const PostMortem* found = state_.loop.run().post_mortem())
          status.failure = RunFailure{found->time, found->time, found->words, false,
                                      fixes_of(state_.loop.run().prepared(), *found)};
      }
    }
    reporter_.publish();
  }

  // Whether f goes through; what it throws is shown to the clients.
  template <class F>
  bool noted(F f) {
    DiagnosticList faults;
    attempt(faults, f);
    for (const Diagnostic& fault : faults.faults()) state_.inbox.note("error", to_string(fault));
    return faults.empty();
  }
  void check() const {
    const Clients::View view = clients_.view();
    const std::string message = state_message(*shown_.now().status, view, {}, gallery_);
    require(nlohmann::ordered_json::accept(message), "the message `state` is not JSON");
    require(!view.controller || view.clients.contains(view.controller),
            "one who has left has control");
    require(view.waiting.size() < ids_.size() && (view.waiting.empty() || view.controller),
            "a request for control is void");
    require(state_.status.notes.size() <= Inbox::kMaxNotes, "too many notes");
    std::size_t files = 0, size = 0;
    std::error_code ignored;
    for (const auto& entry : fs::recursive_directory_iterator(uploads_.path(), ignored))
      if (entry.is_regular_file()) ++files, size += entry.file_size();
    require(files <= kMaxFiles && size <= kMaxBytes, "too many uploads are kept");
  }

  static constexpr std::size_t kMaxFiles = 3, kMaxBytes = 2500, kHistory = 1 << 20;
  Bytes bytes_;
  const std::string scene_ = read_whole_file(kSeeds / "scene/lab.toml"),
                    robot_ = read_whole_file(kRobot);
  const fs::path beside_ = folder().write("lab/arm.urdf", robot_),
                 file_ = folder().write("lab/first.toml", scene_);
  const std::vector<GalleryScene> gallery_{
      {"first", "first", file_, "", {}, {}},
      {"varied", "varied", file_, "", {}, parse_variants("coupling.one.stiffness=20,2e3")}};
  SessionState state_{kHistory};
  SessionCommands commands_{state_, gallery_, [this](BuildRequest one) { open(std::move(one)); }};
  Publisher shown_;
  StatusReporter reporter_{state_, shown_};
  Clients clients_;
  UploadFolder uploads_{folder().path() / "lab/uploads", kMaxFiles, kMaxBytes};
  std::array<ClientId, 4> ids_{};
  ClientId count_ = 0;
  std::optional<BuildRequest> waiting_;
  int builds_ = 0;
};

}  // namespace

void lab_session(Bytes bytes) {
  fs::remove_all(folder().path() / "lab/uploads");
  ScheduledLab(bytes).act_all();
}

}  // namespace twinarm::fuzz
