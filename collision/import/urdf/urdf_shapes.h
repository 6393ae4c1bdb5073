// The shapes of a URDF link: what is drawn and what collides.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "collision/import/robot/robot_description.h"
#include "collision/import/urdf/urdf_xml.h"

namespace twinarm {

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
