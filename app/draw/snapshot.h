// A moment: what there is to be seen of one instant, as plain numbers. World axes, SI.
//
// Who has computed it (a run, a recording) is not known here: bodies by the state, contacts and
// pulls as they were given.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/forces/scene_couplings.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {

// b is the one of the two that forces move, where the other is not.
struct ShownContact {
  int a = 0, b = 0;  // geometries of the scene
  std::size_t body_a = 0, body_b = 0;
  Vector3 p_W = Vector3::Zero(), n_W = Vector3::Zero();           // the normal from a to b
  Vector3 force_W = Vector3::Zero(), couple_W = Vector3::Zero();  // on b [N], [N m]
  double friction = 0;                                            // Coulomb's, of the pair
};

struct ShownCouplingForce {
  enum class Kind { force, couple };
  std::string name;
  Kind kind = Kind::force;
  bool has_ends = false;  // it stands between two points: drawn as a spring
  std::size_t body = 0;
  Vector3 p_D = Vector3::Zero(), p_K = Vector3::Zero();  // on the DVR, on the KVR
  Vector3 pull_W = Vector3::Zero();                      // on the DVR [N] or [N m]
  double energy = 0;                                     // of its spring [J]
};

// All points of two geometries that touch.
struct PairForce {
  Vector3 force = Vector3::Zero(), couple = Vector3::Zero();  // on b [N], [N m]
  Vector3 point = Vector3::Zero();  // centre of pressure, weighed by the normal parts
  std::size_t body_b = 0;
};

// The kinematic twin of a robot.
struct ShownTargetRobot {
  std::size_t robot = 0;
  std::vector<Pose> X_WL;
};

// The hand device that moves a twin.
struct ShownHand {
  std::array<double, 6> theta{};  // its joints theta1..theta6 [rad]
  bool button = false;
  Vector3 force_W = Vector3::Zero();  // that its motors put on the stylus [N]
};

// A spring by which somebody pulls at a body from outside.
struct ShownMouseSpring {
  std::size_t body = 0;
  Vector3 p_W = Vector3::Zero(), goal_W = Vector3::Zero();  // on the body; where it is pulled to
  Vector3 force_W = Vector3::Zero();                        // on the body [N]
};

// Another run of the same bodies, that is shown beside this one.
struct ShownVariant {
  std::string name;
  Vector3 offset_W = Vector3::Zero(), above_W = Vector3::Zero();  // of its bodies; of its name
  std::vector<Pose> X_WL, before;  // by body, as if it stood where this one does
};

struct Snapshot {
  State<double> x;
  Kinematics k;
  std::vector<ShownContact> contacts;
  std::vector<ShownCouplingForce> pulls;
  std::vector<ShownTargetRobot> twins;
  std::vector<ShownHand> hands;  // by twin that a hand moves
  std::optional<ShownMouseSpring> grip;
  std::vector<Pose> before;                        // of another run at this time, by body; or none
  std::vector<ShownVariant> lanes;                 // the first: this one, without places; or none
  double kinetic = 0, potential = 0, elastic = 0;  // [J]
  explicit Snapshot(const Model<double>& model) : x(model), k(model) {}
};

// Of a coupling of the scene.
ShownCouplingForce::Kind kind_of_pull(const SceneModel& scene, std::size_t coupling);

// In the order of the pairs' names.
std::vector<PairForce> pair_forces(const Snapshot& moment);

// What the state says; contacts are left to the caller.
Snapshot moment_of(const Model<double>& model, const State<double>& x);
// The same of a scene; `pulls` by coupling as SceneCouplings::pull() has them, or none.
Snapshot moment_of(const SceneModel& scene, SceneCouplings& couplings, const State<double>& x,
                   const std::vector<Vector3>& pulls);

// From the model in body axes B to the world: centre of mass of a body; of one without mass its
// origin.
Vector3 com_of(const Model<double>& model, const Kinematics& k, std::size_t body);

// Of all bodies that have mass and move by forces, or stand.
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
