// Reads a robot in URDF: XML -> RobotDescription -> robot_check.h.
#include "collision/import/urdf/urdf.h"

#include "collision/import/robot/robot_check.h"
#include "collision/import/urdf/urdf_parts.h"
#include "collision/import/urdf/urdf_xml.h"

namespace twinarm {

namespace {

void read_inertial(const XmlElement& element, const std::string& where, LinkDescription& link,
                   UrdfSource& source) {
  link.has_inertia = true;
  const bool incomplete = source.options().incomplete_inertia;
  link.mass = incomplete ? 0 : 1;  // defaults for missing or invalid values
  if (!incomplete) link.inertia = Matrix3::Identity();
  for (const char* name : {"mass", "inertia"}) source.at_most_one(element, name, where);
  const Origin origin = source.origin(element, where);
  link.com = origin.xyz;
  if (const XmlElement* mass = element.child("mass")) {
    link.mass_line = mass->line;
    link.mass = source.number(*mass, "value", where).value_or(1.0);
  } else {
    const UrdfSource::ErrorsAsWarnings warns(source, incomplete);
    source.fault(element.line, where, "<inertial> has no <mass>",
                 "give <mass value=\"...\"/> in kg", "urdf.mass-missing");
  }

  const XmlElement* inertia = element.child("inertia");
  if (!inertia) {
    const UrdfSource::ErrorsAsWarnings warns(source, incomplete);
    source.fault(element.line, where, "<inertial> has no <inertia>",
                 "give <inertia ixx ixy ixz iyy iyz izz/> about the centre of mass",
                 "urdf.inertia-missing");
    return;
  }
  link.inertia_line = inertia->line;
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

LinkDescription read_link(const XmlElement& element, const UrdfMaterials& materials,
                          UrdfSource& source) {
  LinkDescription link;
  link.line = element.line;
  if (const char* name = element.value("name")) link.name = name;
  const std::string where = "link '" + link.name + "'";
  source.at_most_one(element, "inertial", where);
  if (const XmlElement* inertial = element.child("inertial"))
    read_inertial(*inertial, where, link, source);
  read_shapes(element, materials, link, source);
  return link;
}

void check_root(const XmlElement& root, UrdfSource& source) {
  if (root.name == "robot") return;
  source.fault(root.line, "", "the root element is <" + root.name + ">, must be <robot>",
               "give a URDF file", "urdf.no-robot");
  source.check();
}

}  // namespace

RobotDescription read_urdf(const std::filesystem::path& file, const RobotFileOptions& options) {
  UrdfSource source(file, options);
  const XmlElement element = read_xml(source.file());
  check_root(element, source);
  check_vocabulary(element, source);

  RobotDescription robot;
  robot.file = source.file();
  robot.name = source.text(element, "name", "robot");
  const UrdfMaterials materials = read_materials(element, source);
  for (const XmlElement& e : element.children) {
    constexpr std::size_t kMaxParts = 40000;
    if (robot.links.size() + robot.joints.size() == kMaxParts) {
      source.fault(e.line, "", "there are more than 40,000 links and joints",
                   "merge links that do not move relative to each other", "urdf.too-many");
      source.check();
    }
    if (e.name == "link") robot.links.push_back(read_link(e, materials, source));
    if (e.name == "joint") robot.joints.push_back(read_joint(e, source));
  }
  source.add(check_robot(robot, options.strict));
  source.check();
  robot.root = find_root(robot);
  robot.warnings = source.all_warnings();
  return robot;
}

}  // namespace twinarm
