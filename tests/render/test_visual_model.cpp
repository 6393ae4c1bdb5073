// Meshes as they are drawn: windings mended, textures the right way up, broken pictures told.
#include "app/render/visual_model.h"

#include <doctest/doctest.h>
#include <turbojpeg.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
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

namespace {

// Of any two numbers some stand side by side: far apart in size, equal, or hardly different.
TriangleMesh senseless_mesh(std::mt19937& random) {
  static constexpr double kNumbers[] = {0,     1,    -1,  1e-38, 1e-45, 1e38,
                                        -3e38, 1e-7, 0.5, 1e19,  2,     1 + 1e-7};
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  TriangleMesh mesh;
  const unsigned vertices = 3 + random() % 12;
  for (unsigned v = 0; v < vertices; ++v) {
    Vector3 p;
    for (double& x : p) x = kNumbers[below(12)];
    mesh.vertices.push_back(p);
  }
  for (unsigned t = 1 + random() % 30; t > 0; --t) {
    const std::array<int, 3> corners{below(vertices), below(vertices), below(vertices)};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      mesh.triangles.push_back(corners);
  }
  return mesh;
}

double length_of(const std::array<float, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

}  // namespace

TEST_CASE("what a senseless mesh becomes can be drawn: corners that exist, normals of length 1") {
  std::mt19937 random(5);
  std::size_t drawn = 0;
  for (int i = 0; i < 1000; ++i) {
    TriangleMesh mesh = senseless_mesh(random);
    mend_winding(mesh);
    const DrawMesh draw = make_draw_mesh(mesh);
    drawn += draw.triangles.size();
    REQUIRE(draw.normals.size() == draw.positions.size());
    for (const auto& triangle : draw.triangles)
      for (const std::uint32_t corner : triangle) REQUIRE(corner < draw.positions.size());
    for (const auto& normal : draw.normals)
      REQUIRE(length_of(normal) == doctest::Approx(1).epsilon(1e-5));
  }
  CHECK(drawn > 1000);
}

TEST_CASE("a corner of a hundred thousand facets takes no time to speak of, and looks as a cone") {
  TriangleMesh cone{{{0, 0, 1}}, {}};
  const int n = 100000;
  const auto turn = [](double k) { return 2 * 3.14159265358979 * k / n; };
  for (int k = 0; k < n; ++k) {
    cone.vertices.emplace_back(std::cos(turn(k)), std::sin(turn(k)), 0);
    cone.triangles.push_back({0, 1 + k, 1 + (k + 1) % n});
  }
  const std::clock_t begin = std::clock();
  mend_winding(cone);
  const DrawMesh draw = make_draw_mesh(cone);
  CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 20);  // squared: minutes
  REQUIRE(draw.triangles.size() == static_cast<std::size_t>(n));
  const double half = std::sqrt(0.5);
  for (int k = 0; k < n; k += 999)
    for (const std::uint32_t corner : draw.triangles[static_cast<std::size_t>(k)]) {
      const auto& normal = draw.normals[corner];
      CHECK(std::abs(normal[0] - half * std::cos(turn(k + 0.5))) < 1e-3);
      CHECK(std::abs(normal[1] - half * std::sin(turn(k + 0.5))) < 1e-3);
      CHECK(std::abs(normal[2] - half) < 1e-3);
    }
}
