// Files of meshes that are broken, by accident or on purpose: each is read or refused, in time, and
// nothing of the program breaks. TWINARM_MUTATIONS=500 tries more of them.
#include <doctest/doctest.h>

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "collision/mesh_files/model_file.h"
#include "collision/mesh_files/sandboxed_process.h"
#include "solver/support/diagnostics.h"
#include "tests/sanitized.h"

namespace twinarm {
namespace {

namespace fs = std::filesystem;

class HostileFolder {
 public:
  HostileFolder()
      : path_(fs::temp_directory_path() / ("twinarm_hostile_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~HostileFolder() { fs::remove_all(path_); }
  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  fs::path path_;
};

template <class T>
std::string bytes_of(const T& x) {
  return {reinterpret_cast<const char*>(&x), sizeof x};
}

// A tetrahedron, of which all the files are.
constexpr std::array<std::array<float, 3>, 4> kCorners{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<std::array<std::uint16_t, 3>, 4> kFaces{
    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

std::string text_stl() {
  std::string text = "solid t\n";
  for (const auto& face : kFaces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto v : face) {
      text += "vertex";
      for (const float x : kCorners[v]) text += " " + std::to_string(x);
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

std::string binary_stl(std::uint32_t count = 4) {
  std::string bytes(80, ' ');
  bytes += bytes_of(count);
  for (const auto& face : kFaces) {
    bytes += std::string(12, '\0');
    for (const auto v : face) bytes += bytes_of(kCorners[v]);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string ply(bool binary) {
  std::string text = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
                     " 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 4\n"
                     "property list uchar int vertex_indices\nend_header\n";
  if (!binary) return text + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  text += bytes_of(kCorners);
  for (const auto& face : kFaces) {
    text += '\3';
    for (const auto v : face) text += bytes_of(static_cast<std::int32_t>(v));
  }
  return text;
}

const char* const kPaintedObj =
    "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
    "usemtl a\nf 1/1/1 3/2/1 2/3/1\nf 1 2 4\nusemtl b\nf -4 -1 -2\nf 2 3 4\n";
const char* const kDae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="m" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_nodes><node id="n"><instance_geometry url="#g"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s"><node id="m"><instance_node url="#n"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

std::string gltf_json(const std::string& uri, const std::string& nodes) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.2,0.1,1]}}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",)"
         R"("min":[0,0,0],"max":[1,1,1]},{"bufferView":1,"componentType":5123,"count":12,)"
         R"("type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":48},)"
         R"({"buffer":0,"byteOffset":48,"byteLength":24}],"buffers":[{"byteLength":72)" +
         uri + "}]}";
}

std::string base64(const std::string& bytes) {
  static const char* const letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;  // of a multiple of three bytes
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned char>(bytes[i + k]); };
    const unsigned n = static_cast<unsigned>(at(0) << 16 | at(1) << 8 | at(2));
    for (int shift = 18; shift >= 0; shift -= 6) text += letters[n >> shift & 63];
  }
  return text;
}

const char* const kOneNode = R"([{"mesh":0}])";

std::string gltf(const std::string& nodes = kOneNode) {
  const std::string buffer = bytes_of(kCorners) + bytes_of(kFaces);
  return gltf_json(R"(,"uri":"data:application/octet-stream;base64,)" + base64(buffer) + '"',
                   nodes);
}

std::string glb() {
  std::string json = gltf_json("", kOneNode);
  while (json.size() % 4 != 0) json += ' ';
  const std::string buffer = bytes_of(kCorners) + bytes_of(kFaces);
  const auto chunk = [](const char* kind, const std::string& body) {
    return bytes_of(static_cast<std::uint32_t>(body.size())) + std::string(kind, 4) + body;
  };
  const std::string chunks = chunk("JSON", json) + chunk("BIN\0", buffer);
  return "glTF" + bytes_of(std::uint32_t{2}) +
         bytes_of(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

struct GoodFile {
  std::string name, bytes;
};

std::vector<GoodFile> good_files() {
  return {{"text.stl", text_stl()}, {"bytes.stl", binary_stl()},
          {"t.obj", kPaintedObj},   {"text.ply", ply(false)},
          {"bytes.ply", ply(true)}, {"t.dae", kDae},
          {"t.gltf", gltf()},       {"t.glb", glb()}};
}

// A second is a thousand times what these take.
constexpr ChildLimits kShort{.cpu_seconds = 1, .bytes = std::size_t{2} << 30};

enum class Outcome { read, refused };

// The file is read, and then it is in order; or it is refused with a rule and a remedy. Whatever
// else is thrown ends the test.
Outcome try_file(const fs::path& file) {
  try {
    const ModelFile model = read_model(file, kShort);
    REQUIRE(!model.parts.empty());
    for (const ModelPart& part : model.parts) {
      for (const auto& p : part.positions)
        for (const float x : p) REQUIRE(std::isfinite(x));
      for (const auto& t : part.triangles)
        for (const std::int32_t v : t)
          REQUIRE((v >= 0 && v < static_cast<std::int32_t>(part.positions.size())));
      REQUIRE((part.uv.empty() || part.uv.size() == part.positions.size()));
      REQUIRE(part.texture < static_cast<std::int32_t>(model.textures.size()));
    }
    return Outcome::read;
  } catch (const InputError& error) {
    REQUIRE(error.faults().size() == 1);
    REQUIRE(error.faults()[0].file == file.string());
    REQUIRE(!error.faults()[0].rule.empty());
    REQUIRE(!error.faults()[0].remedy.empty());
    return Outcome::refused;
  }
}

std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % static_cast<unsigned>(n));
  };
  static const std::array<const char*, 8> numbers{
      "nan", "-1", "1e39", "4294967295", "0", "2147483648", "inf", "99999999999999999999"};
  for (std::size_t times = 1 + below(3); times > 0 && !bytes.empty(); --times) {
    const std::size_t at = below(bytes.size()), most = std::min<std::size_t>(64, bytes.size() - at);
    const std::size_t length = 1 + below(most);
    switch (below(6)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        for (std::size_t i = 0; i < length; ++i) bytes[at + i] = static_cast<char>(random());
        break;
      default: {  // a number in a text, or what stands there
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        bytes.replace(digit == std::string::npos ? at : digit, 1, numbers[below(numbers.size())]);
      }
    }
  }
  return bytes;
}

int mutations() {
  const char* text = std::getenv("TWINARM_MUTATIONS");
  return text ? std::atoi(text) : 25;
}

}  // namespace

TEST_CASE("hostile meshes: the files that are broken below are good before") {
  const HostileFolder folder;
  for (const GoodFile& file : good_files()) {
    CAPTURE(file.name);
    CHECK(try_file(folder.write(file.name, file.bytes)) == Outcome::read);
  }
}

TEST_CASE("hostile meshes: files that are broken at random are read or refused, all in time") {
  const HostileFolder folder;
  for (const GoodFile& file : good_files()) {
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < mutations(); ++i) {
      CAPTURE(file.name);
      CAPTURE(i);
      const fs::path broken = folder.write(file.name, mutated(file.bytes, random));
      refused += try_file(broken) == Outcome::refused;
    }
    CAPTURE(file.name);
    CHECK(refused > mutations() / 10);  // they do break something
  }
}

