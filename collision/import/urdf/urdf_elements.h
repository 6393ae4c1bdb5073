// Which elements and attributes URDF has, so that nothing is left out in silence.
#pragma once

#include "collision/import/urdf/urdf_xml.h"

namespace twinarm {

// Goes through the whole file. What other programs need and what has no effect here, and what
// nobody knows (a slip of the pen?), becomes one warning per kind; what a macro should have
// replaced (xacro) is a fault. Bounded in depth: what is not known is not entered.
void check_vocabulary(const tinyxml2::XMLElement& robot, UrdfSource& source);

}  // namespace twinarm
