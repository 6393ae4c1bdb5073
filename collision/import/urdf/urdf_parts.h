// Parts of the URDF reader: known elements, <joint>, materials, shapes of a <link>.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "collision/import/robot/robot_description.h"
#include "collision/import/urdf/urdf_xml.h"

namespace twinarm {

// Reports elements and attributes that have no effect or are unknown (one warning per kind), and
// xacro elements (an error). Unknown elements are not entered, so the depth is bounded.
void check_vocabulary(const XmlElement& robot, UrdfSource& source);

JointDescription read_joint(const XmlElement& element, UrdfSource& source);

struct UrdfMaterial {
  Vector4 color = VisualPart().color;
  std::string texture_name;
  std::filesystem::path texture;
};
using UrdfMaterials = std::map<std::string, UrdfMaterial>;

// All <material> elements with a colour or texture: of the robot, then of the <visual> elements.
// The first of a name counts.
UrdfMaterials read_materials(const XmlElement& robot, UrdfSource& source);

void read_shapes(const XmlElement& link_element, const UrdfMaterials& materials,
                 LinkDescription& link, UrdfSource& source);

}  // namespace twinarm
