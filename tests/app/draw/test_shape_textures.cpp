// Textures on plain shapes, from a list and from files of robots and scenes.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "app/draw/scene_meshes.h"
#include "app/render/gl/painter.h"
#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "tests/app/render/list/quarters.h"
#include "tests/app/scene/model/helpers.h"
#include "tests/support/temporary_folder.h"

namespace twinarm {
namespace {

struct TextureFolder : TemporaryFolder {
  TextureFolder() { write_png((path() / "quarters.png").string(), quarters(64)); }
};

// Picture of the list from `eye` towards the origin; light from the eye.
std::string seen_quarters(DrawList list, const Vector3& eye, const Vector3& up) {
  list.ground.visible = false;
  list.camera.eye = eye;
  list.camera.target = Vector3::Zero();
  list.camera.up = up;
  list.light_W = eye;
  list.background = white_background();
  return quarters_of(Painter(Backend::osmesa, 120, 120, Quality::draft).paint(list));
}

DrawList with_quarters(UnitShape shape, const Pose& X_WM = {}) {
  DrawList list;
  add_mesh_instance(list, list.unit_mesh(shape), X_WM, Color{1, 1, 1, 1});
  list.instances.back().texture =
      list.register_texture(std::make_shared<const Image>(quarters(64)));
  return list;
}

// Picture of a robot or a scene.
DrawList list_of(const SceneMeshes& cast, DrawList list) {
  for (const ScenePart& part : cast.parts) {
    add_mesh_instance(list, part.mesh, part.X_LM, part.color, part.scale);
    list.instances.back().texture = part.texture;
  }
  return list;
}

std::string robot_of(const std::string& visual) {
  return R"(<robot name="r"><material name="q"><texture filename="quarters.png"/></material>
<link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
</inertial><visual>)" +
         visual + "</visual></link></robot>";
}

struct ShownRobot {
  RobotDescription robot;
  SceneMeshes cast;
  DrawList list;
};

ShownRobot show_robot(const TextureFolder& folder, const std::string& visual) {
  ShownRobot shown;
  shown.robot = read_urdf(folder.write("r.urdf", robot_of(visual)));
  ModelOptions floating;
  floating.floating = true;
  const Model<double> model = build_model(shown.robot, floating);
  shown.cast = make_scene_meshes(shown.robot, model, shown.list);
  return shown;
}

}  // namespace

TEST_CASE("textures: each face of a box shows the whole picture, upright") {
  const DrawList box = with_quarters(UnitShape::box);
  for (const Vector3& side :
       {Vector3(3, 0, 0), Vector3(-3, 0, 0), Vector3(0, 3, 0), Vector3(0, -3, 0)})
    CHECK(seen_quarters(box, side, Vector3::UnitZ()) == "rgbw");
  for (const Vector3& end : {Vector3(0, 0, 3), Vector3(0, 0, -3)})
    CHECK(seen_quarters(box, end, Vector3::UnitY()) == "rgbw");
}

TEST_CASE("textures: a sphere and a cylinder show the picture once around, its centre towards x") {
  const Pose centred{Matrix3::Identity(), Vector3(0, 0, -0.5)};
  for (const DrawList& round :
       {with_quarters(UnitShape::sphere), with_quarters(UnitShape::coarse_sphere),
        with_quarters(UnitShape::cylinder, centred)}) {
    CHECK(seen_quarters(round, Vector3(6, 0, 0), Vector3::UnitZ()) == "rgbw");
    // At the border of the texture its right half is on the left.
    CHECK(seen_quarters(round, Vector3(-6, 0, 0), Vector3::UnitZ()) == "grwb");
  }
  CHECK(seen_quarters(with_quarters(UnitShape::cylinder), Vector3(0, 0, 6), Vector3::UnitY()) ==
        "rgbw");
}

TEST_CASE("textures: a URDF material applies to shapes and to meshes with texture coordinates") {
  const TextureFolder folder;
  folder.write(
      "square.obj",
      "v 0 -0.5 -0.5\nv 0 0.5 -0.5\nv 0 0.5 0.5\nv 0 -0.5 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  folder.write("bare.obj", "v 0 -0.5 -0.5\nv 0 0.5 -0.5\nv 0 0.5 0.5\nf 1 2 3\n");
  for (const char* shape :
       {"<box size=\"1 1 1\"/>", "<sphere radius=\"1\"/>", "<cylinder radius=\"1\" length=\"1\"/>",
        "<capsule radius=\"1\" length=\"1\"/>", "<mesh filename=\"square.obj\"/>"}) {
    CAPTURE(std::string(shape));
    for (const char* material :
         {"<material name=\"q\"/>",
          "<material name=\"own\"><texture filename=\"quarters.png\"/></material>"}) {
      const ShownRobot robot =
          show_robot(folder, std::string("<geometry>") + shape + "</geometry>" + material);
      CHECK(robot.robot.warnings.empty());
      CHECK(seen_quarters(list_of(robot.cast, robot.list), Vector3(6, 0, 0), Vector3::UnitZ()) ==
            "rgbw");
    }
  }
  const ShownRobot bare = show_robot(
      folder, "<geometry><mesh filename=\"bare.obj\"/></geometry><material name=\"q\"/>");
  REQUIRE(bare.cast.notes.size() == 1);
  CHECK(bare.cast.notes[0].find("quarters.png") != std::string::npos);
  CHECK(!bare.cast.parts.at(0).texture);
}

TEST_CASE("textures: a missing or invalid file is reported and the link drawn without it") {
  const TextureFolder folder;
  folder.write("text.png", "no picture");
  const auto robot = [&](const char* file) {
    return show_robot(folder,
                      std::string("<geometry><box size=\"1 1 1\"/></geometry><material "
                                  "name=\"m\"><color rgba=\"1 0 0 1\"/><texture filename=\"") +
                          file + "\"/></material>");
  };
  const ShownRobot missing = robot("none.png"), broken = robot("text.png");
  REQUIRE(missing.robot.warnings.size() == 1);
  CHECK(missing.robot.warnings[0].problem.find("none.png") != std::string::npos);
  REQUIRE(broken.cast.notes.size() == 1);
  CHECK(broken.cast.notes[0].find("text.png") != std::string::npos);
  for (const ShownRobot* r : {&missing, &broken})
    CHECK(seen_quarters(list_of(r->cast, r->list), Vector3(6, 0, 0), Vector3::UnitZ()) == "rrrr");
}

TEST_CASE("textures: a body of a scene has its colour, its texture, or their product") {
  const TextureFolder folder;
  const auto body = [&](const std::string& looks) {
    const SceneModel scene = built(
        "[[body]]\nname = \"b\"\nfixed = true\nshape = { box = { size = "
        "[1, 1, 1] } }\n" +
        looks);
    DrawList list;
    const SceneMeshes cast = make_scene_meshes(scene, list);
    return seen_quarters(list_of(cast, list), Vector3(6, 0, 0), Vector3::UnitZ());
  };
  const std::string texture =
      "texture = \"" + folder.write("unused", "").parent_path().string() + "/quarters.png\"\n";
  CHECK(body("color = [0, 1, 0]\n") == "gggg");
  CHECK(body(texture) == "rgbw");
  CHECK(body(texture + "color = [1, 0, 0]\n")[3] == 'r');  // white times red
  for (const char* bad : {"color = [0, 2, 0]\n", "color = [0, 1]\n", "texture = \"none.png\"\n"})
    CHECK(faults_of([&] { body(bad); }).size() == 1);
}

}  // namespace twinarm
