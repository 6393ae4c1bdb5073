// Visible data of one instant of a run or recording. World axes, SI.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/forces/scene_couplings.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {

// b can move if a cannot.
struct ShownContact {
  int a = 0, b = 0;  // geometries of the scene
  std::size_t body_a = 0, body_b = 0;
  Vector3 p_W = Vector3::Zero(), n_W = Vector3::Zero();           // point; normal from a to b
  Vector3 force_W = Vector3::Zero(), couple_W = Vector3::Zero();  // on b [N], [N m]
  double friction = 0;                                            // coefficient
};

struct ShownCouplingForce {
  enum class Kind { force, couple };
  std::string name;
  Kind kind = Kind::force;
  bool has_ends = false;  // between two points: drawn as a spring
  std::size_t body = 0;
  Vector3 p_D = Vector3::Zero(), p_K = Vector3::Zero();  // on the robot, on the target robot
  Vector3 force_W = Vector3::Zero();                     // on the robot [N] or [N m]
  double energy = 0;                                     // of its spring [J]
};

// Resultant of all contact points of two geometries.
struct PairForce {
  Vector3 force = Vector3::Zero(), couple = Vector3::Zero();  // on b [N], [N m]
  Vector3 point = Vector3::Zero();  // centre of pressure, weighted by normal forces
  std::size_t body_b = 0;
};

struct ShownTargetRobot {
  std::size_t robot = 0;
  std::vector<Pose> X_WL;
};

// The input device that moves a target robot.
struct ShownDevice {
  std::array<double, 6> theta{};  // joints theta1..theta6 [rad]
  bool button = false;
  Vector3 force_W = Vector3::Zero();  // motor force at the stylus [N]
};

struct ShownMouseSpring {
  std::size_t body = 0;
  Vector3 p_W = Vector3::Zero(), goal_W = Vector3::Zero();  // on the body; target point
  Vector3 force_W = Vector3::Zero();                        // on the body [N]
};

// Another run of the same bodies, shown beside this one.
struct ShownVariant {
  std::string name;
  Vector3 offset_W = Vector3::Zero(), above_W = Vector3::Zero();  // of its bodies; of its name
  std::vector<Pose> X_WL, before;                                 // by body, without the offset
};

struct Snapshot {
  State<double> x;
  Kinematics k;
  std::vector<ShownContact> contacts;
  std::vector<ShownCouplingForce> coupling_forces;
  std::vector<ShownTargetRobot> targets;
  std::vector<ShownDevice> devices;  // of target robots moved by a device
  std::optional<ShownMouseSpring> mouse_spring;
  std::vector<Pose> before;            // previous branch at this time, by body; or empty
  std::vector<ShownVariant> variants;  // the first: this run, without poses; or empty
  double kinetic = 0, potential = 0, elastic = 0;  // [J]
  explicit Snapshot(const Model<double>& model) : x(model), k(model) {}
};

ShownCouplingForce::Kind kind_of_coupling(const SceneModel& scene, std::size_t coupling);

// Ordered by the pairs of geometries.
std::vector<PairForce> pair_forces(const Snapshot& snapshot);

// Without contacts.
Snapshot snapshot_of(const Model<double>& model, const State<double>& x);
// Of a scene; `forces`: SceneCouplings::force() by coupling, or empty.
Snapshot snapshot_of(const SceneModel& scene, SceneCouplings& couplings, const State<double>& x,
                     const std::vector<Vector3>& forces);

// Centre of mass of a body; its origin if massless.
Vector3 com_of(const Model<double>& model, const Kinematics& k, std::size_t body);

// Of all bodies with mass.
struct TotalMotion {
  double mass = 0;
  Vector3 com_W = Vector3::Zero();
  Vector3 linear = Vector3::Zero();   // [kg m/s]
  Vector3 angular = Vector3::Zero();  // about the common centre of mass [kg m^2/s]
};
TotalMotion total_motion(const Model<double>& model, const Kinematics& k);
// Rotational inertia about its centre of mass, world axes [kg m^2].
Matrix3 inertia_of(const Model<double>& model, const Kinematics& k, std::size_t body);

}  // namespace twinarm
