// Robots from recipes, against closed forms of boxes.
#include "app/recipe/robot_recipe.h"

#include "collision/import/robot/robot_model.h"
#include "collision/import/toml/toml_file.h"
#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

TriangleMesh box_mesh(const Vector3& low, const Vector3& high) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(),
                               k & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// A cube of edge 1 m of two halves of different metals, in millimetres, on a foot.
const std::string kCube = test_data("app/recipe/cube.toml");

struct CubeFolder : TemporaryFolder {
  CubeFolder() {
    write("meshes/lower.stl", stl_bytes(box_mesh({0, 0, 0}, {1, 1, 0.5}), 0.001));
    write("meshes/upper.stl", stl_bytes(box_mesh({0, 0, 0.5}, {1, 1, 1}), 0.001));
  }
  fs::path recipe(const std::string& text) const { return write("robot.toml", text); }
};

TEST_CASE("a cube of two halves has the closed-form mass, centre and inertia") {
  const CubeFolder folder;
  const RobotDescription robot = read_recipe(folder.recipe(kCube)).robot;
  CHECK(robot.root == "foot");
  CHECK(!robot.links[0].has_inertia);
  const LinkDescription& body = robot.links[1];
  const double m1 = 150, m2 = 50, m = m1 + m2;  // kg: densities times half a cubic metre
  const double z = (m1 * 0.25 + m2 * 0.75) / m;
  CHECK(body.mass == doctest::Approx(m).epsilon(1e-14));
  CHECK((body.com - Vector3(0.5, 0.5, z)).norm() < 1e-14);
  // Each half is a box of 1 x 1 x 0.5, offset along z (Steiner).
  const double steiner = m1 * (z - 0.25) * (z - 0.25) + m2 * (z - 0.75) * (z - 0.75);
  const double across = m * (1 + 0.25) / 12 + steiner, along = m * 2 / 12;
  const Matrix3 expected = Vector3(across, across, along).asDiagonal();
  CHECK((body.inertia - expected).norm() < 1e-12);
}

TEST_CASE("an origin in [paper] is in its unit, others are in metres") {
  const CubeFolder folder;
  CHECK(read_recipe(folder.recipe(kCube)).robot.joints[0].origin.xyz == Vector3(0.5, 1, 1.5));
  const std::string text =
      replaced(replaced(kCube, "hinge = [1, 2, 3]", ""), "damping", "origin = [1, 2, 3]\ndamping");
  CHECK(read_recipe(folder.recipe(text)).robot.joints[0].origin.xyz == Vector3(1, 2, 3));
}

TEST_CASE("a joint of a recipe may have roll, pitch and yaw") {
  const CubeFolder folder;
  const std::string text = replaced(kCube, "damping", "rpy = [0.1, -0.2, 0.3]\ndamping");
  CHECK(read_recipe(folder.recipe(text)).robot.joints[0].origin.rpy == Vector3(0.1, -0.2, 0.3));
  CHECK(read_recipe(folder.recipe(kCube)).robot.joints[0].origin.rpy == Vector3(0, 0, 0));
}

TEST_CASE("the files of a recipe read back as its robot") {
  const CubeFolder folder;
  const fs::path recipe = folder.recipe(kCube);
  make_robot(recipe);
  const RobotDescription read = read_urdf(folder.path() / "cube.urdf");
  check_same(read, read_recipe(recipe).robot, 0.0);
  CHECK(read.joints[0].axis == Vector3::UnitZ());
  CHECK(read.joints[0].damping == 0.25);
  CHECK(read.links[1].visuals[1].color == Vector4(1, 0, 0, 1));
  REQUIRE(read.links[1].collisions.size() == 1);
  const auto& hull = std::get<MeshGeometry>(read.links[1].collisions[0].geometry);
  CHECK(hull.file == folder.path() / "collision" / "body.stl");
  // The hull of the two halves is the cube.
  const TriangleMesh mesh = load_mesh(hull);
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 p(corner & 1, (corner >> 1) & 1, corner >> 2);
    double nearest = 1;
    for (const Vector3& v : mesh.vertices) nearest = std::min(nearest, (v - p).norm());
    CHECK(nearest < 1e-12);
  }
}

TEST_CASE("the same recipe gives the same bytes") {
  const CubeFolder folder;
  make_robot(folder.recipe(kCube));
  const std::string urdf = text_of(folder.path() / "cube.urdf");
  const std::string hull = text_of(folder.path() / "collision" / "body.stl");
  make_robot(folder.path() / "robot.toml");
  CHECK(text_of(folder.path() / "cube.urdf") == urdf);
  CHECK(text_of(folder.path() / "collision" / "body.stl") == hull);
}

struct SpoiltRecipe {
  const char* from;
  const char* to;
  int line;
  const char* words;
};

