#include "collision/import/formats/robot_formats.h"
#include "collision/import/urdf/urdf.h"

namespace twinarm {

RobotDescription read_robot_file(const std::filesystem::path& file,
                                 const RobotFileOptions& options) {
  for (const RobotFormat& format : robot_formats())
    if (file.extension() == format.extension) return format.read(file, options);
  return read_urdf(file, options);
}

}  // namespace twinarm
