// A scene for simulation: one model with all robots and bodies, the start state, and lists of
// geometries, prescribed motions, couplings and constraints.
//
// Bodies of the model: the links of the robots, in the order of the scene, then the bodies that are
// not fixed. A free body has a free joint, whose frame is the user's body frame; a body with
// prescribed motion has a prescribed joint. Fixed bodies are geometry of body 0, the world.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/read/scene_description.h"
#include "collision/import/robot/robot_model.h"
#include "coupling/target/target_robot.h"
#include "solver/forces/point_springs.h"
#include "solver/integration/integration_state.h"
#include "solver/model/model.h"

namespace twinarm {

struct SceneGeometry : ContactSurface {
  std::string name;  // of its link or body, as in the output
  int body = 0;      // of the model
  Pose X_LG;         // in the link frame; of a fixed body in the world
  ShapeDescription shape;
  int group = 0;
  int robot = -1;  // index in SceneDescription::robots; -1: of a body
};

struct SceneMotion {
  int body = 0;  // on a prescribed joint
  MotionFunction law;
};

// One component of a coupling: a force or a torque. Couplings in six directions have two,
// NAME/force and NAME/couple; a god object has one per joint, NAME/JOINT. `name` and `type` are
// those of the component, with its own row in output and energy balance.
struct SceneCoupling : CouplingTraits {
  std::string coupling;             // name of the coupling
  std::size_t description = 0;      // index in SceneDescription::couplings
  std::size_t first_component = 0;  // index of the first component of the coupling
  Spring spring;                    // with the gains of this component
  std::vector<Spring> springs;      // of the whole coupling; only in the first component
  // The target: a copy of the whole model in which the operator motion moves joints of this robot;
  // the others are as in `rest`.
  CouplingTarget target;
  std::size_t robot = 0;
  State<double> rest;
  DrivenJoints driven;  // joints that the operator motion moves

  // Its operator motion is that of `other`, of the same robot.
  bool has_motion_of(const SceneCoupling& other) const;
  bool is_first_component() const { return !springs.empty(); }
  // Index of this component, number `index`, in Coupling::readings().
  std::size_t reading(std::size_t index) const { return index - first_component; }
  // Acts on the link from outside, not as a joint force.
  bool is_external() const {
    return law != CouplingSpec::Type::equivalent_torsional && !at_joint();
  }
  // Discretization or law use the end of a semi-implicit step.
  bool needs_semi_implicit() const;
  // Row of the energy balance for work other than that of spring and damper.
  enum class ThirdRow { none, implicit, as_printed, drive };
  ThirdRow third_row() const;
};

// The frames C of both coincide at the start: origin at the point, z along the axis.
struct SceneConstraint {
  using Type = ConstraintDescription::Type;
  std::string name;
  int line = 0;
  Type type = Type::weld;
  int a = 0, b = 0;              // bodies; gear: children of the joints; motion: of joint a
  Pose X_AC, X_BC;               // link axes; distance: between the origins of both
  double length = 0;             // distance, at the start [m]
  double ratio = 1, offset = 0;  // gear: q_a = ratio q_b + offset
  std::optional<ExpressionTape> motion;
};

struct SceneModel {
  SceneDescription description;
  Model<double> model;
  State<double> start;
  int robot_bodies = 0;  // bodies 1 .. robot_bodies are links of robots
  std::vector<SceneGeometry> geometries;
  std::map<std::pair<int, int>, PairOverride> pairs;  // by geometries a < b
  std::vector<int> roots;  // by body: root of its rigid body, the nearest ancestor not on a fixed
                           // joint (or itself), or the world
  std::set<std::pair<int, int>> joined;  // roots a < b joined by constraints
  std::vector<SceneMotion> motions;
  std::vector<SceneCoupling> couplings;
  std::vector<SceneConstraint> constraints;
  std::vector<PointSpring> springs;

  std::pair<int, int> bodies_of_robot(std::size_t robot) const;  // the first and the last
  // Whether a pair of geometries has no contacts: of one rigid body, neighbours in a robot, both
  // immovable, joined by a constraint, of one group, or excluded by [[pair]].
  bool is_apart(int a, int b) const;
  bool may_touch() const;  // whether any pair of geometries can have contacts
  // Geometric mean of frictions, product of restitutions, maximum of torsional and rolling
  // friction, springs in series; then overrides.
  ContactSurface surface_of_pair(int a, int b) const;
};

// Joints that an operator motion moves: the robot's first three with one degree of freedom.
std::vector<std::string> turned_joints(const SceneModel& scene, std::size_t robot);

// Centre of mass, link axes; zero without mass.
Vector3 com_of_link(const Model<double>& model, std::size_t body);

// Of the options `friction` and `armature` are used. Throws InputError with all diagnostics, such
// as meshes without volume and joints without inertia.
SceneModel build_scene(const SceneDescription& description, const ModelOptions& options = {});

}  // namespace twinarm
