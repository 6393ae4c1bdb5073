// Commands, control, uploads, and the run's thread.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>

#include "app/lab/app/clients.h"
#include "app/lab/app/uploads.h"
#include "app/lab/session/lab_command.h"
#include "app/lab/session/lab_session.h"
#include "app/lab/session/run_loop.h"
#include "solver/support/diagnostics.h"
#include "tests/app/lab/run/helpers.h"
#include "tests/app/lab/session/built_scene.h"
#include "tests/support/waiting.h"

namespace twinarm {
namespace {

std::size_t faults_in(const std::string& text) {
  try {
    parse_command(text);
  } catch (const InputError& error) {
    return error.faults().size();
  }
  return 0;
}

std::string texts_of(const std::vector<Change>& changes) {
  std::string all;
  for (const Change& change : changes) all += change.path + "=" + change.value + " ";
  return all;
}

struct TestSession {
  const std::vector<GalleryScene> gallery{};
  LabSession session{built_from(kSlowlyDriven), gallery};
  void set(const std::string& change) {
    session.push(parse_command(R"({"do": "set", "changes": [")" + change + "\"]}"));
  }
  bool comes_to(const std::string& changes) const {
    return comes_true([&] { return texts_of(session.shown().now().status->changes) == changes; });
  }
  bool has_note(const std::string& words) const {
    return comes_true([&] {
      const auto status = session.shown().now().status;
      return std::any_of(status->notes.begin(), status->notes.end(), [&](const LabNote& note) {
        return note.text.find(words) != std::string::npos;
      });
    });
  }
};

TEST_CASE("lab session: a refused change affects neither the waiting ones nor the next") {
  TestSession lab;
  lab.set("coupling.one.stiffness=30");
  lab.set("coupling.one.damping=2");
  lab.set("coupling.one.stiffness=-7");
  lab.set("gravity[2]=-1.62");
  CHECK(lab.has_note("-7"));
  CHECK(lab.comes_to("coupling.one.stiffness=30 coupling.one.damping=2 gravity[2]=-1.62 "));
  lab.set("coupling.one.damping=3");
  CHECK(lab.comes_to("coupling.one.stiffness=30 gravity[2]=-1.62 coupling.one.damping=3 "));
  const auto status = lab.session.shown().now().status;
  std::string texts;
  for (const LabNote& note : status->notes) texts += note.level + ": " + note.text + "\n";
  CAPTURE(texts);
  CHECK(std::count_if(status->notes.begin(), status->notes.end(),
                      [](const LabNote& note) { return note.level == "error"; }) == 1);
}

TEST_CASE("lab session: restoring the scene discards earlier changes, not later ones") {
  TestSession lab;
  lab.set("coupling.one.stiffness=30");
  lab.session.push(parse_command(R"({"do": "reset_parameters"})"));
  lab.set("coupling.one.damping=2");
  CHECK(lab.comes_to("coupling.one.damping=2 "));
}

TEST_CASE("lab session: of two changes of one value the later is in effect, by any path") {
  std::vector<Change> changes;
  for (const char* text :
       {"coupling.stiffness=31", "coupling.one.stiffness=32", "coupling.stiffness=33"})
    put(changes, parse_change(text));
  CHECK(built_from(kSlowlyDriven).scene->text(changes).find("stiffness = 33") != std::string::npos);
}

TEST_CASE("lab session: an exception in the run's thread pauses the run and is shown as an error") {
  TestSession lab;
  BuildRequest request;
  const TemporaryFolder folder;
  request.file = folder.write("scene.toml", kFreeBox);
  request.done = [](const std::string&) { throw std::runtime_error("no client"); };
  lab.session.open(std::move(request));
  CHECK(lab.has_note("the run is paused: no client"));
  CHECK_FALSE(lab.session.shown().now().status->playing);
  lab.session.push(parse_command(R"({"do": "play", "on": true})"));
  CHECK(comes_true([&] { return lab.session.shown().now().status->playing; }));
}

TEST_CASE(
    "lab session: an exception in the builder's thread is shown, and the next scene is built") {
  TestSession lab;
  const TemporaryFolder folder;
  BuildRequest bad, good;
  bad.file = folder.path() / "nowhere.toml";
  bad.done = [](const std::string&) { throw std::runtime_error("the client has gone"); };
  lab.session.open(std::move(bad));
  CHECK(lab.has_note("nowhere.toml"));
  CHECK(lab.has_note("the client has gone"));
  good.file = folder.write("scene.toml", kFreeBox);
  good.name = "box";
  lab.session.open(std::move(good));
  CHECK(comes_true([&] { return lab.session.shown().now().status->scene_name == "box"; }));
}

TEST_CASE("lab session: the callback of a superseded request may call the session") {
  std::promise<void> begun, go_on;
  std::string answer;
  TestSession lab;
  BuildRequest blocking, replaced, last;
  blocking.file = "nowhere.toml";
  blocking.done = [&](const std::string&) {
    begun.set_value();
    go_on.get_future().wait();
  };
  replaced.done = [&](const std::string& why) {
    answer = why + lab.session.shown().now().status->scene_name;
  };
  lab.session.open(std::move(blocking));
  begun.get_future().wait();
  lab.session.open(std::move(replaced));
  lab.session.open(std::move(last));
  CHECK(answer.find("try again") != std::string::npos);
  go_on.set_value();
}

TEST_CASE("lab session: of too many notes the last are kept") {
  TestSession lab;
  for (int n = 1; n <= 500; ++n) lab.session.note("note", "number " + std::to_string(n) + ".");
  CHECK(lab.has_note("number 500."));
  CHECK(lab.has_note("number 481."));
  CHECK(lab.session.shown().now().status->notes.size() == 20);
}

TEST_CASE("lab session: the history begins at the start, however many steps are requested") {
  TestSession lab;
  const long before = lab.session.shown().now().change_number;
  lab.session.push(parse_command(R"({"do": "step", "steps": 100000})"));
  lab.session.push(parse_command(R"({"do": "reset"})"));
  REQUIRE(comes_true([&] { return lab.session.shown().now().change_number > before; }));
  CHECK(lab.session.shown().now().frame);
  CHECK(comes_true([&] { return lab.session.shown().now().status->time > 0.1; }));
  REQUIRE_FALSE(lab.session.timeline().frames(0).empty());
  CHECK(lab.session.timeline().frames(0).front()->recorded.t == 0);
}

TEST_CASE("lab session: every request to open a file is answered, also concurrent ones") {
  std::atomic<int> answered = 0;
  {
    TestSession lab;
    for (int n = 0; n < 20; ++n) {
      BuildRequest request;
      request.file =
          std::filesystem::path(TWINARM_SOURCE_DIR) / "assets/scenes/hand_and_obstacles.toml";
      request.name = "hand_and_obstacles";
      request.done = [&](const std::string&) { ++answered; };
      lab.session.open(std::move(request));
    }
    CHECK(comes_true([&] { return answered == 20; }));
  }
  CHECK(answered == 20);
}

TEST_CASE("lab command: all fields are read") {
  const LabCommand pull = parse_command(
      R"({"do": "drag_body", "body": 3, "point": [0.5, -1, 2], "goal": [1, 2, 3.25], "stamp": 12.5})");
  CHECK(pull.what == "drag_body");
  CHECK(pull.count == 3);
  CHECK(pull.point == Vector3(0.5, -1, 2));
  CHECK(pull.goal == Vector3(1, 2, 3.25));
  CHECK(pull.stamp == 12.5);
  const LabCommand set = parse_command(R"({"do": "set", "changes": ["step=0.0005", "a=b"]})");
  CHECK(set.names == std::vector<std::string>{"step=0.0005", "a=b"});
  CHECK(parse_command(R"({"do": "seek", "at": 1.5})").at == 1.5);
  CHECK_FALSE(parse_command(R"({"do": "seek", "at": null})").at.has_value());
  CHECK(parse_command(R"({"do": "axes", "rates": [2, -7, 0.5, 0, 0, 0]})").rates[0] == 1.0);
}

TEST_CASE("lab command: an invalid command is refused with all its faults") {
  CHECK(faults_in("") == 1);
  CHECK(faults_in("[]") == 1);
  CHECK(faults_in(R"({"do": "dance"})") == 1);
  CHECK(faults_in(R"({"do": "drag_body", "body": -1, "point": [1, 2]})") == 3);
  CHECK(faults_in(R"({"do": "speed", "factor": 1e9})") == 1);
  CHECK(faults_in(R"({"do": "drag_stylus", "goal": [1, 2, NaN]})") == 1);
  CHECK(faults_in(R"({"do": "drag_stylus", "goal": [1, 2, 1e999]})") >= 1);
  CHECK(faults_in(R"({"do": "joint", "index": 1.5, "value": 0})") == 1);
  CHECK(faults_in(R"({"do": "step", "steps": true})") == 1);
  CHECK(faults_in(std::string(100'000, '[')) >= 1);
}

TEST_CASE("lab command: inspecting requires no control, seeking and moving the robot do") {
  CHECK_FALSE(needs_control("layers"));
  CHECK_FALSE(needs_control("request_control"));
  CHECK(needs_control("seek"));  // it pauses the run, for everybody
  CHECK(needs_control("drag_stylus"));
  CHECK(needs_control("set"));
}

TEST_CASE("uploads: files are opened or stored by type, or refused with a reason") {
  const std::string robot =
      "\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- <sdf> -->\n<robot name=\"a\"/>";
  for (const char* name : {"arm.urdf", "arm.xml", "arm.xacro", "arm.URDF"}) {
    INFO(std::string(name));
    const UploadedFile file = classify_upload(name, robot);
    CHECK(file.fault.empty());
    CHECK(file.opens);
    CHECK(file.path == "arm.urdf");
  }
  CHECK(classify_upload("s.toml", "").opens);
  CHECK(classify_upload("r.twinrec", "").opens);
  for (const char* name : {"a.stl", "a.OBJ", "meshes/a.dae", "wood.png"}) {
    const UploadedFile file = classify_upload(name, "");
    CHECK(file.fault.empty());
    CHECK_FALSE(file.opens);
    CHECK(file.path == name);
  }
  const auto refused = [](const char* name, const char* bytes, const char* why) {
    return classify_upload(name, bytes).fault.find(why) != std::string::npos;
  };
  CHECK(refused("a.xml", "<mujoco model=\"a\">", "MJCF"));
  CHECK(refused("a.xml", "<sdf version=\"1.7\">", "SDFormat"));
  CHECK(refused("a.xml", "<html>", "<html>"));
  CHECK(refused("a.xml", "<!-- never ended <robot>", "not an XML"));
  CHECK(refused("a.xacro", "", "not an XML"));
  for (const char* name : {"junk.bin2", "photo", "a.exe", "notes.txt"})
    CHECK(refused(name, "<robot>", ".urdf"));
}

TEST_CASE("clients: the first one gets control, others in order of their requests") {
  Clients clients;
  for (const ClientId client : {11u, 12u, 13u}) clients.opened(client);
  CHECK(clients.has_control(11));
  clients.take(13);
  clients.take(12);
  clients.take(13);
  clients.opened(14);
  clients.take(14);
  clients.closed(14);  // withdraws its request
  CHECK(clients.view().waiting == std::vector<ClientId>{13, 12});
  CHECK_FALSE(clients.give(12, 12));
  CHECK_FALSE(clients.give(11, 99));
  CHECK(clients.give(11, 12));
  CHECK(clients.has_control(12));
  clients.closed(12);  // the next in order
  CHECK(clients.has_control(13));
  clients.closed(13);
  CHECK(clients.has_control(11));  // the only one left
  clients.closed(11);
  CHECK(clients.view().controller == 0);
}

TEST_CASE("clients: only the secret of the client in control is one of control") {
  Clients clients;
  clients.opened(1, "192.168.1.7");
  clients.opened(2, "::1");
  CHECK(clients.name(1) == "client 1 at 192.168.1.7");
  const std::string second = clients.view().clients.at(2).secret;
  CHECK(clients.controller(clients.view().clients.at(1).secret) == 1);
  CHECK(clients.controller(second) == 0);
  CHECK(clients.controller("") == 0);
  clients.closed(1);
  CHECK(clients.controller("") == 0);
  CHECK(clients.controller(second) == 2);
}

TEST_CASE("clients: layers of all clients are drawn, each once") {
  Clients clients;
  clients.opened(1);
  clients.opened(2);
  clients.want_layers(1, {"bodies", "frames"});
  clients.want_layers(2, {"trails", "bodies"});
  CHECK(clients.view().layers() == std::vector<std::string>{"bodies", "frames", "trails"});
  clients.want_inspection(2, 4);
  CHECK(clients.view().clients.at(2).inspected == 4);
  clients.want_inspection(2, std::nullopt);
  CHECK_FALSE(clients.view().clients.at(2).inspected);
}

TEST_CASE("pacer: run time follows wall time, and a backlog is not made up for") {
  using std::chrono::milliseconds;
  const RealTimePacer::Time start{};
  RealTimePacer pace;
  pace.begin(start, 5.0, 0.5);
  CHECK(pace.due(start + milliseconds(1000)) == doctest::Approx(5.5));
  pace.limit_backlog(start + milliseconds(1000), 5.49, 0.05);  // within the limit
  CHECK(pace.due(start + milliseconds(1000)) == doctest::Approx(5.5));
  pace.limit_backlog(start + milliseconds(1000), 5.2, 0.05);  // 0.6 s of wall time behind
  CHECK(pace.due(start + milliseconds(1000)) == doctest::Approx(5.225));
  CHECK(pace.factor(start + milliseconds(2000), 5.5) == doctest::Approx(0.5));
}

}  // namespace
}  // namespace twinarm
