// A scene file as plain data: robots, bodies, couplings, constraints
// (docs/reference/scene_file.md).
//
// SI units, radians; vectors and positions in world axes unless a comment says otherwise. Default
// values are defined here. `line` is that of the item in the file, for diagnostics.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/robot/coordinates.h"
#include "collision/contact/contact_point.h"
#include "collision/import/robot/robot_description.h"
#include "collision/import/robot/robot_model.h"
#include "coupling/laws/coupling_spec.h"
#include "coupling/target/synthetic_operator.h"
#include "solver/expressions/expression_tape.h"
#include "solver/forces/force_source.h"
#include "solver/integration/integrator.h"
#include "solver/loops/loop_closure.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// Prescribed motion, world axes, from the pose X at the start; w = 2 pi frequency:
//   origin       X.p + linear t + amplitude sin(w t)
//   orientation  exp(angular t + swing sin(w t)) X.R, where angular or swing is zero
struct BodyMotion {
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();   // [m/s], [rad/s]
  Vector3 amplitude = Vector3::Zero(), swing = Vector3::Zero();  // [m], [rad]
  double frequency = 0;                                          // [Hz]
};

struct BodyDescription {
  std::string name;
  int line = 0;
  bool fixed = false;
  std::optional<BodyMotion> motion;  // prescribed
  ShapeDescription shape;
  std::optional<double> mass, density;  // exactly one for a free body [kg, kg/m^3]
  std::optional<Vector3> com;           // body axes; default: of the solid shape
  std::optional<Matrix3> inertia;       // about the com, body axes; default: of the solid shape
  Pose X_WB;                            // at the start
  Vector3 linear_velocity = Vector3::Zero();  // of the body's origin
  Vector3 angular_velocity = Vector3::Zero();
  ContactSurface surface;
  std::optional<Vector3> color;   // red, green, blue in [0, 1]; multiplies the texture
  std::filesystem::path texture;  // PNG or JPEG, absolute; may be empty
  int group = 0;                  // bodies of one group other than 0 do not collide

  bool is_free() const { return !fixed && !motion; }
};

struct RobotInScene {
  std::string name;
  int line = 0;
  RobotDescription description;
  bool floating = false;
  std::optional<BodyMotion> motion;  // prescribed, of the root link
  Pose X_WR;                         // of the root link, at the start
  Vector3 linear_velocity = Vector3::Zero(), angular_velocity = Vector3::Zero();  // floating only
  JointValueMap q, qd;
  JointValueMap torque;  // constant joint forces [N m, N]
  ContactSurface surface;
  bool collide = true;                       // false: no contacts
  std::map<std::string, double> mass_scale;  // by link; factor on mass and inertia
  std::vector<PointMass> payloads;
};

// Replaces values that follow from the two surfaces.
struct PairOverride {
  std::optional<double> friction, restitution, stiffness, dissipation;
  std::optional<bool> collide;
};

// Names in pairs and constraints: a body, "robot/link", "world"; in a pair also a robot (all
// links).
struct PairDescription : PairOverride {
  std::string a, b;
  int line = 0;
};

struct CouplingTarget {
  enum class Kind { start, state, paper, trace, device, synthetic };
  Kind kind = Kind::start;
  JointValueMap q;              // kind state
  std::filesystem::path trace;  // operator motion (CSV)
  unsigned seed = 1;            // of a synthetic operator
  double duration = 20;         // of a synthetic operator [s]
  SyntheticRanges ranges;       // of a synthetic operator
  std::string gripper;          // joint that the button moves; may be empty
  double open = 0, closed = 0;  // its position with the button released, pressed

  // Moved by an operator motion.
  static bool is_operator(Kind kind) { return kind != Kind::start && kind != Kind::state; }
  bool is_operator() const { return is_operator(kind); }
};

// Common to a coupling and its components in the model (SceneCoupling).
struct CouplingTraits {
  enum class Type { linear, torsional };  // force at a point of the link, or torque
  std::string name;
  int line = 0;
  CouplingSpec::Type law = CouplingSpec::Type::linear;
  bool printed = false;
  Type type = Type::linear;
  SpringSpace measure = SpringSpace::world;  // torsional laws
  SolrefParameters reference;                // weld
  Discretization discretization = Discretization::implicit;
  std::optional<std::pair<double, double>> soft_limits;  // soft limits: acts outside this range
  bool absolute_damper = false;  // damping acts on the link's velocity, not relative to the target
  double rate = 0;               // of the force evaluation [Hz]; 0: every step
  double delay = 0;              // of the target's motion [s]; before: its start, at rest
  double speed = 1;              // factor on the speed of a motion or trace

  bool is_linear() const { return type == Type::linear; }
  // A torque about a joint, by its position.
  bool at_joint() const { return type == Type::torsional && measure == SpringSpace::joint; }
  // A linear or torsional law at every step, without soft limits.
  bool is_plain_spring() const {
    return rate == 0 && !printed && !soft_limits &&
           (law == CouplingSpec::Type::linear || law == CouplingSpec::Type::torsional);
  }
};

struct CouplingDescription : CouplingTraits {
  std::string robot, link;          // a god object has no link: it moves all joints
  Vector3 point = Vector3::Zero();  // link axes; linear laws
  double stiffness = 0, damping = 0;
  double rotational_stiffness = 0, rotational_damping = 0;  // bushing
  CouplingTarget target;
};

struct ConstraintDescription {
  using Type = LoopType;
  std::string name;
  int line = 0;
  Type type = Type::weld;
  std::string a, b;                       // gear, motion: "robot/joint"; motion: a alone
  std::optional<Vector3> point, point_b;  // world, at the start
  std::optional<Vector3> axis, axis_b;    // likewise
  double ratio = 1;                       // gear: speed of a = ratio * speed of b
  std::optional<ExpressionTape> motion;   // of a joint: f, f', f'' of t [rad, m]
};

// A spring-damper or force law along the line between two points (solver/forces/point_springs.h).
struct SpringDescription {
  std::string name;
  int line = 0;
  std::string a, b;                       // bodies, robot/link or world
  std::optional<Vector3> point, point_b;  // world, at the start; else the origins
  double stiffness = 0, damping = 0;      // [N/m, N s/m]
  std::optional<double> rest_length;      // [m]; else the length at the start
  std::optional<ExpressionTape> law;      // of (l, v, t) [N]
};

enum class ContactMode { rigid, compliant, event };
inline const std::vector<std::string> kContactModes{"rigid", "compliant", "event"};

// Algorithm of the narrow phase.
enum class Detection { own, fcl };
inline const std::vector<std::string> kDetections{"own", "fcl"};

struct SceneDescription {
  std::filesystem::path file;
  Vector3 gravity{0, 0, -9.81};
  double step = 0.001;  // [s]
  ContactMode contact = ContactMode::rigid;
  Detection detection = Detection::own;
  std::optional<double> accuracy;  // of contact impulses: residual of the laws [m/s]
  double budget = 0;  // of contact impulses: operations per simulated second [1/s]; 0: none
  double sleep = 0;   // largest velocity at which islands fall asleep [m/s, rad/s]; 0: none do
  std::optional<Integrator> integrator;
  std::optional<double> duration;  // [s]; the command line overrides it
  std::vector<RobotInScene> robots;
  std::vector<BodyDescription> bodies;
  std::vector<PairDescription> pairs;
  std::vector<CouplingDescription> couplings;
  std::vector<ConstraintDescription> constraints;
  std::vector<SpringDescription> springs;
  std::vector<std::string> warnings;
};

}  // namespace twinarm
