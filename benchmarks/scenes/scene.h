// A mechanism or a scene in Eigen's types, converted by every engine. C++17 without types of
// engines or of twinarm, as Simbody's headers require C++17.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace twinarm::bench {

using Eigen::Vector3d;
using Numbers6 = std::array<double, 6>;

inline constexpr double standard_gravity = 9.81;  // [m/s^2]

enum class Joint {
  revolute,   // q an angle, v its rate
  spherical,  // q the quaternion w, x, y, z body to parent, v the angular velocity in body axes
  free        // q position and quaternion, v angular velocity in body axes and velocity of the
              // body's origin in world axes
};
enum class Form { none, sphere, box };

struct Body {
  int parent = -1;  // index of an earlier body; -1: the world
  Joint joint = Joint::free;
  Vector3d position = Vector3d::Zero();  // of the body's origin in the parent at q = 0 [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // body to parent axes at q = 0
  std::size_t axis = 2;             // a revolute is about x (0), y (1) or z (2)
  double mass = 1;                  // [kg]
  Vector3d com = Vector3d::Zero();  // from the origin, body axes [m]
  Numbers6 inertia{};               // xx, yy, zz, xy, xz, yz about the com, body axes [kg m^2]
  Form form = Form::none;
  Vector3d half = Vector3d::Zero();     // radius of a sphere three times, half edges of a box [m]
  Vector3d form_at = Vector3d::Zero();  // centre of the shape, body axes [m]
  Vector3d push =
      Vector3d::Zero();  // a constant force at the com, which is the origin; world axes [N]
};

// For all joints (revolutes): tau = stiffness (target - q) - damping qd, once per step.
struct Control {
  std::vector<double> target;         // [rad]
  double stiffness = 0, damping = 0;  // [N m/rad], [N m s/rad]
  double torque(std::size_t joint, double q, double qd) const {
    return stiffness * (target[joint] - q) - damping * qd;
  }
};

struct Scene {
  Vector3d gravity{0, 0, -standard_gravity};
  std::vector<Body> bodies;
  std::vector<double> q, v;                 // initial, body by body in the order of Joint
  bool floor = false;                       // z = 0
  double floor_friction = 0, friction = 0;  // body with floor; two bodies
  double restitution = 0;                   // of all pairs
  bool uncorrected = false;  // no correction of overlaps, where an engine supports that
  struct FixedBox {
    Vector3d centre, half;  // axes along the world's [m]
  };
  std::vector<FixedBox> fixed_boxes{};  // friction as of two bodies
  std::optional<Control> control{};

  bool has_contacts() const { return floor || !fixed_boxes.empty(); }
  bool floats() const { return !bodies.empty() && bodies[0].joint == Joint::free; }
};

inline std::size_t coordinates_of(Joint joint) {
  return joint == Joint::revolute ? 1 : joint == Joint::spherical ? 4 : 7;
}
inline std::size_t velocities_of(Joint joint) {
  return joint == Joint::revolute ? 1 : joint == Joint::spherical ? 3 : 6;
}
// Calls each(body, q of its joint, v of its joint) for all bodies.
template <class Number, class Each>
void for_each_joint(const Scene& scene, Number* q, Number* v, Each each) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    each(i, q, v);
    q += coordinates_of(scene.bodies[i].joint), v += velocities_of(scene.bodies[i].joint);
  }
}

// Uniform solids, and a free body at p, at rest except for the velocity v.
Body solid_ball(double mass, double radius);
Body solid_cube(double mass, double edge);
void add_free_body(Scene& scene, const Body& body, const Vector3d& p,
                   const Vector3d& v = Vector3d::Zero());

// State and forces of a mechanism, body by body in the order of Joint: tau are generalised forces
// conjugate to v, the force of a free body at its origin; qdd = dv/dt, for inverse dynamics.
struct Situation {
  std::vector<double> q, v, tau, qdd;
};

// ---- of Eigen's types ----

inline Eigen::Matrix3d inertia3(const Numbers6& inertia) {
  const auto& [xx, yy, zz, xy, xz, yz] = inertia;
  Eigen::Matrix3d I;
  I << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return I;
}
inline Vector3d axis_of(const Body& b) {
  return Vector3d::Unit(static_cast<Eigen::Index>(b.axis));
}
inline Eigen::Quaterniond quaternion(const double* q) {
  return {q[0], q[1], q[2], q[3]};
}
template <class Quaternion>
void write_quaternion(const Quaternion& R, double* q) {
  q[0] = R.w(), q[1] = R.x(), q[2] = R.y(), q[3] = R.z();
}
inline std::size_t index(int body) {
  return static_cast<std::size_t>(body);
}

// A situation as vectors of Eigen.
struct VectorState {
  Eigen::VectorXd q, v, tau, qdd;
  VectorState() = default;
  explicit VectorState(const Situation& s)
      : q(vector_of(s.q)), v(vector_of(s.v)), tau(vector_of(s.tau)), qdd(vector_of(s.qdd)) {}
  static Eigen::VectorXd vector_of(const std::vector<double>& v) {
    return Eigen::VectorXd::Map(v.data(), static_cast<Eigen::Index>(v.size()));
  }
};

// A floating base: coordinates, velocities and forces.
struct Base {
  explicit Base(const Situation& s)
      : p(s.q.data()),
        R(quaternion(&s.q[3])),
        w_B(s.v.data()),
        v_W(s.v.data() + 3),
        t_B(s.tau.data()),
        f_W(s.tau.data() + 3) {}
  Vector3d p;            // of its origin, world
  Eigen::Quaterniond R;  // body axes to world axes
  Vector3d w_B, v_W;     // angular velocity, body axes; velocity of the origin, world axes
  Vector3d t_B, f_W;     // torque, body axes; force at the origin, world axes
};

// ---- cases ----

// Scenes that are run in every engine, and their error measures, computed from the coordinates
// returned by the engine.

// Called with every observed state, in order; returns the error up to there.
using Judge =
    std::function<double(double t, const std::vector<double>& q, const std::vector<double>& v)>;

struct SceneCase {
  std::string name, group;  // as in `twinarm compare`, where there is a case of that name
  std::string what;         // one line: what moves
  std::string unit;         // of the error, with its measure: "m", "rad, rad/s"
  Scene scene;
  double step = 1e-3;           // [s]
  std::vector<double> times{};  // of observation, multiples of 10 ms; empty: after every step
  double duration = 0;          // [s]
  std::function<Judge()> judge{};
  bool work_precision = false;  // also with several steps and tolerances
  std::vector<std::pair<std::string, double>> published{};  // engine, error
};

std::vector<SceneCase> smooth_cases();   // without contacts
std::vector<SceneCase> contact_cases();  // with
std::vector<SceneCase> engine_cases();   // tasks with published results

}  // namespace twinarm::bench
