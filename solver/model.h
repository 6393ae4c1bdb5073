// The model: what a mechanism is. Immutable once built; structure of arrays by body.
//
// Bodies are numbered so that parent[i] < i; body 0 is the fixed base (RBDA section 4.1). Body i
// moves relative to its parent through joint i. Each body has two frames with the same origin, the
// origin of joint i:
//   body frame  turned at build time so that a one-dof joint's axis is z; the passes work in it;
//   link frame  the axes of the user's file; everything that leaves solver/ is in it.
// turn[i] = R_BL takes coordinates in link axes to coordinates in body axes.
#pragma once

#include <string>
#include <vector>

#include "solver/joint.h"
#include "solver/pose.h"
#include "solver/spatial.h"

namespace twinarm {

template <class S>
struct Model {
  std::vector<std::string> body_name;   // the link's name in the user's file
  std::vector<std::string> joint_name;  // of the joint that carries the body; empty for the base
  std::vector<int> parent;
  std::vector<JointType> joint;
  std::vector<std::size_t> iq, iv;  // first coordinate and first velocity of joint i
  std::vector<Transform<S>> Xtree;  // from the parent's body frame to joint i at q_i = identity
  std::vector<Inertia<S>> I;        // about the body's origin, body axes [kg, kg m, kg m^2]
  std::vector<Mat3<S>> turn;        // R_BL
  Vec3<S> gravity{S(0), S(0), S(-9.81)};  // world axes [m/s^2]
  std::size_t nq = 0, nv = 0;

  int body_count() const { return static_cast<int>(parent.size()); }  // with the base
  int find_body(const std::string& name) const;                       // -1 where there is none
  int find_joint(const std::string& name) const;  // the body that the joint carries, or -1
};

// Mass, centre of mass and rotational inertia about it, in link axes, SI.
struct BodyInertia {
  double mass = 0;
  Vector3 com = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
};

// Adds bodies one by one (a parent before its children) and checks everything; build() throws ONE
// InputError that lists all faults.
class ModelBuilder {
 public:
  // Places joint `joint_name` at X_PJ in the parent's link frame; at q = 0 the new link's frame
  // coincides with it. `axis` in link axes, any length but zero; unused by fixed and free joints.
  // Returns the body's index. A body with no mass must be carried by a fixed joint.
  int add_body(const std::string& body_name, int parent, const std::string& joint_name,
               JointType type, const Pose& X_PJ, const Vector3& axis, const BodyInertia& inertia);
  void set_gravity(const Vector3& g_W) { gravity_ = g_W; }
  Model<double> build() const;

 private:
  struct Body {
    std::string name, joint_name;
    int parent;
    JointType type;
    Pose X_PJ;
    Vector3 axis;
    BodyInertia inertia;
  };
  std::vector<Body> bodies_;
  Vector3 gravity_{0, 0, -9.81};
};

template <class S>
int Model<S>::find_body(const std::string& name) const {
  for (int i = 0; i < body_count(); ++i)
    if (body_name[static_cast<std::size_t>(i)] == name) return i;
  return -1;
}
template <class S>
int Model<S>::find_joint(const std::string& name) const {
  for (int i = 1; i < body_count(); ++i)
    if (joint_name[static_cast<std::size_t>(i)] == name) return i;
  return -1;
}

// Where the mechanism is and how fast it moves: coordinates q and velocities qd of joint i begin at
// Model::iq[i] and iv[i].
template <class S>
struct State {
  std::vector<S> q, qd;
  S t{};  // [s]

  State() = default;
  // Every joint at its identity, at rest.
  explicit State(const Model<S>& model) : q(model.nq, S(0)), qd(model.nv, S(0)) {
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      if (model.joint[i] == JointType::free) q[model.iq[i] + 3] = S(1);
  }
};

}  // namespace twinarm
