// The shapes of a URDF link: what is drawn and what collides.
#pragma once

#include <map>
#include <string>

#include "collision/import/robot_description.h"
#include "collision/import/urdf_xml.h"

namespace twinarm {

using MaterialColors = std::map<std::string, Vector4>;

// Every <material> of the file that states a colour: those of the robot, then those that a <visual>
// states in passing and others use by name. Of two with one name the first counts.
MaterialColors read_materials(const tinyxml2::XMLElement& robot, UrdfSource& source);

void read_shapes(const tinyxml2::XMLElement& link_element, const MaterialColors& materials,
                 LinkDescription& link, UrdfSource& source);

}  // namespace twinarm