const SpoiltRecipe kSpoiltRecipes[] = {
    {"name = \"cube\"", "name = \"a/b\"", 1, "is used as a file name"},
    {"name = \"cube\"", "name = 3", 1, "name: must be a text, is 3"},
    {"name = \"cube\"", "name = \"\"", 1, "name: must not be empty; give name = "},
    {"name = \"foot\"", "", 12, "name: is missing; give name = "},
    {"[paper]\nunit = 0.5\nhinge = [1, 2, 3]", "paper = 3", 3, "paper: must be a table, is 3"},
    {"[[joint]]", "[joint]", 24, "joint: must be a list of tables, is a table; write [[joint]]"},
    {"parts = [\"lower\", \"upper\"]", "parts = \"lower\"", 23, "parts: must be a list of names"},
    {"parts = [\"lower\", \"upper\"]", "parts = [\"lower\", 3]", 23,
     "parts: must be a list of names; give parts = "},
    {"mesh_scale = 0.001", "mesh_scale = -1", 2, "mesh_scale: must be positive, is -1"},
    {"mesh_scale = 0.001", "mesh_scale = 0.001\nmesh_scal = 1", 3,
     "mesh_scal: unknown key; did you mean 'mesh_scale'?"},
    {"hinge = [1, 2, 3]", "hinges = [1, 2, 3]", 5, "hinges: is not a joint"},
    {"hinge = [1, 2, 3]", "hinge = [1, 2]", 5, "3 finite numbers"},
    {"density = 100", "density = 0", 7, "density: must be positive, is 0"},
    {"density = 100", "density = \"x\"", 7, "density: must be a number, is the text 'x'"},
    {"density = 100", "density = nan", 7, "density: must be finite"},
    {"color = [1, 0, 0, 1]", "color = [1, 0, 0, 2]", 8, "[0, 1]"},
    {"name = \"foot\"", "name = \"body\"", 14, "duplicate name"},
    {"mesh = \"upper\"", "mesh = \"none\"", 19, "none.stl"},
    {"mesh = \"upper\"", "mesh = \"lower\"", 19, "the part is listed twice"},
    {"material = \"light\"", "material = \"gold\"", 19, "material 'gold' does not exist"},
    {"parts = [\"lower\", \"upper\"]", "parts = [\"side\"]", 22,
     "'side' is not a part of this link"},
    {"parts = [\"lower\", \"upper\"]",
     "parts = [\"lower\"]\n  [[link.collision]]\n  name = \"body_1\"\n  parts = [\"upper\"]", 24,
     "duplicate name of a collision; give each its own `name`"},
    {"type = \"revolute\"", "type = \"ball\"", 26, "is not supported; types: fixed"},
    {"type = \"revolute\"", "type = \"screw\"", 24, "pitch: is missing"},
    {"parent = \"foot\"", "parent = \"nobody\"", 27, "'nobody' does not exist"},
    {"axis = [0, 0, 2]", "axis = [0, 0, 0]", 29, "its axis is zero"},
    {"limits = [-1, 2]", "limits = [3, 2]", 30, "above its upper limit"},
    {"limits = [-1, 2]", "", 24, "limits: is missing"},
    {"damping = 0.25", "damping = -1", 31, "must not be negative"},
    {"damping = 0.25", "damping = 1\norigin = [0, 0, 0]", 32, "and in [paper]"},
    {"damping = 0.25", "damping = = 1", 31, "not well-formed TOML"},
};

TEST_CASE("an invalid line of a recipe gives an error with file and line") {
  const CubeFolder folder;
  for (const SpoiltRecipe& spoilt : kSpoiltRecipes) {
    INFO(spoilt.from, " -> ", spoilt.to);
    const fs::path file = folder.recipe(replaced(kCube, spoilt.from, spoilt.to));
    const std::vector<Diagnostic> faults = faults_of([&] { read_recipe(file); });
    INFO(listing(faults));
    CHECK(tells(faults, spoilt.line, spoilt.words));
    for (const Diagnostic& fault : faults) CHECK(fault.file == file.string());
  }
}

TEST_CASE("all errors of a recipe are reported at once") {
  const CubeFolder folder;
  std::string text = replaced(kCube, "density = 100", "density = -1");
  text = replaced(text, "mesh = \"upper\"", "mesh = \"none\"");
  text = replaced(text, "axis = [0, 0, 2]", "axis = [0, 0, 0]");
  const auto faults = faults_of([&] { read_recipe(folder.recipe(text)); });
  INFO(listing(faults));
  CHECK(tells(faults, 7, "density"));
  CHECK(tells(faults, 19, "none.stl"));
  CHECK(tells(faults, 29, "axis"));
}

TEST_CASE("an open mesh is rejected at the line of its part, and nothing is written") {
  const CubeFolder folder;
  TriangleMesh open = box_mesh({0, 0, 0.5}, {1, 1, 1});
  open.triangles.pop_back();
  folder.write("meshes/upper.stl", stl_bytes(open, 0.001));
  const auto faults = faults_of([&] { make_robot(folder.recipe(kCube)); });
  INFO(listing(faults));
  CHECK(tells(faults, 19, "not closed"));
  CHECK(!fs::exists(folder.path() / "cube.urdf"));
}

// Brackets in strings do not count, their lines do.
TEST_CASE("a recipe that is nested too deep, or too long, is rejected before parsing") {
  const CubeFolder folder;
  const std::string before = std::string(kCube) + "note = \"\"\"\n" + std::string(300, '[') +
                             "\n\"\"\"\n" + "said = \"a \\\" " + std::string(300, '[') + "\"\n";
  const auto deep = [](std::size_t depth) {
    return "deep = " + std::string(depth, '[') + std::string(depth, ']') + "\n";
  };
  CHECK(faults_of([&] { read_toml_text(folder.recipe(before + deep(200))); }).empty());
  const auto faults = faults_of([&] { read_recipe(folder.recipe(before + deep(201))); });
  INFO(listing(faults));
  CHECK(faults.size() == 1);
  CHECK(tells(faults, 36, "TOML nesting depth exceeds 200"));
  const fs::path file = folder.recipe(kCube);
  fs::resize_file(file, (4u << 20) + 1);  // sparse
  CHECK(tells(faults_of([&] { read_recipe(file); }), 0, "larger than 4 MiB"));
}

TEST_CASE("a missing recipe is an error with its name") {
  const auto faults = faults_of([] { read_recipe("/nonexistent/robot.toml"); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].file == "/nonexistent/robot.toml");
}

}  // namespace
}  // namespace twinarm
