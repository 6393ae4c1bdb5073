// Meshes, new names, scales of arrows, history.
#include <cmath>

#include "app/lab/stream/lab_view.h"
#include "tests/app/lab/stream/watched.h"

namespace twinarm {
namespace {

TEST_CASE("lab view: an empty scene gives frames") {
  const TemporaryFolder folder;
  Watched watched(folder.write("empty.toml", R"(
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
)"));
  const LabFrame frame = watched.after(2);
  const ReadFrame read(watched.view->frame(frame, nullptr, all_layers(watched), {}));
  CHECK(read.first[1] == 0);
  CHECK(read.time == doctest::Approx(0.002));
}

TEST_CASE(
    "lab view: meshes of equal content have one name, others another; bytes as in the protocol") {
  DrawList list;
  const auto wedge = [](float height) {
    DrawMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, height}};
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
  };
  list.register_mesh(wedge(0.5f));
  list.register_mesh(wedge(0.25f));
  list.register_mesh(wedge(0.5f));
  MeshStore store;
  CHECK(store.take(list));
  CHECK_FALSE(store.take(list));
  REQUIRE(store.meshes().size() == 3);
  CHECK(store.meshes()[0] == store.meshes()[2]);
  CHECK(store.meshes()[0] != store.meshes()[1]);
  CHECK(store.meshes()[0].find_first_not_of("0123456789abcdef") == std::string::npos);
  const auto bytes = store.file(store.meshes()[0]);
  REQUIRE(bytes);
  REQUIRE(bytes->size() == 16 + 3 * 12 + 3 * 12 + 3 * 4);
  CHECK(value_at<std::uint32_t>(*bytes, 0) == 3);
  CHECK(value_at<std::uint32_t>(*bytes, 4) == 3);
  CHECK(value_at<std::uint32_t>(*bytes, 8) == 0);
  CHECK(value_at<float>(*bytes, 16 + 32) == 0.5f);  // z of the last
  CHECK(value_at<float>(*bytes, 16 + 36 + 8) == 1);
  CHECK(value_at<std::uint32_t>(*bytes, 16 + 72 + 8) == 2);
  CHECK_FALSE(store.file("no such"));
}

TEST_CASE(
    "lab view: many spheres have a sixth of the facets, and a hundred of their contacts channels") {
  const auto spheres = [](int count) {
    std::string scene =
        "[[body]]\nname = \"floor\"\nfixed = true\n"
        "shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }\n";
    for (int i = 0; i < count; ++i)
      scene += "[[body]]\nname = \"s" + std::to_string(i) +
               "\"\nmass = 1\nshape = { sphere = { radius = 0.05 } }\nposition = [" +
               std::to_string(0.2 * i) + ", 0, 0.0499]\n";
    return scene;
  };
  const TemporaryFolder folder;
  const auto corners = [](const LabView& view) {
    std::size_t most = 0;
    for (const std::string& hash : texts_in(view.scene_message(), "meshes", ""))
      most = std::max<std::size_t>(most, value_at<std::uint32_t>(*view.store().file(hash), 4));
    return most;
  };
  Watched few(folder.write("few.toml", spheres(5)));
  few.view->frame(few.after(1), nullptr, {}, {});
  CHECK(corners(*few.view) == 3 * 2 * 48 * 23);
  Watched many(folder.write("many.toml", spheres(120)));
  many.view->frame(many.after(1), nullptr, {}, {});
  const ReadFrame drawn(many.view->frame(many.after(2), nullptr, all_layers(many), {}));
  const auto meshes = texts_in(many.view->scene_message(), "meshes", "");
  for (std::size_t i = 0; i < 120; ++i)
    CHECK(value_at<std::uint32_t>(*many.view->store().file(meshes[drawn.mesh[i]]), 4) ==
          3 * 2 * 20 * 9);
  const auto channels = texts_in(many.view->scene_message(), "channels", "name");
  CHECK(std::ranges::count_if(channels, [](const std::string& name) {
          return name.starts_with("contact/floor-s");
        }) == 100);
}

TEST_CASE("lab view: new channels are appended, and renew the names") {
  const TemporaryFolder folder;
  Watched watched(folder.write("drop.toml", replaced(kBoxes, "[0.5, 0, 0.1]", "[0.5, 0, 0.102]")));
  const LabFrame first = watched.after(1);
  watched.view->frame(first, nullptr, {}, {});
  const auto before = texts_in(watched.view->scene_message(), "channels", "name");
  const std::uint64_t naming = watched.view->naming();
  watched.view->frame(first, nullptr, {}, {});
  CHECK(watched.view->naming() == naming);
  const LabFrame landed = watched.after(100);
  watched.view->frame(landed, nullptr, {"forces"}, {});
  CHECK(watched.view->naming() > naming);
  auto after = texts_in(watched.view->scene_message(), "channels", "name");
  REQUIRE(after.size() == before.size() + 1);
  CHECK(after.back() == "contact/floor-resting");
  after.pop_back();
  CHECK(after == before);
  for (const std::string& hash : texts_in(watched.view->scene_message(), "meshes", ""))
    CHECK(watched.view->store().file(hash));
}

TEST_CASE("lab view: scales of arrows grow by one round step a frame, and never shrink") {
  Watched watched = watched_boxes();
  LabFrame frame = watched.after(20);
  const std::size_t forces = watched.layer("forces");
  const auto length = [&] {  // of the arrow for the resting box
    const ReadFrame read(watched.view->frame(frame, nullptr, {"forces"}, {}));
    const auto [first, last] = read.layer(forces);
    return last > first ? read.scale[3 * first + 2] + read.scale[3 * first + 5] : 0.0f;
  };
  const float at_rest = length();
  CHECK(at_rest > 0);
  const auto contacts = frame.recorded.contacts;
  for (RecordedContact& c : frame.recorded.contacts) c.force *= 1000;
  const float loaded = length();
  CHECK(loaded < 1000 * at_rest);
  CHECK(loaded > 150 * at_rest);  // one round step
  float last = loaded;
  for (int i = 0; i < 12; ++i) {
    const float now = length();
    CHECK(now <= last);
    last = now;
  }
  CHECK(last < 2 * at_rest);
  frame.recorded.contacts = contacts;
  CHECK(length() < 0.01f * at_rest);  // the scale is unchanged
}

TEST_CASE(
    "snapshot: couplings of which one also moves the gripper give one target robot and one "
    "device") {
  const Watched watched = watched_arm();
  const SimulateInput& input = watched.plan->prepared.input;
  const Snapshot moment = snapshot_of(*input.scene, *input.couplings, input.scene->start, {});
  CHECK(moment.targets.size() == 1);
  CHECK(moment.devices.size() == 1);
}

TEST_CASE("lab history: channels and works of the frames, frame by frame") {
  Watched watched = watched_boxes();
  std::vector<LabFrame> frames;
  for (int i = 0; i < 4; ++i) frames.push_back(watched.after(10));
  std::vector<const LabFrame*> pointers;
  for (const LabFrame& frame : frames) pointers.push_back(&frame);
  const std::string bytes = watched.view->history(pointers);
  CHECK(bytes.substr(0, 4) == "TWH1");
  CHECK(value_at<std::uint32_t>(bytes, 4) == 7);
  const std::size_t F = value_at<std::uint32_t>(bytes, 8), C = value_at<std::uint32_t>(bytes, 12),
                    R = value_at<std::uint32_t>(bytes, 16);
  REQUIRE(F == 4);
  REQUIRE(bytes.size() == 24 + 8 * (F + F * C + F * R));
  for (std::size_t f = 0; f < F; ++f) {
    const ReadFrame read(watched.view->frame(frames[f], nullptr, {}, {}));
    CHECK(value_at<double>(bytes, 24 + 8 * f) == frames[f].recorded.t);
    REQUIRE(read.channels.size() == C);
    REQUIRE(read.works.size() == R);
    for (std::size_t c = 0; c < C; ++c) {
      const auto value = value_at<double>(bytes, 24 + 8 * (F + f * C + c));
      CHECK((value == read.channels[c] || (std::isnan(value) && std::isnan(read.channels[c]))));
    }
    for (std::size_t r = 0; r < R; ++r)
      CHECK(value_at<double>(bytes, 24 + 8 * (F + F * C + f * R + r)) == read.works[r]);
  }
}

}  // namespace
}  // namespace twinarm
