// Joint types beyond revolute, the <twinarm> element, limits and mimic joints of a URDF.
#include <limits>
#include <string>

#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

// The valid arm with another joint type and elements before its <axis> (line 16).
RobotDescription with_joint(const std::string& type, const std::string& inside = "") {
  const TemporaryFolder folder;
  std::string text = replaced(kGoodArm, "type=\"revolute\"", "type=\"" + type + "\"");
  if (!inside.empty()) text = replaced(text, "<axis", inside + "<axis");
  return read_urdf(folder.write("arm.urdf", text));
}

TEST_CASE("every joint type is read, those beyond URDF by <twinarm type>") {
  struct Case {
    const char* urdf;
    const char* extension;
    Type type;
    int dofs;
    bool has_axis;
  };
  const Case cases[] = {{"fixed", "", Type::fixed, 0, false},
                        {"revolute", "", Type::revolute, 1, true},
                        {"continuous", "", Type::continuous, 1, true},
                        {"prismatic", "", Type::prismatic, 1, true},
                        {"floating", "", Type::floating, 6, false},
                        {"planar", "", Type::planar, 3, true},
                        {"floating", "spherical", Type::spherical, 3, false},
                        {"continuous", "spherical", Type::spherical, 3, false},
                        {"revolute", "screw", Type::screw, 1, true},
                        {"prismatic", "cylindrical", Type::cylindrical, 2, true},
                        {"fixed", "universal", Type::universal, 2, true},
                        {"planar", "planar", Type::planar, 3, true}};
  for (const Case& c : cases) {
    INFO(c.urdf, " ", c.extension);
    const std::string extension = c.extension;
    const std::string element = "<twinarm type=\"" + extension + "\"" +
                                (c.type == Type::screw ? " pitch=\"0.01\"/>" : "/>");
    const JointDescription joint = with_joint(c.urdf, extension.empty() ? "" : element).joints[0];
    CHECK(joint.type == c.type);
    CHECK(joint.dofs() == c.dofs);
    CHECK(joint.has_axis() == c.has_axis);
  }
}

TEST_CASE("the pitch of a screw is kept in metres per revolution, of either sign") {
  for (const double pitch : {0.002, -0.25}) {
    std::ostringstream element;
    element << "<twinarm type=\"screw\" pitch=\"" << pitch << "\"/>";
    CHECK(with_joint("revolute", element.str()).joints[0].pitch == pitch);
  }
}

TEST_CASE("a screw has limits if <limit> has a range") {
  const std::string screw = "<twinarm type=\"screw\" pitch=\"0.01\"/>";
  const JointDescription joint = with_joint("continuous", screw).joints[0];
  CHECK(joint.is_limited());
  CHECK(joint.lower == -1);
  CHECK(joint.upper == 1.5);

  const TemporaryFolder folder;
  const std::string limit = "<limit lower=\"-1\" upper=\"1.5\" effort=\"10\" velocity=\"5\"/>";
  const std::string text = replaced(kGoodArm, "<axis", screw + "<axis");
  CHECK(!read_urdf(folder.write("a.urdf", replaced(text, limit, ""))).joints[0].is_limited());
}

TEST_CASE("limits may be infinite") {
  const TemporaryFolder folder;
  std::string text = replaced(kGoodArm, "lower=\"-1\"", "lower=\"-inf\"");
  text = replaced(text, "effort=\"10\"", "effort=\"Inf\"");
  const JointDescription joint = read_urdf(folder.write("arm.urdf", text)).joints[0];
  CHECK(joint.lower == -std::numeric_limits<double>::infinity());
  CHECK(joint.upper == 1.5);
  CHECK(joint.effort == std::numeric_limits<double>::infinity());
}

// Line 1 is <robot>, then a base and one massive link for each joint (line 2), then the joints, one
// per line: name, type, child elements.
std::string chain(const std::vector<std::array<std::string, 3>>& joints) {
  std::string links = "<link name=\"0\"/>", lines;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    links += "<link name=\"" + std::to_string(k + 1) +
             "\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" "
             "iyz=\"0\" izz=\"1\"/></inertial></link>";
    lines += "<joint name=\"" + joints[k][0] + "\" type=\"" + joints[k][1] + "\"><parent link=\"" +
             std::to_string(k) + "\"/><child link=\"" + std::to_string(k + 1) + "\"/>" +
             joints[k][2] + "</joint>\n";
  }
  return "<robot name=\"chain\">\n" + links + "\n" + lines + "</robot>\n";
}

TEST_CASE("mimic joints and their chains are kept; multiplier and offset default to 1 and 0") {
  const TemporaryFolder folder;
  const RobotDescription robot = read_urdf(folder.write(
      "a.urdf",
      chain({{{"a", "continuous", ""},
              {"b", "continuous", "<mimic joint=\"a\" multiplier=\"-2\" offset=\"0.5\"/>"},
              {"c", "continuous", "<mimic joint=\"b\"/>"}}})));
  CHECK(!robot.joints[0].mimic);
  REQUIRE(robot.joints[1].mimic);
  CHECK(robot.joints[1].mimic->joint == "a");
  CHECK(robot.joints[1].mimic->multiplier == -2);
  CHECK(robot.joints[1].mimic->offset == 0.5);
  REQUIRE(robot.joints[2].mimic);
  CHECK(robot.joints[2].mimic->joint == "b");
  CHECK(robot.joints[2].mimic->multiplier == 1);
  CHECK(robot.joints[2].mimic->offset == 0);
  CHECK(robot.warnings.empty());
}

}  // namespace
}  // namespace twinarm