TEST_CASE("hostile meshes: empty files, cut headers, counts without end, what is not a number") {
  const HostileFolder folder;
  const auto is_refused = [&](const std::string& name, const std::string& bytes) {
    CAPTURE(name);
    CAPTURE(bytes.substr(0, 60));
    CHECK(try_file(folder.write(name, bytes)) == Outcome::refused);
  };
  for (const GoodFile& file : good_files()) {
    is_refused(file.name, "");
    is_refused(file.name, file.bytes.substr(0, 20));
  }
  is_refused("a.stl", binary_stl(0xffffffff));
  is_refused("a.stl", binary_stl(0));
  is_refused("a.ply", ply(false).replace(ply(false).find("vertex 4"), 8, "vertex 4000000000"));
  is_refused("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  is_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  is_refused(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 nan 0\n1 0 0 1 0\n0 1 0 0 1\n"
      "3 0 1 2\n");
  is_refused("a.gltf", gltf(R"([{"children":[1]},{"children":[0],"mesh":0}])"));  // round and round
  std::string cyclic = kDae;
  cyclic.replace(cyclic.find("<instance_geometry"), 0, "<instance_node url=\"#m\"/>");
  is_refused("a.dae", cyclic);
  std::string far = binary_stl();
  const float infinite = INFINITY;
  std::memcpy(far.data() + 84 + 12, &infinite, sizeof infinite);
  is_refused("a.stl", far);
}

TEST_CASE("hostile meshes: a triangle that names a corner that does not exist is never read") {
  const HostileFolder folder;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n";
  CHECK(try_file(folder.write("a.obj", obj)) == Outcome::refused);
  for (const char* corner : {"9", "-1", "2147483647"}) {
    std::string text = ply(false);
    text.replace(text.rfind("3 1 2 3") + 6, 1, corner);
    try_file(folder.write("a.ply", text));  // refused, or read without that triangle
  }
}

#ifndef TWINARM_SANITIZED  // sanitizers reserve terabytes of addresses: the limit is not set
TEST_CASE("hostile meshes: a child that wants more memory than it may have ends with a sentence") {
  const auto work = [](std::size_t bytes) {
    return [bytes] {
      const std::vector<char> block(bytes, 1);
      return std::to_string(block[bytes / 2]);
    };
  };
  const ChildLimits limits{.cpu_seconds = 20, .bytes = std::size_t{2} << 30};
  CHECK(run_limited(work(std::size_t{64} << 20), limits).bytes == "1");
  CHECK(run_limited(work(std::size_t{3} << 30), limits).fault == "takes more than 2 GiB of memory");
}
#endif

}  // namespace twinarm
