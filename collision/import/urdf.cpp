// Reads a robot in URDF: XML -> RobotDescription, then the rules of robot_check.h.
#include "collision/import/urdf.h"

#include <tinyxml2.h>

#include <algorithm>

#include "collision/import/number_text.h"
#include "collision/import/robot_check.h"
#include "collision/import/urdf_shapes.h"
#include "collision/import/urdf_xml.h"

namespace twinarm {

using tinyxml2::XMLElement;

namespace {

using Type = JointDescription::Type;

// "XML_ERROR_MISMATCHED_ELEMENT" -> "mismatched element"
std::string xml_error_text(const tinyxml2::XMLDocument& document) {
  std::string text = document.ErrorName();
  for (const char* prefix : {"XML_ERROR_", "XML_"})
    if (text.starts_with(prefix)) text.erase(0, std::string(prefix).size());
  std::replace(text.begin(), text.end(), '_', ' ');
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// More than one of what there can be only one of: which would count?
void at_most_one(const XMLElement& parent, const char* name, const std::string& where,
                 UrdfSource& source) {
  const XMLElement* first = parent.FirstChildElement(name);
  const XMLElement* second = first ? first->NextSiblingElement(name) : nullptr;
  if (second)
    source.fault(second->GetLineNum(), where, std::string("a second <") + name + ">",
                 std::string("give one <") + name + ">");
}

void read_inertial(const XMLElement& element, const std::string& where, LinkDescription& link,
                   UrdfSource& source) {
  link.has_inertia = true;
  link.mass = 1;  // harmless values, in place of those that are missing or no numbers
  link.inertia = Matrix3::Identity();
  const Origin origin = source.origin(element, where);
  link.com = origin.xyz;
  if (const XMLElement* mass = element.FirstChildElement("mass")) {
    link.mass_line = mass->GetLineNum();
    link.mass = source.number(*mass, "value", where).value_or(1.0);
  } else {
    source.fault(element.GetLineNum(), where, "<inertial> has no <mass>",
                 "give <mass value=\"...\"/> in kg");
  }

  const XMLElement* inertia = element.FirstChildElement("inertia");
  if (!inertia) {
    source.fault(element.GetLineNum(), where, "<inertial> has no <inertia>",
                 "give <inertia ixx ixy ixz iyy iyz izz/> about the centre of mass");
    return;
  }
  link.inertia_line = inertia->GetLineNum();
  const char* names[] = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
  double I[6];
  bool all_read = true;
  for (int k = 0; k < 6; ++k) {
    const auto value = source.number(*inertia, names[k], where);
    all_read = all_read && value.has_value();
    I[k] = value.value_or(0.0);
  }
  if (!all_read) return;
  link.inertia << I[0], I[1], I[2], I[1], I[3], I[4], I[2], I[4], I[5];
  if (!origin.rpy.isZero(0.0)) {  // into link axes; kept symmetric to the last bit
    const Matrix3 R = origin.pose().R;
    const Matrix3 turned = R * link.inertia * R.transpose();
    link.inertia = 0.5 * (turned + turned.transpose());
  }
}

LinkDescription read_link(const XMLElement& element, const MaterialColors& materials,
                          UrdfSource& source) {
  LinkDescription link;
  link.line = element.GetLineNum();
  if (const char* name = element.Attribute("name")) link.name = name;
  const std::string where = "link '" + link.name + "'";
  at_most_one(element, "inertial", where, source);
  if (const XMLElement* inertial = element.FirstChildElement("inertial"))
    read_inertial(*inertial, where, link, source);
  read_shapes(element, materials, link, source);
  return link;
}

void read_type(const XMLElement& element, const std::string& where, JointDescription& joint,
               UrdfSource& source) {
  std::string type = source.text(element, "type", where);
  // Joints that URDF lacks come by an extension element, which names the true type.
  const XMLElement* extension = element.FirstChildElement("twinarm");
  if (extension && extension->Attribute("type")) type = extension->Attribute("type");
  if (!type.empty() && !joint_type_from(type, joint.type))
    source.fault(element.GetLineNum(), where, "joint type '" + type + "' is not supported",
                 kSupportedJoints);
  if (const XMLElement* mimic = element.FirstChildElement("mimic"))
    source.fault(mimic->GetLineNum(), where, "<mimic> is not supported",
                 "leave it out: the joint is then free");
}

void read_limits(const XMLElement& element, const std::string& where, JointDescription& joint,
                 UrdfSource& source) {
  const XMLElement* limit = element.FirstChildElement("limit");
  if (limit) {
    joint.effort = source.number(*limit, "effort", where, 0.0).value_or(0.0);
    joint.velocity = source.number(*limit, "velocity", where, 0.0).value_or(0.0);
  }
  if (!joint.is_limited()) return;
  if (!limit || (!limit->FindAttribute("lower") && !limit->FindAttribute("upper"))) {
    source.fault((limit ? limit : &element)->GetLineNum(), where,
                 std::string("a ") + to_string(joint.type) + " joint must have limits",
                 joint.type == Type::revolute
                     ? "give <limit lower upper effort velocity/>, or make the joint continuous"
                     : "give <limit lower upper effort velocity/> in metres");
    return;
  }
  const auto lower = source.number(*limit, "lower", where, 0.0);
  const auto upper = source.number(*limit, "upper", where, 0.0);
  if (lower && upper) {
    joint.lower = *lower;
    joint.upper = *upper;
  }
}

// Unit length; an axis that has it already keeps its bits.
Vector3 unit_axis(const Vector3& axis) {
  const double length = axis.norm();
  return length < 1e-9 || std::abs(length - 1) < 1e-15 ? axis : Vector3(axis / length);
}

JointDescription read_joint(const XMLElement& element, UrdfSource& source) {
  JointDescription joint;
  joint.line = element.GetLineNum();
  if (const char* name = element.Attribute("name")) joint.name = name;
  const std::string where = "joint '" + joint.name + "'";
  for (const char* name : {"origin", "axis", "limit", "dynamics", "parent", "child", "twinarm"})
    at_most_one(element, name, where, source);
  read_type(element, where, joint, source);
  joint.origin = source.origin(element, where);

  const auto line_of = [&](const char* name) {
    const XMLElement* e = element.FirstChildElement(name);
    return e ? e->GetLineNum() : 0;
  };
  joint.lines = {line_of("parent"), line_of("child"),    line_of("axis"),
                 line_of("limit"),  line_of("dynamics"), line_of("twinarm")};
  const auto link_of = [&](const char* role) {  // what is missing is told by check_robot
    const XMLElement* e = element.FirstChildElement(role);
    const char* link = e ? e->Attribute("link") : nullptr;
    return std::string(link ? link : "");
  };
  joint.parent = link_of("parent");
  joint.child = link_of("child");

  if (const XMLElement* axis = element.FirstChildElement("axis"); axis && joint.has_axis())
    joint.axis = unit_axis(source.vector3(*axis, "xyz", where).value_or(Vector3::UnitX()));
  read_limits(element, where, joint, source);
  if (const XMLElement* dynamics = element.FirstChildElement("dynamics")) {
    joint.damping = source.number(*dynamics, "damping", where, 0.0).value_or(0.0);
    joint.friction = source.number(*dynamics, "friction", where, 0.0).value_or(0.0);
  }
  joint.coulomb_plus = joint.coulomb_minus = joint.friction;
  if (const XMLElement* extra = element.FirstChildElement("twinarm")) {
    const auto take = [&](const char* attribute, double& value) {
      value = source.number(*extra, attribute, where, value).value_or(value);
    };
    take("armature", joint.armature);
    take("coulomb_plus", joint.coulomb_plus);
    take("coulomb_minus", joint.coulomb_minus);
  }
  return joint;
}

// The <robot> element; throws where there is none to go on with.
const XMLElement& open_robot(tinyxml2::XMLDocument& document, UrdfSource& source) {
  std::error_code ignored;
  const XMLElement* robot = nullptr;
  if (!std::filesystem::is_regular_file(source.file(), ignored)) {
    source.fault(0, "", "the file does not exist", "check the path");
  } else if (document.LoadFile(source.file().c_str()) != tinyxml2::XML_SUCCESS) {
    source.fault(document.ErrorLineNum(), "", "not well-formed XML: " + xml_error_text(document),
                 "mend the XML at or shortly before this line");
  } else {
    robot = document.RootElement();
    if (robot && std::string(robot->Name()) != "robot") {
      source.fault(robot->GetLineNum(), "",
                   std::string("the outermost element is <") + robot->Name() + ">, must be <robot>",
                   "give a URDF file");
    } else if (!robot) {
      source.fault(0, "", "there is no <robot> element", "give a URDF file");
    }
  }
  source.check();
  return *robot;
}

}  // namespace

RobotDescription read_urdf(const std::filesystem::path& file) {
  UrdfSource source(file);
  tinyxml2::XMLDocument document;
  const XMLElement& element = open_robot(document, source);

  RobotDescription robot;
  robot.file = source.file();
  robot.name = source.text(element, "name", "robot");
  const MaterialColors materials = read_materials(element, source);
  for (const XMLElement* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const std::string name = e->Name();
    if (name == "link") robot.links.push_back(read_link(*e, materials, source));
    if (name == "joint") robot.joints.push_back(read_joint(*e, source));
    if (name.starts_with("xacro:"))
      source.fault(e->GetLineNum(), "<" + name + ">", "this is a xacro file",
                   "expand it first (xacro robot.urdf.xacro > robot.urdf)");
  }
  source.fault(check_robot(robot));
  source.check();
  robot.root = find_root(robot);
  return robot;
}

}  // namespace twinarm
