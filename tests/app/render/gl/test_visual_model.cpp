// Mesh files as drawn: orientation of textures, broken textures.
#include "app/render/list/visual_model.h"

#include <doctest/doctest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include "app/render/gl/painter.h"
#include "solver/support/diagnostics.h"
#include "tests/app/render/list/quarters.h"
#include "tests/support/temporary_folder.h"

using namespace twinarm;

namespace {

// A unit square in the plane z = 0 with the texture upright from above: u along x, v along -y.
const std::string kSquare = test_data("app/render/gl/square.obj");

VisualModel painted_square(const TemporaryFolder& folder, const std::string& picture) {
  folder.write("square.mtl", "newmtl painted\nKd 1 1 1\nmap_Kd picture.png\n");
  folder.write("picture.png", picture);
  return load_visual(folder.write("square.obj", kSquare));
}

// From above the centre of the square, y up in the picture.
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

TEST_CASE("a texture has the orientation of the file, on both sides of a square") {
  const TemporaryFolder folder;
  const std::string picture = encode_png(quarters(64));
  const VisualModel model = painted_square(folder, picture);
  REQUIRE(model.parts.size() == 1);
  CHECK(model.parts[0].mesh.two_sided);
  CHECK(quarters_of(picture_of(model, 3)) == "rgbw");
  CHECK(quarters_of(picture_of(model, -3)) == "grwb");  // mirrored from below
}

namespace {

// Within the last triangle of the file, away from its mirror line.
std::string upper_half_of(const Image& image) {
  return {color_at(image, 5, -25), color_at(image, -25, -5), color_at(image, -25, 5)};
}

}  // namespace

TEST_CASE("a texture keeps its place when triangles are flipped or the mesh is mirrored") {
  const TemporaryFolder folder;
  const std::string picture = encode_png(quarters(64));
  std::string one_turned = kSquare;
  one_turned.replace(one_turned.find("f 1/1 3/3 4/4"), 13, "f 4/4 3/3 1/1");
  painted_square(folder, picture);  // writes the files for the square below
  const fs::path file = folder.write("turned.obj", one_turned);
  const VisualModel mended = load_visual(file);
  CHECK(any_note(mended, "1 triangles faced inwards"));
  CHECK(quarters_of(picture_of(mended, 3)) == "rgbw");
  CHECK(upper_half_of(picture_of(mended, 3)) == "grb");
  for (const fs::path& square : {file, folder.write("square.obj", kSquare)}) {
    VisualModel mirrored = load_visual(square, Vector3(-1, 1, 1));
    REQUIRE(mirrored.parts.size() == 1);
    DrawMesh& mesh = mirrored.parts[0].mesh;
    for (auto& p : mesh.positions) p[0] += 1;  // into the view
    mesh.bound_center.x() += 1;
    const Image image = picture_of(mirrored, 3);
    CHECK(quarters_of(image) == "grwb");
    CHECK(color_at(image, -5, -25) == 'g');
    CHECK(color_at(image, 25, 5) == 'b');
  }
}

TEST_CASE("a mesh mirrored by its scale has outward triangles, without a note") {
  const TemporaryFolder folder;
  const fs::path file = folder.write(
      "t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  for (const Vector3& scale : {Vector3(1, 1, 1), Vector3(-1, 2, 3), Vector3(1, 1, -0.1)}) {
    const VisualModel model = load_visual(file, scale);
    CHECK(model.notes.empty());
    const DrawMesh& mesh = model.parts.at(0).mesh;
    const Vector3 middle = 0.25 * scale;  // of the tetrahedron, which is convex
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const auto &p = mesh.positions[v], &n = mesh.normals[v];
      CHECK((Vector3(p[0], p[1], p[2]) - middle).dot(Vector3(n[0], n[1], n[2])) > 0);
    }
  }
}

TEST_CASE("a broken texture is reported and the mesh drawn without it") {
  const TemporaryFolder folder;
  const std::string good = encode_png(quarters(64));
  for (const std::string& bad : {good.substr(0, good.size() / 2), std::string("text"),
                                 std::string("\xff\xd8 no jpeg"), std::string()}) {
    const VisualModel model = painted_square(folder, bad);
    CHECK(any_note(model, "picture.png"));
    REQUIRE(model.parts.size() == 1);
    CHECK(!model.parts[0].texture);
  }
}

TEST_CASE("JPEG quarters are decoded within the compression error") {
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

TEST_CASE("PNG: decoding returns the encoded image") {
  Image image = quarters(6);
  image.rgba[3] = 77;  // with an alpha
  CHECK(decode_image("x", encode_png(image)).rgba == image.rgba);
}

TEST_CASE("triangles that face inwards are flipped, with a note") {
  const TemporaryFolder folder;
  const VisualModel model = load_visual(folder.write(
      "t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 2\nf 1 4 3\nf 2 3 4\n"));
  CHECK(any_note(model, "1 triangles faced inwards"));
  CHECK(!model.parts.at(0).mesh.two_sided);
}

TEST_CASE("each part has the texture of its material") {
  const TemporaryFolder folder;
  Image picture = quarters(8);
  for (const auto& [name, channel] :
       {std::pair<const char*, std::size_t>("red.png", 0), {"blue.png", 2}}) {
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
      picture.rgba[i] = i % 4 == channel || i % 4 == 3 ? 255 : 0;
    folder.write(name, encode_png(picture));
  }
  folder.write("two.mtl", "newmtl a\nmap_Kd red.png\nnewmtl b\nmap_Kd blue.png\n");
  const VisualModel model = load_visual(folder.write(
      "two.obj",
      "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nvt 0 0\nvt 1 0\n"
      "vt 0 1\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 4/1 5/2 6/3\n"));
  REQUIRE(model.parts.size() == 2);
  for (const VisualMesh& part : model.parts) {
    REQUIRE(part.texture);
    const std::uint8_t* const pixel = part.texture->rgba.data();
    const bool is_first = part.mesh.bound_center.x() < 3;
    CHECK(pixel[0] == (is_first ? 255 : 0));
    CHECK(pixel[2] == (is_first ? 0 : 255));
  }
}
