// Reading meshes: valid ones are merged, invalid ones rejected with a reason.
#include "collision/mesh_files/mesh_file.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "collision/shapes/mesh_shape.h"
#include "collision/shapes/shape.h"
#include "solver/support/diagnostics.h"
#include "tests/collision/narrow_phase/oracle.h"
#include "tests/support/temporary_folder.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

std::string binary_stl(const TriangleMesh& mesh) {
  std::string text(80, ' ');
  const auto put = [&](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0f);
    for (int v : triangle) {
      for (int i = 0; i < 3; ++i) put(static_cast<float>(mesh.vertices[v][i]));
    }
    put(std::uint16_t{0});
  }
  return text;
}

std::string obj(const TriangleMesh& mesh, const std::string& head = "") {
  std::string text = head;
  for (const Vector3& v : mesh.vertices) {
    text += "v " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
            std::to_string(v.z()) + "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
            std::to_string(c + 1) + "\n";
  }
  return text;
}

// One triangle; its three vertices are in a separate file.
std::string gltf_of(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":4}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":")" +
         buffer + R"("}]})";
}

std::string refusal(const fs::path& file) {
  try {
    load_mesh(file, 1);
  } catch (const InputError& error) {
    CHECK(error.faults().at(0).file == file.string());
    CHECK(!error.faults().at(0).fix.empty());
    return error.faults().at(0).problem;
  }
  return "accepted";
}

bool mentions(const std::string& text, const char* word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

TEST_CASE("a box of 1 mm in metres is read with merged vertices from STL and OBJ") {
  const TemporaryFolder folder;
  const TriangleMesh box = box_mesh({0.001, 0.002, 0.0005});
  for (const fs::path& file :
       {folder.write("box.stl", binary_stl(box)), folder.write("box.STL", binary_stl(box)),
        folder.write("box.obj", obj(box, "mtllib ../secret.mtl\n"))}) {
    const TriangleMesh mesh = load_mesh(file, 2);
    CHECK(mesh.vertices.size() == 8);
    CHECK(mesh.triangles.size() == 12);
    REQUIRE(is_closed(mesh));
    CHECK(mass_properties(mesh, 1).mass / 8e-9 == doctest::Approx(1));
  }
}

TEST_CASE("an OBJ of two parts is one mesh") {
  const TemporaryFolder folder;
  std::string text = obj(box_mesh({1, 1, 1}), "o first\n");
  text += "o second\nv 5 5 5\nv 6 5 5\nv 5 6 5\nf 9 10 11\n";
  CHECK(load_mesh(folder.write("two.obj", text), 1).triangles.size() == 13);
}

TEST_CASE("a glTF buffer is read beside the model, and not from outside its folder") {
  const TemporaryFolder folder;
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  folder.write("model/inside.bin", bytes);
  folder.write("outside.bin", bytes);
  fs::create_symlink(folder.path() / "outside.bin", folder.path() / "model/link.bin");
  CHECK(load_mesh(folder.write("model/good.gltf", gltf_of("inside.bin")), 1).triangles.size() == 1);
  CHECK(refusal(folder.write("model/bad.gltf", gltf_of("../outside.bin"))) != "accepted");
  CHECK(refusal(folder.write("model/link.gltf", gltf_of("link.bin"))) != "accepted");
  CHECK(refusal(folder.write("model/root.gltf",
                             gltf_of((folder.path() / "outside.bin").string()))) != "accepted");
}

TEST_CASE("missing, foreign, malformed, empty and non-finite files are rejected with a reason") {
  const TemporaryFolder folder;
  const TriangleMesh box = box_mesh({1, 1, 1});
  TriangleMesh bad = box;
  bad.vertices[5].y() = std::nan("");
  CHECK(mentions(refusal(folder.path() / "none.stl"), "does not exist"));
  CHECK(mentions(refusal(folder.path()), "not a regular file"));
  CHECK(
      mentions(refusal(folder.write("cad.step", "ISO-10303-21;")), "not a supported mesh format"));
  CHECK(mentions(refusal(folder.write("mesh.off", "OFF\n")), "not a supported mesh format"));
  CHECK(
      mentions(refusal(folder.write("cut.stl", binary_stl(box).substr(0, 300))), "cannot be read"));
  CHECK(refusal(folder.write("words.stl", "this is no mesh")) != "accepted");
  CHECK(refusal(folder.write("words.obj", "this is no mesh")) != "accepted");
  CHECK(refusal(folder.write("words.gltf", "this is no mesh")) != "accepted");
  CHECK(refusal(folder.write("words.glb", "this is no mesh")) != "accepted");
  CHECK(refusal(folder.write("nothing.stl", "")) != "accepted");
  CHECK(refusal(folder.write("empty.stl", "solid nothing\nendsolid nothing\n")) != "accepted");
  CHECK(refusal(folder.write("index.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n")) != "accepted");
  CHECK(mentions(refusal(folder.write("nan.stl", binary_stl(bad))), "finite"));
  CHECK_THROWS_AS(load_mesh(folder.write("ok.stl", binary_stl(box)), -1), InputError);
}

TEST_CASE("a file above the size limit is rejected unread") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("huge.stl", "solid");
  fs::resize_file(file, (64u << 20) + 1);  // sparse
  CHECK(mentions(refusal(file), "64 MiB"));
}

