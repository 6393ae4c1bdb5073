// Meshes as they are drawn: windings mended, textures the right way up, broken pictures told.
#include "app/render/visual_model.h"

#include <doctest/doctest.h>
#include <turbojpeg.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "app/render/mend_winding.h"
#include "app/render/painter.h"
#include "solver/fault.h"
#include "tests/render/quarters.h"

using namespace twinarm;
namespace fs = std::filesystem;

namespace {

class VisualFolder {
 public:
  VisualFolder()
      : path_(fs::temp_directory_path() / ("twinarm_visual_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~VisualFolder() { fs::remove_all(path_); }
  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  fs::path path_;
};

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// A unit square in the plane z = 0, seen from above, with the picture upright: u along x, v down y.
const char* const kSquare = R"(mtllib square.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl painted
f 1/1 2/2 3/3
f 1/1 3/3 4/4
)";

VisualModel painted_square(const VisualFolder& folder, const std::string& picture) {
  folder.write("square.mtl", "newmtl painted\nKd 1 1 1\nmap_Kd picture.png\n");
  folder.write("picture.png", picture);
  return load_visual(folder.write("square.obj", kSquare));
}

// From above the square's middle, y up in the picture.
Image picture_of(const VisualModel& model, double from_z) {
  DrawList list;
  list.ground.visible = false;
  list.camera.eye = Vector3(0.5, 0.5, from_z);
  list.camera.target = Vector3(0.5, 0.5, 0);
  list.camera.up = Vector3::UnitY();
  for (const VisualMesh& part : model.parts) {
    add_mesh_instance(list, list.register_mesh(part.mesh), {}, Color{1, 1, 1, 1});
    if (part.texture) list.instances.back().texture = list.register_texture(part.texture);
  }
  return Painter(Backend::osmesa, 120, 120).paint(list);
}

bool any_note(const VisualModel& model, const std::string& words) {
  return std::any_of(model.notes.begin(), model.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("a closed surface gets its outside outside, whichever of its triangles look inwards") {
  for (unsigned turned = 0; turned < 16; ++turned) {
    TriangleMesh mesh = tetrahedron();
    for (std::size_t i = 0; i < 4; ++i)
      if (turned >> i & 1) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    const MendedWinding mended = mend_winding(mesh);
    CHECK(mended.is_closed);
    CHECK(mesh.triangles == tetrahedron().triangles);
    for (std::size_t i = 0; i < 4; ++i) CHECK(mended.turned[i] == ((turned >> i & 1) != 0));
  }
}

TEST_CASE("an open surface keeps the side that most of its area has") {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.pop_back();  // the slanted one
  const auto good = mesh.triangles;
  std::swap(mesh.triangles[1][1], mesh.triangles[1][2]);
  const MendedWinding mended = mend_winding(mesh);
  CHECK(!mended.is_closed);
  CHECK(mesh.triangles == good);
}

TEST_CASE("a strip with a half turn has no outside: it is said to be open") {
  TriangleMesh strip{{}, {}};
  const int n = 12;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * 3.14159265358979 * i / n;
    const Vector3 out(std::cos(a), std::sin(a), 0);
    const Vector3 half = 0.2 * (std::cos(a / 2) * out + std::sin(a / 2) * Vector3::UnitZ());
    strip.vertices.push_back(out + half);
    strip.vertices.push_back(out - half);
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * i + 1;
    const int c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({c, b, d});
  }
  CHECK(!mend_winding(strip).is_closed);
}

TEST_CASE("a texture lies on the square as the file says, upright, from both sides") {
  const VisualFolder folder;
  const std::string picture = encode_png(quarters(64));
  const VisualModel model = painted_square(folder, picture);
  REQUIRE(model.parts.size() == 1);
  CHECK(model.parts[0].mesh.two_sided);
  CHECK(quarters_of(picture_of(model, 3)) == "rgbw");
  CHECK(quarters_of(picture_of(model, -3)) == "grwb");  // from below, left is right
}

TEST_CASE("a picture that is broken is told, and the mesh drawn without it") {
  const VisualFolder folder;
  const std::string good = encode_png(quarters(64));
  for (const std::string& bad : {good.substr(0, good.size() / 2), std::string("text"),
                                 std::string("\xff\xd8 no jpeg"), std::string()}) {
    const VisualModel model = painted_square(folder, bad);
    CHECK(any_note(model, "picture.png"));
    REQUIRE(model.parts.size() == 1);
    CHECK(!model.parts[0].texture);
  }
}

TEST_CASE("a JPEG's quarters come back as they were, but for what its compression loses") {
  Image image = quarters(64);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const tjhandle encoder = tjInitCompress();
  tjCompress2(encoder, image.rgba.data(), 64, 0, 64, TJPF_RGBA, &bytes, &size, TJSAMP_444, 95, 0);
  const std::string jpeg(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  tjDestroy(encoder);
  Image again = decode_image("x", jpeg);
  REQUIRE(again.rgba.size() == image.rgba.size());
  for (const auto& [x, y] : {std::pair(16, 16), {48, 16}, {16, 48}, {48, 48}})
    for (int c = 0; c < 4; ++c) CHECK(std::abs(again.pixel(x, y)[c] - image.pixel(x, y)[c]) < 8);
  for (std::size_t cut = 0; cut < size; cut += 40)
    CHECK_THROWS_AS(decode_image("x", jpeg.substr(0, cut)), InputError);
}

TEST_CASE("what PNG encodes, decoding gives back") {
  Image image = quarters(6);
  image.rgba[3] = 77;  // with an alpha
  CHECK(decode_image("x", encode_png(image)).rgba == image.rgba);
}

TEST_CASE("triangles that look inwards are turned about, and that is said") {
  const VisualFolder folder;
  const VisualModel model = load_visual(folder.write(
      "t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 2\nf 1 4 3\nf 2 3 4\n"));
  CHECK(any_note(model, "1 triangles looked inwards"));
  CHECK(!model.parts.at(0).mesh.two_sided);
}
