// The <joint> of a URDF.
#pragma once

#include "collision/import/robot/robot_description.h"
#include "collision/import/urdf/urdf_xml.h"

namespace twinarm {

JointDescription read_joint(const tinyxml2::XMLElement& element, UrdfSource& source);

}  // namespace twinarm
