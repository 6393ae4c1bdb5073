// Broken mesh files: each is read or rejected, in time, without a crash. TWINARM_MUTATIONS=500
// tries more of them.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "collision/mesh_files/model_file.h"
#include "collision/sandbox/sandboxed_process.h"
#include "solver/support/diagnostics.h"
#include "solver/support/sanitized.h"
#include "tests/support/temporary_folder.h"

namespace twinarm {
namespace {

// From tetrahedron/, the same mesh in every format.
std::string good_file(const std::string& name) {
  return test_data("collision/mesh_files/tetrahedron/" + name);
}
const std::vector<std::string> kGoodFiles{"text.stl",  "bytes.stl", "t.obj",  "text.ply",
                                          "bytes.ply", "t.dae",     "t.gltf", "t.glb"};

// Sets a number in the binary STL: the count of triangles at byte 80, then vertices 12 bytes after
// the start of each triangle.
template <class T>
std::string stl_with(std::size_t at, T number) {
  std::string bytes = good_file("bytes.stl");
  std::memcpy(bytes.data() + at, &number, sizeof number);
  return bytes;
}

// A second is a thousand times the usual time.
constexpr ChildLimits kShort{.cpu_seconds = 1, .bytes = std::size_t{2} << 30};

enum class Outcome { read, refused };

// The file is read and valid, or rejected with a problem and a fix. Other exceptions end the test.
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
    REQUIRE(!error.faults()[0].problem.empty());
    REQUIRE(!error.faults()[0].fix.empty());
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
      default: {  // a number in a text, or other characters
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

TEST_CASE("hostile meshes: the files are valid before mutation") {
  const TemporaryFolder folder;
  for (const std::string& name : kGoodFiles) {
    CAPTURE(name);
    CHECK(try_file(folder.write(name, good_file(name))) == Outcome::read);
  }
}

TEST_CASE("hostile meshes: randomly mutated files are read or rejected, all in time") {
  const TemporaryFolder folder;
  for (const std::string& name : kGoodFiles) {
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < mutations(); ++i) {
      CAPTURE(name);
      CAPTURE(i);
      const fs::path broken = folder.write(name, mutated(good_file(name), random));
      refused += try_file(broken) == Outcome::refused;
    }
    CAPTURE(name);
    CHECK(refused > mutations() / 10);  // mutations have an effect
  }
}

TEST_CASE("hostile meshes: empty files, truncated headers, endless counts, invalid numbers") {
  const TemporaryFolder folder;
  const auto is_refused = [&](const std::string& file, const std::string& bytes) {
    CAPTURE(file);
    CAPTURE(bytes.substr(0, 60));
    CHECK(try_file(folder.write(file, bytes)) == Outcome::refused);
  };
  for (const std::string& name : kGoodFiles) {
    is_refused(name, "");
    is_refused(name, good_file(name).substr(0, 20));
  }
  is_refused("a.stl", stl_with(80, std::uint32_t{0xffffffff}));
  is_refused("a.stl", stl_with(80, std::uint32_t{0}));
  is_refused("a.ply", replaced(good_file("text.ply"), "vertex 4", "vertex 4000000000"));
  is_refused("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  is_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  is_refused(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 nan 0\n1 0 0 1 0\n0 1 0 0 1\n"
      "3 0 1 2\n");
  is_refused("a.gltf", replaced(good_file("t.gltf"), R"([{"mesh":0}])",
                                R"([{"children":[1]},{"children":[0],"mesh":0}])"));  // cyclic
  is_refused("a.dae", replaced(good_file("t.dae"), "<instance_geometry",
                               "<instance_node url=\"#m\"/><instance_geometry"));
  is_refused("a.stl", stl_with(84 + 12, HUGE_VALF));
}

TEST_CASE("hostile meshes: a triangle with an invalid vertex index is never read") {
  const TemporaryFolder folder;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n";
  CHECK(try_file(folder.write("a.obj", obj)) == Outcome::refused);
  for (const char* corner : {"9", "-1", "2147483647"}) {
    const std::string text =
        replaced(good_file("text.ply"), "3 1 2 3", std::string("3 1 2 ") + corner);
    try_file(folder.write("a.ply", text));  // rejected, or read without that triangle
  }
}

#ifndef TWINARM_SANITIZED  // sanitizers reserve terabytes of address space: no limit
TEST_CASE("hostile meshes: a child that exceeds its memory limit ends with a message") {
  const auto work = [](const std::string& mebibytes) {
    const std::vector<char> block(std::stoul(mebibytes) << 20, 1);
    return std::to_string(block[block.size() / 2]);
  };
  const ChildLimits limits{.cpu_seconds = 20, .bytes = std::size_t{2} << 30};
  CHECK(run_limited(work, "64", limits).bytes == "1");
  CHECK(run_limited(work, "3072", limits).fault == "needs more than 2 GiB of memory");
}
#endif

}  // namespace twinarm
