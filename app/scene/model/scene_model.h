// A scene as the physics has it: one model that holds all robots and bodies, the state at the
// start, and lists of what touches, what moves by itself, what is coupled and what is constrained.
//
// Bodies of the model: first the links of the robots, in the order of the scene, then the bodies
// that are not fixed. A free body stands on a free joint, whose frame is the user's body frame (a
// centre of mass elsewhere is in the inertia); one of prescribed motion on a prescribed joint.
// Fixed obstacles are geometry of body 0, the world.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/read/scene_description.h"
#include "collision/import/robot/robot_model.h"
#include "collision/shapes/shape.h"
#include "coupling/target/target_robot.h"
#include "solver/integration/integration_state.h"
#include "solver/model/model.h"

namespace twinarm {

struct SceneGeometry : Surface {
  std::string name;  // of the link or body that it belongs to, as in samples
  int body = 0;      // of the model
  Pose X_LG;         // in the link's frame; of a fixed obstacle in the world
  ShapeDescription shape;
  int group = 0;
};

// Takes the place of what the surfaces of a pair give.
struct PairOverride {
  std::vector<int> a, b;  // geometries, ascending
  std::optional<double> friction, restitution, stiffness, dissipation;
};

struct SceneMotion {
  int body = 0;  // on a prescribed joint
  MotionFunction law;
};

// One pull of a coupling. A coupling in six dimensions is two of them, NAME/force and NAME/couple;
// a god object one for each joint, NAME/JOINT. Each is drawn, recorded and booked by itself: its
// `name`, and the `type` by which it acts, are the pull's.
struct SceneCoupling : CouplingTraits {
  std::string coupling;         // its name
  std::size_t description = 0;  // of its coupling, in SceneDescription::couplings
  std::size_t leader = 0;       // the first pull of the same coupling, in SceneModel::couplings
  Spring spring;                // with the gains of this pull
  std::vector<Spring> springs;  // of the leader: all of the coupling's
  // The kinematic side: a second copy of the whole model, of which the hand moves joints of this
  // robot; the others stand as in `rest`.
  CouplingTarget::Kind target = CouplingTarget::Kind::start;
  std::size_t robot = 0;
  State<double> rest;
  DrivenJoints driven;  // joints of the model that the hand moves
  std::filesystem::path trace;
  unsigned seed = 1;     // of a synthetic hand
  double duration = 20;  // likewise [s]

  bool leads() const { return !springs.empty(); }
  // Of its readings, which one this pull is (coupling/laws/coupling.h).
  std::size_t reading(std::size_t index) const { return index - leader; }
  // It acts from outside: on the link alone, and not through joints.
  bool is_external() const {
    return law != CouplingSpec::Type::matched &&
           (type == CouplingDescription::Type::linear || measure == SpringSpace::world);
  }
  // It belongs to the semi-implicit step: its treatment, or the law itself, sees the step's end.
  bool needs_semi_implicit() const;
  // What it does besides a spring and a damper at the ends of the step: the ledger's third row.
  enum class ThirdRow { none, implicit, as_printed, drive };
  ThirdRow third_row() const;
};

// The frames C of both coincide at the start: origin at the point, z along the axis.
struct SceneConstraint {
  using Type = ConstraintDescription::Type;
  std::string name;
  int line = 0;
  Type type = Type::weld;
  int a = 0, b = 0;                // bodies; of a gear those that the joints carry
  Pose X_AC, X_BC;                 // in link axes; a distance goes between the origins of the two
  double length = 0;               // of a distance, as at the start [m]
  std::size_t iv_a = 0, iv_b = 0;  // of a gear: velocities
  double ratio = 1, offset = 0;    // of a gear: q of a's joint = ratio * (q of b's) + offset
};

struct SceneModel {
  SceneDescription description;
  Model<double> model;
  State<double> start;
  int robot_bodies = 0;  // bodies 1 .. robot_bodies are links of robots
  std::vector<SceneGeometry> geometries;
  // Pairs of geometries (a < b, ascending) that never touch: of one rigid piece, neighbours in a
  // robot, neither of them moved by forces, held together by a constraint, of one group, or so told
  // by [[pair]].
  std::vector<std::pair<int, int>> apart;
  std::vector<PairOverride> pairs;  // the last that fits counts
  std::vector<SceneMotion> motions;
  std::vector<SceneCoupling> couplings;
  std::vector<SceneConstraint> constraints;

  // The first and the last of its bodies.
  std::pair<int, int> bodies_of_robot(std::size_t robot) const;
  // Whether any two geometries may touch.
  bool may_touch() const;
  // Of two geometries: geometric mean of frictions, product of restitutions, the larger of the
  // torsional and rolling ones, springs in series, unless a rule says otherwise.
  Surface surface_of_pair(int a, int b) const;
};

// Joints that a hand turns, by name: the robot's first three of one degree of freedom.
std::vector<std::string> turned_joints(const SceneModel& scene, std::size_t robot);

// What contacts know of it. Throws InputError for a mesh that cannot be read or spans no volume,
// and for a shape that contacts do not know.
Shape collision_shape(const ShapeDescription& shape);

// `friction` and `armature` of the options count: false leaves them out of all robots. Throws
// InputError with all faults that reading could not see: meshes without inside, joints that carry
// no inertia.
SceneModel build_scene(const SceneDescription& description, const ModelOptions& options = {});

}  // namespace twinarm
