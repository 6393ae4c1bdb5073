// Parameters of joints of one degree of freedom: position at the start, damping, constant torque.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/lab/parameters/parameter_makers.h"
#include "app/scene/read/read_scene.h"

namespace twinarm::parameter_makers {
namespace {

// Of the slider: the joint's limits, else half a revolution or a metre each way.
std::pair<double, double> range_of(const JointDescription& joint) {
  const double free = joint.type == JointDescription::Type::prismatic ? 1 : std::numbers::pi;
  if (std::isfinite(joint.lower) && std::isfinite(joint.upper) && joint.lower < joint.upper)
    return {joint.lower, joint.upper};
  return {-free, free};
}

class JointParameters {
 public:
  JointParameters(const SceneModel& model, std::size_t robot, std::vector<LabParameter>& parameters)
      : model_(model), robot_(robot), parameters_(parameters) {}

  // A key of the robot: a table by joint.
  template <class Row>
  void add(const char* key, const char* group, bool is_folded, const char* unit,
           const char* turning_unit, Row row_of) {
    const RobotInScene& robot = model_.description.robots[robot_];
    for (const JointDescription& joint : robot.description.joints) {
      const int body =
          model_.model.find_joint(name_in_scene(model_.description, robot_, joint.name));
      if (body < 0 || joint.dofs() != 1 || joint.mimic || !is_path_part(joint.name)) continue;
      const bool slides = joint.type == JointDescription::Type::prismatic;
      const auto [row, value] = row_of(joint, static_cast<std::size_t>(body));
      parameters_.push_back(slider(item("robot", robot_, key) + "." + joint.name, row, value,
                                   slides ? unit : turning_unit));
      parameters_.back().group = robot.name + ": " + group;
      parameters_.back().is_folded = is_folded;
    }
  }

 private:
  const SceneModel& model_;
  std::size_t robot_;
  std::vector<LabParameter>& parameters_;
};

}  // namespace

void add_joints(const SceneModel& model, std::vector<LabParameter>& parameters) {
  using Row = std::pair<SliderRow, double>;
  const SceneDescription& scene = model.description;
  const bool is_alone = scene.couplings.empty() && scene.constraints.empty();
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    JointParameters joints(model, r, parameters);
    const JointValueMap& torques = scene.robots[r].torque;
    joints.add("q", "start pose", !is_alone, "m", "rad", [&](const auto& joint, std::size_t body) {
      const auto [low, high] = range_of(joint);
      return Row{{joint.name.c_str(), low, high, "Joint position at the start: the run restarts.",
                  SliderRow::linear},
                 model.start.q[model.model.iq[body]]};
    });
    joints.add("torque", "torques", true, "N", "N m", [&](const auto& joint, std::size_t) {
      const double most = joint.effort > 0 && std::isfinite(joint.effort) ? joint.effort : 10;
      const auto given = torques.find(joint.name);
      return Row{{joint.name.c_str(), -most, most, "Constant joint force.", SliderRow::linear},
                 given == torques.end() ? 0 : given->second.values[0]};
    });
    joints.add("damping", "damping", true, "N s/m", "N m s/rad",
               [](const auto& joint, std::size_t) {
                 return Row{{joint.name.c_str(), 0, std::max(10.0, 2 * joint.damping),
                             "Viscous damping of the joint.", SliderRow::linear},
                            joint.damping};
               });
  }
}

}  // namespace twinarm::parameter_makers
