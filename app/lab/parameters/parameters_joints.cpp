// Parameters of joints of one degree of freedom: position at the start, damping, constant torque.

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

struct Group {
  const char *key, *name;           // of [[robot]], a table by joint; of the page
  const char *unit, *turning_unit;  // prismatic, revolute
  bool is_folded;
};

// row_of(joint, its child body): the slider and the value.
template <class Row>
void add_group(const SceneModel& model, std::size_t robot, const Group& group, Row row_of,
               std::vector<LabParameter>& parameters) {
  const RobotInScene& of = model.description.robots[robot];
  if (of.description.joints.size() > kManyLinks) return;
  for (const JointDescription& joint : of.description.joints) {
    const int body = model.model.find_joint(name_in_scene(model.description, robot, joint.name));
    if (body < 0 || joint.dofs() != 1 || joint.mimic || !is_path_part(joint.name)) continue;
    const bool slides = joint.type == JointDescription::Type::prismatic;
    const auto [row, value] = row_of(joint, static_cast<std::size_t>(body));
    parameters.push_back(slider(item("robot", robot, group.key) + "." + joint.name, row, value,
                                slides ? group.unit : group.turning_unit,
                                of.name + ": " + group.name));
    parameters.back().is_folded = group.is_folded;
  }
}

}  // namespace

void add_joints(const SceneModel& model, std::vector<LabParameter>& parameters) {
  using Row = std::pair<SliderRow, double>;
  const SceneDescription& scene = model.description;
  const bool is_alone =
      scene.couplings.empty() && scene.constraints.empty() && scene.springs.empty();
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    const auto add = [&](const Group& group, auto row_of) {
      add_group(model, r, group, row_of, parameters);
    };
    add({"q", "start pose", "m", "rad", !is_alone}, [&](const auto& joint, std::size_t body) {
      const auto [low, high] = range_of(joint);
      return Row{{joint.name.c_str(), low, high, "Joint position at the start: the run restarts.",
                  SliderRow::linear},
                 model.start.q[model.model.iq[body]]};
    });
    add({"torque", "torques", "N", "N m", true}, [&](const auto& joint, std::size_t) {
      const double max = joint.effort > 0 && std::isfinite(joint.effort) ? joint.effort : 10;
      const JointValueMap& all = scene.robots[r].torque;
      const auto given = all.find(joint.name);
      return Row{{joint.name.c_str(), -max, max, "Constant joint force.", SliderRow::linear},
                 given == all.end() ? 0 : given->second.values[0]};
    });
    add({"damping", "damping", "N s/m", "N m s/rad", true}, [](const auto& joint, std::size_t) {
      return Row{{joint.name.c_str(), 0, std::max(10.0, 2 * joint.damping),
                  "Viscous damping of the joint.", SliderRow::linear},
                 joint.damping};
    });
  }
}

}  // namespace twinarm::parameter_makers
