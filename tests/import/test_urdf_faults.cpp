// Bad URDF files: each fault is told with file and line, and all faults of a file at once.
// The oracle is the spoilt line itself: each case spoils one known line of a good file.
#include "collision/import/urdf.h"
#include "tests/import/helpers.h"

namespace twinarm {
namespace {

struct Spoilt {
  const char* from;
  const char* to;
  int line;
  const char* words;  // in the fault
};

const Spoilt kOneLine[] = {
    {"name=\"arm\"", "", 1, "name"},
    {"<link name=\"base\"/>", "<link name=\"base\"/><link/>", 2, "it has no name"},
    {"<link name=\"base\"/>", "<link name=\"base\"/><link name=\"base\"/>", 2,
     "link 'base': the name is taken"},
    {"value=\"2\"", "value=\"0\"", 6, "link 'arm1': its mass is 0 kg"},
    {"value=\"2\"", "value=\"-3\"", 6, "its mass is -3 kg"},
    {"value=\"2\"", "value=\"heavy\"", 6, "'heavy', must be 1 finite number"},
    {"value=\"2\"", "value=\"nan\"", 6, "'nan'"},
    {"value=\"2\"", "value=\"inf\"", 6, "'inf'"},
    {"value=\"2\"", "value=\"2 kg\"", 6, "'2 kg'"},
    {"value=\"2\"", "value=\"1e999\"", 6, "'1e999'"},
    {"value=\"2\"", "value=\"0x10\"", 6, "'0x10'"},
    {"value=\"2\"", "value=\"${m}\"", 6, "xacro"},
    {"value=\"2\"", "", 6, "missing"},
    {"<mass value=\"2\"/>", "", 4, "has no <mass>"},
    {"ixx=\"0.01\"", "ixx=\"-0.01\"", 7, "not positive definite"},
    {"ixx=\"0.01\"", "ixx=\"0\"", 7, "not positive definite"},
    {"ixy=\"0\"", "ixy=\"0.5\"", 7, "not positive definite"},
    {"ixx=\"0.01\"", "ixx=\"0.1\"", 7, "triangle inequality"},
    {"iyz=\"0\"", "", 7, "iyz"},
    {"xyz=\"0.2 0 0\"", "xyz=\"0.2 0\"", 5, "'0.2 0', must be 3 finite numbers"},
    {"xyz=\"0.2 0 0\"", "xyz=\"0.2 0 0 0\"", 5, "3 finite numbers"},
    {"xyz=\"0.2 0 0\"", "rpy=\"0 x 0\"", 5, "'0 x 0'"},
    {"size=\"0.4 0.1 0.1\"", "size=\"0.4 -0.1 0.1\"", 10, "three positive numbers"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<cone/>", 10, "shape <cone> is not known"},
    {"<box size=\"0.4 0.1 0.1\"/>", "", 10, "no geometry"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<sphere radius=\"0\"/>", 10, "must be positive"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"no.stl\"/>", 10,
     "mesh file 'no.stl' does not exist"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"package://p/no.stl\"/>", 10,
     "'package://p/no.stl' does not exist"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"http://x/no.stl\"/>", 10, "scheme"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"package://\"/>", 10, "scheme"},
    {"</geometry>", "</geometry><material name=\"blue\"/>", 10, "'blue' is not defined"},
    {"type=\"revolute\"", "type=\"spherical\"", 13,
     "supported today: fixed, revolute, continuous, prismatic, floating"},
    {"type=\"revolute\"", "", 13, "type"},
    {"name=\"joint1\"", "", 13, "it has no name"},
    {"parent link=\"base\"", "parent link=\"nobody\"", 14,
     "joint 'joint1': its parent link 'nobody' does not exist"},
    {"child link=\"arm1\"", "child link=\"nobody\"", 15, "its child link 'nobody'"},
    {"<parent link=\"base\"/>", "", 13, "its parent link is not given"},
    {"axis xyz=\"0 0 1\"", "axis xyz=\"0 0 0\"", 16, "its axis is zero"},
    {"lower=\"-1\"", "lower=\"2\"", 17, "its lower limit 2 lies above its upper limit 1.5"},
    {"lower=\"-1\" upper=\"1.5\"", "", 17, "must have limits"},
    {"<limit lower=\"-1\" upper=\"1.5\" effort=\"10\" velocity=\"5\"/>", "", 13,
     "must have limits"},
    {"damping=\"0.1\"", "damping=\"-0.1\"", 18, "its damping is -0.1, must not be negative"},
    {"friction=\"0.2\"", "friction=\"-0.2\"", 18, "its friction is -0.2"},
    {"<axis", "<twinarm armature=\"-1\"/><axis", 16, "its armature is -1"},
    {"<axis", "<twinarm coulomb_minus=\"-1\"/><axis", 16, "its coulomb_minus is -1"},
    {"<axis", "<twinarm type=\"screw\"/><axis", 13, "'screw' is not supported"},
    {"<axis", "<mimic joint=\"x\"/><axis", 16, "<mimic>"},
    {"<axis", "<axis xyz=\"1 0 0\"/><axis", 16, "a second <axis>"},
    {"<link name=\"base\"/>", "<link name=\"base\"/><xacro:arm/>", 2, "xacro"},
    {"<link name=\"base\"/>", "<link name=\"base\"/><link name=\"lone\"/>", 2,
     "link 'lone': it has no parent"},
};

TEST_CASE("a spoilt line of a URDF gives one fault, with file, line, rule and remedy") {
  const TemporaryFolder folder;
  for (const Spoilt& spoilt : kOneLine) {
    INFO(spoilt.from, " -> ", spoilt.to);
    const fs::path file = folder.write("arm.urdf", replaced(kGoodArm, spoilt.from, spoilt.to));
    const std::vector<Fault> faults = faults_of([&] { read_urdf(file); });
    INFO(listing(faults));
    CHECK(tells(faults, spoilt.line, spoilt.words));
    CHECK(faults.size() == 1);
    for (const Fault& fault : faults) {
      CHECK(fault.file == file.string());
      CHECK(!fault.rule.empty());
      CHECK(!fault.remedy.empty());
    }
  }
}

TEST_CASE("all faults of a URDF are told at once, in the order of their lines") {
  const TemporaryFolder folder;
  std::string text = replaced(kGoodArm, "value=\"2\"", "value=\"-2\"");
  text = replaced(text, "ixx=\"0.01\"", "ixx=\"NaN\"");
  text = replaced(text, "size=\"0.4 0.1 0.1\"", "size=\"a b c\"");
  text = replaced(text, "child link=\"arm1\"", "child link=\"arm2\"");
  text = replaced(text, "xyz=\"0 0 1\"", "xyz=\"0 0 0\"");
  text = replaced(text, "lower=\"-1\"", "lower=\"7\"");
  text = replaced(text, "damping=\"0.1\"", "damping=\"-1\"");
  const auto faults = faults_of([&] { read_urdf(folder.write("arm.urdf", text)); });
  INFO(listing(faults));
  std::vector<int> lines;
  for (const Fault& fault : faults) lines.push_back(fault.line);
  CHECK(lines == std::vector<int>{6, 7, 10, 15, 16, 17, 18});
}

TEST_CASE("malformed XML is told with the line where the reader gave up") {
  const TemporaryFolder folder;
  const auto faults_in = [&](const std::string& text) {
    return faults_of([&] { read_urdf(folder.write("arm.urdf", text)); });
  };
  const auto mismatched = faults_in(replaced(kGoodArm, "</inertial>", "</inertia>"));
  INFO(listing(mismatched));
  CHECK(tells(mismatched, 4, "not well-formed XML"));  // the element that is not closed
  CHECK(faults_in(replaced(kGoodArm, "</robot>", "")).size() == 1);
  CHECK(faults_in("").size() == 1);
  CHECK(faults_in("no xml at all").size() == 1);
  CHECK(tells(faults_in("<sdf/>"), 1, "must be <robot>"));
  CHECK(tells(faults_in("<robot name=\"r\"/>"), 0, "no link"));
}

TEST_CASE("a missing file, or a folder in its place, is a fault with its name") {
  const TemporaryFolder folder;
  const auto faults = faults_of([&] { read_urdf(folder.path() / "none.urdf"); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].file == (folder.path() / "none.urdf").string());
  CHECK(faults_of([&] { read_urdf(folder.path()); }).size() == 1);
}

// Links without numbers, fixed joints: only the tree is at stake. Line 1 is <robot>, then the links
// one a line, then the joints one a line.
std::string tree(const std::vector<std::string>& links,
                 const std::vector<std::array<std::string, 3>>& joints) {
  std::string text = "<robot name=\"tree\">\n";
  for (const std::string& link : links) text += "<link name=\"" + link + "\"/>\n";
  for (const auto& [name, parent, child] : joints)
    text += "<joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + parent +
            "\"/><child link=\"" + child + "\"/></joint>\n";
  return text + "</robot>\n";
}

TEST_CASE("loops, two parents, several roots and doubled joints are told where they stand") {
  const TemporaryFolder folder;
  const auto faults_in = [&](const std::string& text) {
    return faults_of([&] { read_urdf(folder.write("tree.urdf", text)); });
  };
  SUBCASE("a loop beside a good root") {
    const auto faults = faults_in(
        tree({"r", "a", "b", "c"}, {{{"j1", "c", "a"}, {"j2", "a", "b"}, {"j3", "b", "c"}}}));
    INFO(listing(faults));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 6, "loop: a -> b -> c -> a"));
  }
  SUBCASE("a joint from a link to itself, and no root at all") {
    const auto faults = faults_in(tree({"a"}, {{{"j1", "a", "a"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 3, "loop: a -> a"));
  }
  SUBCASE("a branch that hangs on a loop does not tell it again") {
    const auto faults = faults_in(
        tree({"r", "a", "b", "c"}, {{{"j0", "b", "c"}, {"j1", "a", "b"}, {"j2", "b", "a"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 7, "joint 'j1'"));
  }
  SUBCASE("two parents") {
    const auto faults =
        faults_in(tree({"r", "a", "b"}, {{{"j1", "r", "a"}, {"j2", "r", "b"}, {"j3", "a", "b"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 7, "'b' has a parent already, by joint 'j2' of line 6"));
  }
  SUBCASE("three roots") {
    const auto faults = faults_in(tree({"r", "s", "t"}, {}));
    CHECK(faults.size() == 2);
    CHECK(tells(faults, 3, "link 's': it has no parent"));
    CHECK(tells(faults, 4, "link 't': it has no parent"));
  }
  SUBCASE("two joints of one name") {
    const auto faults = faults_in(tree({"r", "a", "b"}, {{{"j", "r", "a"}, {"j", "r", "b"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 6, "joint 'j': the name is taken already by the joint of line 5"));
  }
}

TEST_CASE("what moves needs an inertia; a root on the world and links fixed to a body do not") {
  const TemporaryFolder folder;
  const std::string inertial =
      "<inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
      "izz=\"1\"/></inertial>";
  const std::string text = R"(<robot name="arm">
<link name="base"/>
<link name="arm"></link>
<link name="tool"></link>
<joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/></joint>
<joint name="weld" type="fixed"><parent link="arm"/><child link="tool"/></joint>
</robot>)";
  const auto faults = faults_of([&] { read_urdf(folder.write("a.urdf", text)); });
  CHECK(faults.size() == 1);
  CHECK(tells(faults, 3, "link 'arm': it moves (by joint 'hinge') but has no inertia"));
  CHECK(tells(faults, 3, "only a root that stands on the world"));
  for (const char* link : {"<link name=\"arm\">", "<link name=\"tool\">"})
    CHECK_NOTHROW(read_urdf(folder.write("b.urdf", replaced(text, link, link + inertial))));
}

}  // namespace
}  // namespace twinarm
