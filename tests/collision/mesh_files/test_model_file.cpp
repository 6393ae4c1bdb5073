// Models with colours and textures in every format.
#include "collision/mesh_files/model_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "collision/mesh_files/mesh_file.h"
#include "collision/shapes/shape.h"
#include "solver/support/diagnostics.h"
#include "tests/support/temporary_folder.h"

using namespace twinarm;

namespace {

// models/: a tetrahedron of volume 1/6 in PLY, one of 1/3 in Collada, an OBJ with a texture.
std::string sample(const std::string& file) {
  return test_data("collision/mesh_files/models/" + file);
}
// Lengths in `unit` of a metre.
std::string collada(const std::string& unit, const std::string& up) {
  return replaced(replaced(sample("red.dae"), "UNIT", unit), "UP", up);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a tetrahedron in PLY has the right volume") {
  const TemporaryFolder folder;
  const TriangleMesh mesh = load_mesh(folder.write("t.ply", sample("tetrahedron.ply")), 1);
  REQUIRE(is_closed(mesh));
  CHECK(mass_properties(mesh, 1).mass == doctest::Approx(1.0 / 6));
}

TEST_CASE("Collada is converted to metres by its unit, with the axes of the file") {
  const TemporaryFolder folder;
  for (const char* up : {"Z_UP", "Y_UP"}) {
    const TriangleMesh mesh = load_mesh(folder.write("t.dae", collada("0.001", up)), 1);
    REQUIRE(is_closed(mesh));
    CHECK(mass_properties(mesh, 1).mass == doctest::Approx(2.0 / 6 * 1e-9));
    double highest = 0;
    for (const Vector3& p : mesh.vertices) highest = std::max(highest, p.z());
    CHECK(highest == doctest::Approx(0.002));
  }
  const ModelFile model = read_model(folder.write("t.dae", collada("1", "Z_UP")));
  REQUIRE(model.parts.size() == 1);
  CHECK(model.parts[0].has_color == 1);
  CHECK(model.parts[0].color == std::array<float, 4>{0.5f, 0.25f, 0, 1});
}

TEST_CASE("each part of an OBJ has its colour or texture; (0, 0) is the image's top left") {
  const TemporaryFolder folder;
  folder.write("looks.mtl", sample("looks.mtl"));
  folder.write("inner/wood.png", "bytes of a picture");
  const ModelFile model = read_model(folder.write("two.obj", sample("two.obj")));
  REQUIRE(model.parts.size() == 2);
  REQUIRE(model.textures.size() == 1);
  CHECK(model.notes.empty());
  CHECK(model.textures[0].name == "inner/wood.png");
  CHECK(model.textures[0].bytes == "bytes of a picture");
  const bool first = model.parts[0].texture == 0;
  const ModelPart &painted = model.parts[first ? 0 : 1], &plain = model.parts[first ? 1 : 0];
  CHECK(painted.texture == 0);
  CHECK(plain.texture == -1);
  CHECK(plain.uv.empty());
  CHECK(plain.color == std::array<float, 4>{0.5f, 0.25f, 0, 0.5f});
  REQUIRE(painted.uv.size() == painted.positions.size());
  for (std::size_t i = 0; i < painted.uv.size(); ++i) {
    const auto& p = painted.positions[i];
    const float v = 1 - (p[1] > 0 ? 1.0f : 0.0f);  // vt of the third vertex is (0.25, 1)
    CHECK(painted.uv[i] == std::array<float, 2>{p[0] > 0 ? 1.0f : p[1] > 0 ? 0.25f : 0.0f, v});
  }
}

TEST_CASE("a texture that is missing or outside the model's folder is reported and left out") {
  const TemporaryFolder folder;
  folder.write("secret.png", "outside");
  for (const char* name : {"none.png", "../secret.png", "/etc/passwd"}) {
    folder.write("inner/looks.mtl", std::string("newmtl painted\nmap_Kd ") + name + "\n");
    const ModelFile model = read_model(folder.write("inner/two.obj", sample("two.obj")));
    CHECK(model.textures.empty());
    REQUIRE(model.notes.size() == 1);
    CHECK(contains(model.notes[0], name));
  }
}

TEST_CASE("an STL has no colour") {
  const TemporaryFolder folder;
  const ModelFile model = read_model(folder.write(
      "t.stl",
      "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid t\n"));
  REQUIRE(model.parts.size() == 1);
  CHECK(model.parts[0].has_color == 0);
}

TEST_CASE("a packed model is unpacked completely; a truncated one is rejected") {
  ModelFile model;
  model.parts.resize(2);
  model.parts[0].positions = {{1, 2, 3}, {4, 5, 6}};
  model.parts[0].uv = {{0.5f, 1}, {0, 0.25f}};
  model.parts[0].triangles = {{0, 1, 0}};
  model.parts[1].has_color = 1;
  model.parts[1].color = {0.1f, 0.2f, 0.3f, 0.4f};
  model.parts[1].texture = 0;
  model.textures = {{"name", "bytes"}};
  model.notes = {"a", "b"};
  const std::string bytes = packed(model);
  const auto again = unpacked<ModelFile>(bytes);
  REQUIRE(again);
  CHECK(packed(*again) == bytes);
  CHECK(again->parts[0].uv == model.parts[0].uv);
  CHECK(again->parts[1].color == model.parts[1].color);
  CHECK(again->textures[0].bytes == "bytes");
  CHECK(again->notes == model.notes);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK(!unpacked<ModelFile>(bytes.substr(0, size)));
  CHECK(!unpacked<ModelFile>(bytes + "x"));
}
