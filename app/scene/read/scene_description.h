// What a scene file says, as plain data: robots, bodies, obstacles, couplings, constraints.
//
// SI units, radians; vectors and positions in world axes unless a comment says otherwise. Defaults
// stand here and nowhere else. Each item remembers its line, so that whoever refuses it later can
// still say where it stands. docs/reference/scene_file.md tells users the same.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/robot/coordinates.h"
#include "collision/import/robot/robot_description.h"
#include "collision/import/robot/robot_model.h"
#include "coupling/laws/coupling_spec.h"
#include "solver/forces/force_source.h"
#include "solver/integration/integrator.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct Surface {
  double friction = 0.5;          // Coulomb; a pair takes the geometric mean
  double restitution = 0;         // 0 to 1; a pair takes the product
  double torsional_friction = 0;  // against turning about the normal [m]
  double rolling_friction = 0;    // [m]
  // Of the compliant response, at each contact point; a pair is two springs in series.
  double stiffness = 1e6;  // [N/m]
  double dissipation = 1;  // of Hunt and Crossley [s/m]
};

struct BodyMotion {                   // constant
  Vector3 linear = Vector3::Zero();   // of the body's origin [m/s]
  Vector3 angular = Vector3::Zero();  // [rad/s]
};

struct BodyDescription {
  std::string name;
  int line = 0;
  bool fixed = false;
  std::optional<BodyMotion> motion;  // it moves so, whatever pushes
  ShapeDescription shape;
  std::optional<double> mass, density;  // of a free body exactly one [kg, kg/m^3]
  std::optional<Vector3> com;           // body axes; left out: the centre of the solid shape
  std::optional<Matrix3> inertia;       // about the com, body axes; left out: of the solid shape
  Pose X_WB;                            // at the start
  Vector3 linear_velocity = Vector3::Zero();  // of the body's origin
  Vector3 angular_velocity = Vector3::Zero();
  Surface surface;
  std::optional<Vector3>
      color;  // red, green, blue in [0, 1]; of a texture what it is multiplied by
  std::filesystem::path texture;  // PNG or JPEG, absolute; empty for none
  int group = 0;                  // bodies of one group other than 0 do not touch one another

  bool is_free() const { return !fixed && !motion; }
};

struct RobotInScene {
  std::string name;
  int line = 0;
  RobotDescription description;
  bool floating = false;
  Pose X_WR;  // of the root link, at the start
  Vector3 linear_velocity = Vector3::Zero(), angular_velocity = Vector3::Zero();  // floating only
  JointValueMap q, qd;
  Surface surface;
  bool collide = true;                       // false: nothing touches it
  std::map<std::string, double> mass_scale;  // by link; of mass and inertia
  std::vector<PointMass> payloads;
};

// Names in pairs and constraints: a body, "robot/link", "world"; in a pair also a robot: all of it.
struct PairDescription {
  std::string a, b;
  int line = 0;
  // In place of what the surfaces give.
  std::optional<double> friction, restitution, stiffness, dissipation;
  std::optional<bool> collide;  // false: they pass through each other
};

struct CouplingTarget {
  enum class Kind { start, state, paper, trace, device, synthetic };
  Kind kind = Kind::start;
  JointValueMap q;              // of a state
  std::filesystem::path trace;  // CSV of a hand
  unsigned seed = 1;            // of a synthetic hand
  double duration = 20;         // likewise [s]
  // The joint that the button moves; empty: none. The coordinate where it is up, and where pressed.
  std::string gripper;
  double open = 0, closed = 0;

  // Moved by a hand, or by what stands for one.
  bool is_hand() const { return kind != Kind::start && kind != Kind::state; }
};

// Of a coupling, and of each of its pulls in the model (app/scene/model/scene_model.h).
struct CouplingTraits {
  // How it pulls: at a point of the link, or by turning it.
  enum class Type { linear, torsional };
  std::string name;
  int line = 0;
  CouplingSpec::Type law = CouplingSpec::Type::linear;
  bool printed = false;
  Type type = Type::linear;
  SpringSpace measure = SpringSpace::world;  // of laws that turn
  SolrefParameters reference;                // weld
  Discretization treatment = Discretization::implicit;
  // A soft stop: it acts where the joint's coordinate is not between these two, back to them.
  std::optional<std::pair<double, double>> outside;
  bool absolute_damper = false;  // against the link's own velocity, and not that of the target
  double rate = 0;               // [Hz] at which the force is computed; 0: every step
  double delay = 0;  // [s]: the kinematic side is seen this late; before, at its start, at rest
  double speed = 1;  // a motion or trace is played this many times faster
};

struct CouplingDescription : CouplingTraits {
  std::string robot, link;          // a god object has no link: it drives all joints
  Vector3 point = Vector3::Zero();  // link axes; of laws that pull at a point
  double stiffness = 0, damping = 0;
  double turn_stiffness = 0, turn_damping = 0;  // bushing
  CouplingTarget target;
};

struct ConstraintDescription {
  enum class Type { weld, ball, hinge, distance, gear };
  std::string name;
  int line = 0;
  Type type = Type::weld;
  std::string a, b;                             // of a gear: "robot/joint"
  std::optional<Vector3> point, point_b, axis;  // world, at the start
  double ratio = 1;                             // gear: speed of a = ratio * speed of b
};

enum class ContactMode { rigid, compliant, event };
inline const std::vector<std::string> kContactModes{"rigid", "compliant", "event"};

struct SceneDescription {
  std::filesystem::path file;
  Vector3 gravity{0, 0, -9.81};
  double step = 0.001;  // [s]
  ContactMode contact = ContactMode::rigid;
  std::optional<Integrator> integrator;
  std::optional<double> duration;  // [s], where the command line gives none
  std::vector<RobotInScene> robots;
  std::vector<BodyDescription> bodies;
  std::vector<PairDescription> pairs;
  std::vector<CouplingDescription> couplings;
  std::vector<ConstraintDescription> constraints;
  std::vector<std::string> warnings;
};

}  // namespace twinarm
