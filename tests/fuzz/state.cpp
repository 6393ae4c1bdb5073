// A state file, given to a robot that has a joint of each kind, on the world and afloat.
#include "app/robot/robot_input.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

std::string robot_of_all_joints() {
  std::string text = "<robot name=\"all\"><link name=\"base\"/>";
  std::string parent = "base";
  for (const std::string type : {"revolute", "continuous", "prismatic", "floating", "planar",
                                 "spherical", "universal", "cylindrical", "screw", "fixed"}) {
    const bool is_urdf = type[0] == 'r' || type == "continuous" || type == "prismatic" ||
                         type == "floating" || type == "planar" || type == "fixed";
    text += "<link name=\"l_" + type +
            "\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" "
            "ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link><joint name=\"" +
            type + "\" type=\"" +
            (is_urdf               ? type
             : type == "spherical" ? "floating"
                                   : "continuous") +
            "\"><parent link=\"" + parent + "\"/><child link=\"l_" + type + "\"/>" +
            (type == "revolute" || type == "prismatic"
                 ? "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"
                 : "") +
            (is_urdf ? ""
                     : "<twinarm type=\"" + type + "\"" +
                           (type == "screw" ? " pitch=\"0.1\"" : "") + "/>") +
            "</joint>";
    parent = "l_" + type;
  }
  return text + "</robot>";
}

}  // namespace

void state(Bytes bytes) {
  static const std::filesystem::path robot = folder().write("all.urdf", robot_of_all_joints());
  RobotOptions options;
  options.model = robot;
  options.state = folder().write("state.json", bytes);
  for (const bool floating : {false, true}) {
    options.floating = floating;
    goes_through([&] { read_robot_input(options); });
  }
}

}  // namespace twinarm::fuzz
