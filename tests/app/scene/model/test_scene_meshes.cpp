// Meshes of bodies: errors are reported at the line of the body.
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

// A tetrahedron of legs a, some of its four triangles.
std::string tetrahedron(double a, const std::string& faces) {
  const std::string leg = " " + std::to_string(a);
  return "v 0 0 0\nv" + leg + " 0 0\nv 0" + leg + " 0\nv 0 0" + leg + "\n" + faces;
}
const char* const kClosed = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class MeshScene {
 public:
  MeshScene& mesh(const std::string& name, const std::string& obj) {
    folder_.write(name, obj);
    return *this;
  }
  MeshScene& body(const std::string& file, const std::string& more, const std::string& keys) {
    text_ += "[[body]]\nname = 'b" + std::to_string(++count_) + "'\n" + keys +
             "\nshape = { mesh = { file = '" + file + "'" + more + " } }\n";
    return *this;
  }
  SceneModel build() const { return build_scene(read_scene(folder_.write("test.toml", text_))); }
  std::vector<Diagnostic> faults() const {
    return faults_of([&] { build(); });
  }

 private:
  TemporaryFolder folder_;
  std::string text_;
  int count_ = 0;
};

const std::string kSurface = ", convex = false";

TEST_CASE("scene: all open, flipped or degenerate meshes are reported, each at its body") {
  MeshScene scene;
  scene.mesh("good.obj", tetrahedron(1, kClosed))
      .mesh("open.obj", tetrahedron(1, "f 1 3 2\nf 1 2 4\nf 1 4 3\n"))
      .mesh("flipped.obj", tetrahedron(1, "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"))
      .mesh("twice.obj", tetrahedron(1, std::string(kClosed) + "f 2 3 4\n"))
      .mesh("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n")
      .mesh("empty.obj", "v 0 0 0\nv 1 0 0\n");
  for (const char* file : {"good.obj", "open.obj", "flipped.obj", "twice.obj"})
    scene.body(file, kSurface, "fixed = true");
  scene.body("flat.obj", "", "fixed = true").body("flat.obj", "", "mass = 1");
  scene.body("empty.obj", "", "fixed = true");
  const std::vector<Diagnostic> faults = scene.faults();
  REQUIRE(faults.size() == 6);
  const std::vector<std::string> parts{"3 edges belong to one triangle only",
                                       "inverted",
                                       "1 triangles are duplicates",
                                       "hull",
                                       "hull",
                                       "empty.obj"};
  for (std::size_t i = 0; i < faults.size(); ++i) {
    INFO(to_string(faults[i]));
    CHECK(to_string(faults[i]).find(parts[i]) != std::string::npos);
    CHECK(!faults[i].fix.empty());
    if (i < 5) CHECK(faults[i].line == 5 + 4 * static_cast<int>(i));
    if (i < 5) CHECK(faults[i].file.find("test.toml") != std::string::npos);
  }
}

TEST_CASE("scene: a convex mesh is replaced by its hull, and its surface may be open") {
  MeshScene scene;
  scene.mesh("open.obj", tetrahedron(1, "f 1 3 2\nf 1 2 4\nf 1 4 3\n"))
      .body("open.obj", "", "mass = 1");
  CHECK(scene.faults().empty());
  CHECK(scene.build().description.warnings.empty());
}

TEST_CASE("scene: a mesh in millimetres gives a warning with the scale to set") {
  for (const char* more : {"", ", convex = false"}) {
    MeshScene scene;
    scene.mesh("part.obj", tetrahedron(60, kClosed)).body("part.obj", more, "fixed = true");
    const std::vector<std::string> warnings = scene.build().description.warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("test.toml:1: body 'b1': its mesh is 60 m wide") != std::string::npos);
    CHECK(warnings[0].find("scale = 0.001") != std::string::npos);
    MeshScene mended;
    mended.mesh("part.obj", tetrahedron(60, kClosed))
        .body("part.obj", std::string(", scale = 0.001") + more, "fixed = true");
    CHECK(mended.build().description.warnings.empty());
  }
}

}  // namespace
}  // namespace twinarm
