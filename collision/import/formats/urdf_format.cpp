#include "collision/import/formats/robot_formats.h"
#include "collision/import/urdf/urdf.h"

namespace twinarm {

RobotFormat urdf_format() {
  return {".urdf", read_urdf};
}

}  // namespace twinarm
