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
  const char* code;
  const char* value;  // in the fault
};

const Spoilt kOneLine[] = {
    {"name=\"arm\"", "", 1, "urdf.attribute-missing", "name"},
    {"<link name=\"base\"/>", "<link name=\"base\"/><link/>", 2, "robot.name-missing", ""},
    {"<link name=\"base\"/>", "<link name=\"base\"/><link name=\"base\"/>", 2, "robot.name-taken",
     "'base'"},
    {"value=\"2\"", "value=\"-3\"", 6, "robot.negative", "-3"},
    {"value=\"2\"", "value=\"heavy\"", 6, "urdf.number", "'heavy'"},
    {"value=\"2\"", "value=\"nan\"", 6, "urdf.number", "'nan'"},
    {"value=\"2\"", "value=\"inf\"", 6, "urdf.number", "'inf'"},
    {"value=\"2\"", "value=\"2 kg\"", 6, "urdf.number", "'2 kg'"},
    {"value=\"2\"", "value=\"1e999\"", 6, "urdf.number", "'1e999'"},
    {"value=\"2\"", "value=\"-1e999\"", 6, "urdf.number", "'-1e999'"},
    {"value=\"2\"", "value=\"0x10\"", 6, "urdf.number", "'0x10'"},
    {"value=\"2\"", "value=\"1,5\"", 6, "urdf.number", "'1,5'"},
    {"value=\"2\"", "value=\"\"", 6, "urdf.number", "''"},
    {"value=\"2\"", "value=\"${m}\"", 6, "urdf.xacro", "'${m}'"},
    {"value=\"2\"", "", 6, "urdf.attribute-missing", "<mass value="},
    {"<mass value=\"2\"/>", "", 4, "urdf.mass-missing", "<mass>"},
    {"iyz=\"0\"", "", 7, "urdf.attribute-missing", "iyz"},
    {"xyz=\"0.2 0 0\"", "xyz=\"0.2 0\"", 5, "urdf.number", "'0.2 0'"},
    {"xyz=\"0.2 0 0\"", "xyz=\"0.2 0 0 0\"", 5, "urdf.number", "'0.2 0 0 0'"},
    {"xyz=\"0.2 0 0\"", "rpy=\"0 x 0\"", 5, "urdf.number", "'0 x 0'"},
    {"size=\"0.4 0.1 0.1\"", "size=\"0.4 -0.1 0.1\"", 10, "urdf.number", "'0.4 -0.1 0.1'"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<cone/>", 10, "urdf.shape", "<cone>"},
    {"<box size=\"0.4 0.1 0.1\"/>", "", 10, "urdf.shape", ""},
    {"<box size=\"0.4 0.1 0.1\"/>", "<sphere radius=\"0\"/>", 10, "urdf.number", "radius"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"no.stl\"/>", 10, "file.missing", "'no.stl'"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"package://p/no.stl\"/>", 10, "file.missing",
     "'package://p/no.stl'"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"http://x/no.stl\"/>", 10,
     "file.scheme-unknown", "http"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"package://\"/>", 10, "file.scheme-unknown",
     "package"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh filename=\"\"/>", 10, "urdf.attribute-missing",
     "filename"},
    {"<box size=\"0.4 0.1 0.1\"/>", "<mesh/>", 10, "urdf.attribute-missing", "filename"},
    {"type=\"revolute\"", "type=\"hinge\"", 13, "urdf.joint-type", "'hinge'"},
    {"type=\"revolute\"", "type=\"spherical\"", 13, "urdf.joint-type",
     "<twinarm type=\"spherical\"/>"},
    {"type=\"revolute\"", "type=\"screw\"", 13, "urdf.joint-type", "type=\"continuous\""},
    {"type=\"revolute\"", "", 13, "urdf.attribute-missing", "type"},
    {"name=\"joint1\"", "", 13, "robot.name-missing", ""},
    {"parent link=\"base\"", "parent link=\"nobody\"", 14, "robot.link-unknown", "'nobody'"},
    {"child link=\"arm1\"", "child link=\"nobody\"", 15, "robot.link-unknown", "'nobody'"},
    {"<parent link=\"base\"/>", "", 13, "robot.link-unknown", "'joint1'"},
    {"axis xyz=\"0 0 1\"", "axis xyz=\"0 0 0\"", 16, "robot.axis-zero", "'joint1'"},
    {"lower=\"-1\"", "lower=\"2\"", 17, "robot.limits", "1.5"},
    {"lower=\"-1\"", "lower=\"nan\"", 17, "urdf.number", "'nan'"},
    {"effort=\"10\"", "effort=\"-infinite\"", 17, "urdf.number", "'-infinite'"},
    {"<limit lower=\"-1\" upper=\"1.5\" effort=\"10\" velocity=\"5\"/>", "", 13,
     "urdf.limits-missing", "'joint1'"},
    {"damping=\"0.1\"", "damping=\"-0.1\"", 18, "robot.negative", "damping is -0.1"},
    {"friction=\"0.2\"", "friction=\"-0.2\"", 18, "robot.negative", "friction is -0.2"},
    {"<axis", "<twinarm armature=\"-1\"/><axis", 16, "robot.negative", "armature is -1"},
    {"<axis", "<twinarm coulomb_minus=\"-1\"/><axis", 16, "robot.negative", "coulomb_minus is -1"},
    {"<axis", "<twinarm type=\"screw\"/><axis", 16, "urdf.pitch-missing", "'joint1'"},
    {"<axis", "<twinarm type=\"screw\" pitch=\"x\"/><axis", 16, "urdf.number", "'x'"},
    {"<axis", "<twinarm type=\"ball\"/><axis", 16, "urdf.joint-type", "'ball'"},
    {"<axis", "<twinarm type=\"prismatic\"/><axis", 16, "urdf.joint-type", "'prismatic'"},
    {"<axis", "<twinarm armature=\"heavy\"/><axis", 16, "urdf.number", "'heavy'"},
    {"<axis", "<mimic joint=\"x\"/><axis", 16, "robot.mimic-unknown", "'x'"},
    {"<axis", "<mimic joint=\"joint1\"/><axis", 16, "robot.mimic-itself", "'joint1'"},
    {"<axis", "<mimic/><axis", 16, "urdf.attribute-missing", "<mimic joint="},
    {"<axis", "<origin quat_xyzw=\"0 0 0 0\"/><axis", 16, "urdf.number", "quat_xyzw"},
    {"<axis", "<origin rpy=\"0 0 0\" quat_xyzw=\"0 0 0 1\"/><axis", 16, "urdf.two-rotations",
     "quat_xyzw"},
    {"<axis", "<origin/><origin/><axis", 16, "urdf.twice", "<origin>"},
    {"<mass value", "<mass value=\"1\"/><mass value", 6, "urdf.twice", "<mass>"},
    {"<axis", "<axis xyz=\"1 0 0\"/><axis", 16, "urdf.twice", "<axis>"},
    {"<link name=\"base\"/>", "<link name=\"base\"/><xacro:arm/>", 2, "urdf.xacro", "<xacro:arm>"},
    {"<link name=\"base\"/>", "<link name=\"base\"/><link name=\"lone\"/>", 2, "robot.two-roots",
     "'lone'"},
};

TEST_CASE("a spoilt line of a URDF gives one fault, with file, line, rule and remedy") {
  const TemporaryFolder folder;
  for (const Spoilt& spoilt : kOneLine) {
    INFO(spoilt.from, " -> ", spoilt.to);
    const fs::path file = folder.write("arm.urdf", replaced(kGoodArm, spoilt.from, spoilt.to));
    const std::vector<Fault> faults = faults_of([&] { read_urdf(file); });
    INFO(listing(faults));
    CHECK(tells(faults, spoilt.line, spoilt.code, spoilt.value));
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
  CHECK(tells(mismatched, 4, "urdf.xml", ""));  // the element that is not closed
  CHECK(faults_in(replaced(kGoodArm, "</robot>", "")).size() == 1);
  CHECK(faults_in("").size() == 1);
  CHECK(faults_in("no xml at all").size() == 1);
  CHECK(tells(faults_in("<sdf/>"), 1, "urdf.no-robot", "<sdf>"));
  CHECK(tells(faults_in("<robot name=\"r\"/>"), 0, "robot.empty", "'r'"));
  CHECK(tells(faults_in("<!-- nothing but words -->"), 0, "urdf.no-robot", ""));
}

TEST_CASE("a missing file, or a folder in its place, is a fault with its name") {
  const TemporaryFolder folder;
  const auto faults = faults_of([&] { read_urdf(folder.path() / "none.urdf"); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].code == "file.missing");
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
    CHECK(tells(faults, 6, "robot.loop", "a -> b -> c -> a"));
  }
  SUBCASE("a joint from a link to itself, and no root at all") {
    const auto faults = faults_in(tree({"a"}, {{{"j1", "a", "a"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 3, "robot.loop", "a -> a"));
  }
  SUBCASE("a branch that hangs on a loop does not tell it again") {
    const auto faults = faults_in(
        tree({"r", "a", "b", "c"}, {{{"j0", "b", "c"}, {"j1", "a", "b"}, {"j2", "b", "a"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 7, "robot.loop", "'j1'"));
  }
  SUBCASE("two parents") {
    const auto faults =
        faults_in(tree({"r", "a", "b"}, {{{"j1", "r", "a"}, {"j2", "r", "b"}, {"j3", "a", "b"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 7, "robot.two-parents", "'b'"));
  }
  SUBCASE("three roots") {
    const auto faults = faults_in(tree({"r", "s", "t"}, {}));
    CHECK(faults.size() == 2);
    CHECK(tells(faults, 3, "robot.two-roots", "'s'"));
    CHECK(tells(faults, 4, "robot.two-roots", "'t'"));
  }
  SUBCASE("two joints of one name") {
    const auto faults = faults_in(tree({"r", "a", "b"}, {{{"j", "r", "a"}, {"j", "r", "b"}}}));
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 6, "robot.name-taken", "'j'"));
  }
}

}  // namespace
}  // namespace twinarm