TEST_CASE("random damage to a file is an error or a finite mesh, never a crash") {
  const TemporaryFolder folder;
  Random random(15);
  for (const std::string& good : {binary_stl(box_mesh({1, 2, 3})), obj(box_mesh({1, 2, 3}))}) {
    for (int k = 0; k < 150; ++k) {
      std::string text = good;
      for (int i = 0; i < 5; ++i) {
        const auto at =
            static_cast<std::size_t>(random.uniform(0, static_cast<double>(text.size())));
        text[at] = static_cast<char>(static_cast<unsigned char>(random.uniform(0, 255)));
      }
      if (k % 3 == 0) text.resize(text.size() / 2);
      const fs::path file = folder.write(good[0] == ' ' ? "x.stl" : "x.obj", text);
      try {
        for (const Vector3& v : load_mesh(file, 1).vertices) CHECK(v.allFinite());
      } catch (const InputError& error) {
        CHECK(!error.faults().empty());
      }
    }
  }
}

TEST_CASE("files whose surface does not bound a solid: each is read, and the errors are counted") {
  const TemporaryFolder folder;
  const TriangleMesh good = box_mesh({1, 2, 3});
  const auto fault_of = [&](const TriangleMesh& mesh) {
    return MeshShape{load_mesh(folder.write("surface.stl", binary_stl(mesh)), 1)}.fault();
  };
  CHECK(fault_of(good).empty());

  TriangleMesh open = good, flipped = good, one_turned = good, doubled = good, thin = good;
  open.triangles.pop_back();
  CHECK(mentions(fault_of(open), "3 edges belong to one triangle only"));
  for (auto& t : flipped.triangles) std::swap(t[0], t[1]);
  CHECK(mentions(fault_of(flipped), "inverted"));
  std::swap(one_turned.triangles[4][0], one_turned.triangles[4][1]);
  CHECK(mentions(fault_of(one_turned), "3 edges have triangles of opposite orientation"));
  doubled.triangles.push_back(doubled.triangles[0]);
  doubled.triangles.push_back({good.triangles[5][1], good.triangles[5][2], good.triangles[5][0]});
  CHECK(mentions(fault_of(doubled), "2 triangles are duplicates"));
  thin.vertices.push_back(0.5 * (good.vertices[0] + good.vertices[1]));
  thin.triangles.push_back({0, 1, 8});
  CHECK(mentions(fault_of(thin), "1 triangles have no area, the first is triangle 12"));
  // All of them at once.
  thin.triangles.pop_back();
  thin.triangles[0] = thin.triangles[1];
  thin.triangles.push_back({0, 1, 8});
  for (const char* part : {"no area", "duplicates", "not closed"})
    CHECK(mentions(fault_of(thin), part));
}

TEST_CASE(
    "triangles whose corners are the same vertex are left out, and a file of nothing else is "
    "empty") {
  const TemporaryFolder folder;
  const TriangleMesh good = box_mesh({1, 1, 1});
  TriangleMesh dotted = good, nothing = good;
  dotted.triangles.push_back({0, 0, 1});
  CHECK(load_mesh(folder.write("dotted.stl", binary_stl(dotted)), 1).triangles.size() == 12);
  for (auto& t : nothing.triangles) t = {t[0], t[0], t[1]};
  CHECK(mentions(refusal(folder.write("nothing.stl", binary_stl(nothing))), "no triangle"));
}
