// The parts of the URDF reader: vocabulary, <joint>, and what a <link> shows and collides with.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "collision/import/robot/robot_description.h"
#include "collision/import/urdf/urdf_xml.h"

namespace twinarm {

// Which elements and attributes URDF has, so that nothing is left out in silence. Goes through the
// whole file. What other programs need and what has no effect here, and what nobody knows (a slip
// of the pen?), becomes one warning per kind; what a macro should have replaced (xacro) is a fault.
// Bounded in depth: what is not known is not entered.
void check_vocabulary(const tinyxml2::XMLElement& robot, UrdfSource& source);

JointDescription read_joint(const tinyxml2::XMLElement& element, UrdfSource& source);

struct UrdfMaterial {
  Vector4 color = VisualPart().color;
  std::string texture_name;
  std::filesystem::path texture;
};
using UrdfMaterials = std::map<std::string, UrdfMaterial>;

// Every <material> of the file that states a colour or a texture: those of the robot, then those
// that a <visual> states in passing and others use by name. Of two with one name the first counts.
UrdfMaterials read_materials(const tinyxml2::XMLElement& robot, UrdfSource& source);

void read_shapes(const tinyxml2::XMLElement& link_element, const UrdfMaterials& materials,
                 LinkDescription& link, UrdfSource& source);

}  // namespace twinarm
