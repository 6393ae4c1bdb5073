// Models with colours and textures, in every format; and readers that crash or never end.
#include "collision/mesh_files/model_file.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "collision/mesh_files/mesh_file.h"
#include "collision/mesh_files/model_serialization.h"
#include "collision/mesh_files/sandboxed_process.h"
#include "collision/shapes/shape.h"
#include "solver/support/diagnostics.h"

using namespace twinarm;
namespace fs = std::filesystem;

namespace {

class ModelFolder {
 public:
  ModelFolder() : path_(fs::temp_directory_path() / ("twinarm_model_" + std::to_string(getpid()))) {
    fs::create_directories(path_ / "inner");
  }
  ~ModelFolder() { fs::remove_all(path_); }
  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  fs::path path_;
};

// A tetrahedron of volume 1/6, in the syntax of each format; lengths in `unit` of a metre.
const char* const kPly = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

std::string collada(const std::string& unit, const std::string& up) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter=")" +
         unit + R"("/><up_axis>)" + up + R"(</up_axis></asset>
<library_effects><effect id="red-fx"><profile_COMMON><technique sid="c"><phong>
<diffuse><color>0.5 0.25 0 1</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="red"><instance_effect url="#red-fx"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 0 0 0 2</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="m" target="#red"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

const char* const kObj = R"(mtllib looks.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vt 1 0
vt 0.25 1
usemtl painted
f 1/1 2/2 3/3
usemtl plain
f 1 2 4
)";
const char* const kLooks = R"(newmtl painted
Kd 1 1 1
map_Kd inner/wood.png
newmtl plain
Kd 0.5 0.25 0
d 0.5
)";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a tetrahedron in PLY has the volume of one") {
  const ModelFolder folder;
  const TriangleMesh mesh = load_mesh(folder.write("t.ply", kPly), 1);
  REQUIRE(is_closed(mesh));
  CHECK(mass_properties(mesh, 1).mass == doctest::Approx(1.0 / 6));
}

TEST_CASE("Collada comes in metres by its own unit, with its axes as they stand in the file") {
  const ModelFolder folder;
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

TEST_CASE("each part of an OBJ has its colour or texture; the picture's top left is (0, 0)") {
  const ModelFolder folder;
  folder.write("looks.mtl", kLooks);
  folder.write("inner/wood.png", "bytes of a picture");
  const ModelFile model = read_model(folder.write("two.obj", kObj));
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
    const float v = 1 - (p[1] > 0 ? 1.0f : 0.0f);  // vt of the third corner is (0.25, 1)
    CHECK(painted.uv[i] == std::array<float, 2>{p[0] > 0 ? 1.0f : p[1] > 0 ? 0.25f : 0.0f, v});
  }
}

TEST_CASE("a texture that is missing, or lies outside the model's folder, is told and left out") {
  const ModelFolder folder;
  folder.write("secret.png", "outside");
  for (const char* name : {"none.png", "../secret.png", "/etc/passwd"}) {
    folder.write("inner/looks.mtl", std::string("newmtl painted\nmap_Kd ") + name + "\n");
    const ModelFile model = read_model(folder.write("inner/two.obj", kObj));
    CHECK(model.textures.empty());
    REQUIRE(model.notes.size() == 1);
    CHECK(contains(model.notes[0], name));
  }
}

TEST_CASE("an STL states no colour") {
  const ModelFolder folder;
  const ModelFile model = read_model(folder.write(
      "t.stl",
      "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid t\n"));
  REQUIRE(model.parts.size() == 1);
  CHECK(model.parts[0].has_color == 0);
}

TEST_CASE("work in a child returns its bytes, many or none") {
  CHECK(run_limited([] { return std::string(); }).bytes.empty());
  std::string many;
  for (int i = 0; i < 1000000; ++i) many += std::to_string(i);
  const ChildResult result = run_limited([&] { return many; });
  CHECK(result.fault.empty());
  CHECK(result.bytes == many);
}

TEST_CASE("a child that crashes, throws or never ends leaves a sentence") {
  CHECK(run_limited([]() -> std::string { std::abort(); }).fault == "crashes");
  CHECK(run_limited([]() -> std::string { throw 7; }).fault == "fails");
  const ChildResult slow = run_limited(
      []() -> std::string {
        for (std::atomic<int> i = 0;;) ++i;
      },
      {.cpu_seconds = 1});
  CHECK(contains(slow.fault, "more than 1 s"));
  CHECK(slow.bytes.empty());
}

TEST_CASE("a child that waits for ever is ended, and leaves a sentence") {
  const ChildResult waits = run_limited(
      []() -> std::string {
        while (true) pause();
      },
      {.wall_seconds = 1});
  CHECK(waits.fault == "does not end within 1 s");
  CHECK(waits.bytes.empty());
}

TEST_CASE("a packed model comes back whole; one that is cut anywhere does not") {
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
  const std::string bytes = pack(model);
  const std::optional<ModelFile> again = unpack_model(bytes);
  REQUIRE(again);
  CHECK(pack(*again) == bytes);
  CHECK(again->parts[0].uv == model.parts[0].uv);
  CHECK(again->parts[1].color == model.parts[1].color);
  CHECK(again->textures[0].bytes == "bytes");
  CHECK(again->notes == model.notes);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK(!unpack_model(bytes.substr(0, size)));
  CHECK(!unpack_model(bytes + "x"));
}
