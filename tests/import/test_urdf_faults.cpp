// Bad URDF files: each fault is told with file and line, and all faults of a file at once.
// The oracle is the spoilt line itself: each case spoils one known line of a good file.
#include "collision/import/urdf/urdf.h"
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
    {"value=\"2\"", "value=\"-3\"", 6, "its mass is -3 kg"},
    {"value=\"2\"", "value=\"heavy\"", 6, "'heavy', must be 1 finite number"},
    {"value=\"2\"", "value=\"nan\"", 6, "'nan'"},
    {"value=\"2\"", "value=\"inf\"", 6, "'inf'"},
    {"value=\"2\"", "value=\"2 kg\"", 6, "'2 kg'"},
    {"value=\"2\"", "value=\"1e999\"", 6, "'1e999'"},
    {"value=\"2\"", "value=\"-1e999\"", 6, "'-1e999'"},
    {"value=\"2\"", "value=\"0x10\"", 6, "'0x10'"},
    {"value=\"2\"", "value=\"1,5\"", 6, "'1,5', must be 1 finite number; write a decimal point"},
    {"value=\"2\"", "value=\"\"", 6, "''"},
    {"value=\"2\"", "value=\"${m}\"", 6, "xacro"},
    {"value=\"2\"", "", 6, "missing"},
    {"<mass value=\"2\"/>", "", 4, "has no <mass>"},
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
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"\"/>", 10, "is empty"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh/>", 10, "is missing"},
    {"type=\"revolute\"", "type=\"hinge\"", 13, "'hinge' is not supported; types: fixed, revolute"},
    {"type=\"revolute\"", "type=\"spherical\"", 13,
     "URDF has no joint type 'spherical'; write type=\"floating\" for other programs, and inside "
     "<twinarm type=\"spherical\"/>"},
    {"type=\"revolute\"", "type=\"screw\"", 13, "write type=\"continuous\""},
    {"type=\"revolute\"", "", 13, "type"},
    {"name=\"joint1\"", "", 13, "it has no name"},
    {"parent link=\"base\"", "parent link=\"nobody\"", 14,
     "joint 'joint1': its parent link 'nobody' does not exist"},
    {"child link=\"arm1\"", "child link=\"nobody\"", 15, "its child link 'nobody'"},
    {"<parent link=\"base\"/>", "", 13, "its parent link is not given"},
    {"axis xyz=\"0 0 1\"", "axis xyz=\"0 0 0\"", 16, "its axis is zero"},
    {"lower=\"-1\"", "lower=\"2\"", 17, "its lower limit 2 lies above its upper limit 1.5"},
    {"lower=\"-1\"", "lower=\"nan\"", 17, "'nan'"},
    {"effort=\"10\"", "effort=\"-infinite\"", 17, "'-infinite'"},
    {"<limit lower=\"-1\" upper=\"1.5\" effort=\"10\" velocity=\"5\"/>", "", 13,
     "must have limits"},
    {"damping=\"0.1\"", "damping=\"-0.1\"", 18, "its damping is -0.1, must not be negative"},
    {"friction=\"0.2\"", "friction=\"-0.2\"", 18, "its friction is -0.2"},
    {"<axis", "<twinarm armature=\"-1\"/><axis", 16, "its armature is -1"},
    {"<axis", "<twinarm coulomb_minus=\"-1\"/><axis", 16, "its coulomb_minus is -1"},
    {"<axis", "<twinarm type=\"screw\"/><axis", 16, "a screw joint must have a pitch"},
    {"<axis", "<twinarm type=\"screw\" pitch=\"x\"/><axis", 16, "'x'"},
    {"<axis", "<twinarm type=\"ball\"/><axis", 16,
     "'ball', must be spherical, screw, cylindrical or universal"},
    {"<axis", "<twinarm type=\"prismatic\"/><axis", 16, "must be spherical"},
    {"<axis", "<twinarm armature=\"heavy\"/><axis", 16, "'heavy'"},
    {"<axis", "<mimic joint=\"x\"/><axis", 16, "it mimics joint 'x', which does not exist"},
    {"<axis", "<mimic joint=\"joint1\"/><axis", 16, "it mimics itself"},
    {"<axis", "<mimic/><axis", 16, "<mimic joint=\"...\"> is missing"},
    {"<axis", "<origin quat_xyzw=\"0 0 0 0\"/><axis", 16, "quat_xyzw is zero"},
    {"<axis", "<origin rpy=\"0 0 0\" quat_xyzw=\"0 0 0 1\"/><axis", 16, "rpy and quat_xyzw"},
    {"<axis", "<origin/><origin/><axis", 16, "a second <origin>"},
    {"<mass value", "<mass value=\"1\"/><mass value", 6, "a second <mass>"},
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
  CHECK(tells(faults_in("<!-- nothing but words -->"), 0, "no <robot> element; give a URDF file"));
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

}  // namespace
}  // namespace twinarm
