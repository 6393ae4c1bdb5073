// The scene of the study as a DrawList: the DVR solid, the KVR as a ghost, the springs between
// them, an obstacle. One RobotScene registers the robot's meshes once.
#pragma once

#include <vector>

#include "app/render/list/draw_list.h"
#include "app/study/study_robot.h"
#include "coupling/laws/coupling.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {

class RobotScene {
 public:
  // Loads the visual meshes of the description; the model says where each link is.
  RobotScene(const RobotDescription& description, const Model<double>& model);

  void clear() { list_.clear_frame(); }
  void add_robot(const Kinematics& k);  // solid, in its own colours
  void add_ghost(const Kinematics& k);  // translucent
  void add_springs(const std::vector<SpringReading>& readings, const std::string& unit);
  void add_couples(const std::vector<SpringReading>& readings);  // arrows along the couples
  void add_obstacle(const Pose& X_WB, const Vector3& size);
  // Seen from where the whole workspace shows; `azimuth_deg` about z, from the x axis.
  void look(double azimuth_deg, double elevation_deg, double distance, const Vector3& target);
  DrawList& list() { return list_; }

 private:
  struct Part {
    std::size_t body;
    MeshId mesh;
    Pose X_LG;
    Color color;
  };
  DrawList list_;
  std::vector<Part> parts_;
};

}  // namespace twinarm
