// Reads a robot in URDF: XML -> RobotDescription -> robot_check.h.
#include "collision/import/urdf/urdf.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <utility>

#include "collision/import/robot/robot_check.h"
#include "collision/import/urdf/urdf_parts.h"
#include "collision/import/urdf/urdf_xml.h"

namespace twinarm {

using tinyxml2::XMLElement;

namespace {

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

void read_inertial(const XMLElement& element, const std::string& where, LinkDescription& link,
                   UrdfSource& source) {
  link.has_inertia = true;
  const bool incomplete = source.options().incomplete_inertia;
  link.mass = incomplete ? 0 : 1;  // defaults for missing or invalid values
  if (!incomplete) link.inertia = Matrix3::Identity();
  for (const char* name : {"mass", "inertia"}) source.at_most_one(element, name, where);
  const Origin origin = source.origin(element, where);
  link.com = origin.xyz;
  if (const XMLElement* mass = element.FirstChildElement("mass")) {
    link.mass_line = mass->GetLineNum();
    link.mass = source.number(*mass, "value", where).value_or(1.0);
  } else {
    const UrdfSource::ErrorsAsWarnings warns(source, incomplete);
    source.fault(element.GetLineNum(), where, "<inertial> has no <mass>",
                 "give <mass value=\"...\"/> in kg", "urdf.mass-missing");
  }

  const XMLElement* inertia = element.FirstChildElement("inertia");
  if (!inertia) {
    const UrdfSource::ErrorsAsWarnings warns(source, incomplete);
    source.fault(element.GetLineNum(), where, "<inertial> has no <inertia>",
                 "give <inertia ixx ixy ixz iyy iyz izz/> about the centre of mass",
                 "urdf.inertia-missing");
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
  if (!origin.rpy.isZero(0.0)) {  // into link axes, exactly symmetric
    const Matrix3 R = origin.pose().R;
    const Matrix3 rotated = R * link.inertia * R.transpose();
    link.inertia = 0.5 * (rotated + rotated.transpose());
  }
}

LinkDescription read_link(const XMLElement& element, const UrdfMaterials& materials,
                          UrdfSource& source) {
  LinkDescription link;
  link.line = element.GetLineNum();
  if (const char* name = element.Attribute("name")) link.name = name;
  const std::string where = "link '" + link.name + "'";
  source.at_most_one(element, "inertial", where);
  if (const XMLElement* inertial = element.FirstChildElement("inertial"))
    read_inertial(*inertial, where, link, source);
  read_shapes(element, materials, link, source);
  return link;
}

// The <robot> element; throws InputError if there is none.
const XMLElement& open_robot(tinyxml2::XMLDocument& document, UrdfSource& source) {
  constexpr std::uintmax_t kMaxBytes = 16u << 20;
  std::error_code ignored;
  const XMLElement* robot = nullptr;
  if (!std::filesystem::is_regular_file(source.file(), ignored)) {
    source.fault(0, "", "the file does not exist", "check the path", "file.missing");
  } else if (std::filesystem::file_size(source.file(), ignored) > kMaxBytes) {
    source.fault(0, "", "the file is larger than 16 MiB",
                 "give a URDF file; store meshes separately", "file.too-large");
  } else if (document.LoadFile(source.file().c_str()) != tinyxml2::XML_SUCCESS) {
    // If an end tag is missing, tinyxml2 gives the line of the start tag.
    const bool may_be_open = document.ErrorID() == tinyxml2::XML_ERROR_PARSING ||
                             document.ErrorID() == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT;
    source.fault(document.ErrorLineNum(), "", "not well-formed XML: " + xml_error_text(document),
                 may_be_open ? "correct the XML near this line, or close the element that begins "
                               "here (is there a </robot> at the end?)"
                             : "correct the XML at or shortly before this line",
                 "urdf.xml");
  } else {
    robot = document.RootElement();
    if (robot && std::string(robot->Name()) != "robot") {
      source.fault(robot->GetLineNum(), "",
                   std::string("the root element is <") + robot->Name() + ">, must be <robot>",
                   "give a URDF file", "urdf.no-robot");
    } else if (!robot) {
      source.fault(0, "", "there is no <robot> element", "give a URDF file", "urdf.no-robot");
    }
  }
  source.check();
  return *robot;
}

}  // namespace

RobotDescription read_urdf(const std::filesystem::path& file, const RobotFileOptions& options) {
  UrdfSource source(file, options);
  tinyxml2::XMLDocument document;
  const XMLElement& element = open_robot(document, source);
  check_vocabulary(element, source);

  RobotDescription robot;
  robot.file = source.file();
  robot.name = source.text(element, "name", "robot");
  const UrdfMaterials materials = read_materials(element, source);
  for (const XMLElement* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
    constexpr std::size_t kMaxParts = 40000;
    if (robot.links.size() + robot.joints.size() == kMaxParts) {
      source.fault(e->GetLineNum(), "", "there are more than 40,000 links and joints",
                   "merge links that do not move relative to each other", "urdf.too-many");
      source.check();
    }
    const std::string name = e->Name();
    if (name == "link") robot.links.push_back(read_link(*e, materials, source));
    if (name == "joint") robot.joints.push_back(read_joint(*e, source));
  }
  RobotCheck check = check_robot(robot, options.strict);
  source.fault(std::move(check.faults));
  source.warn(std::move(check.warnings));
  source.check();
  robot.root = find_root(robot);
  robot.warnings = source.warnings();
  return robot;
}

}  // namespace twinarm
