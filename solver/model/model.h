// System model (RBDA chapter 4): kinematic tree, inertias and joint parameters. Immutable once
// built; structure of arrays, indexed by body.
//
// Bodies are numbered so that parent[i] < i; body 0 is the fixed base (RBDA section 4.1). Joint i
// connects body i to its parent. Each body has two frames, both with the origin of joint i:
//   body frame  rotated at build time so that the joint axis is z; used by the algorithms;
//   link frame  axes of the user's file; used by everything outside solver/.
// R_BL[i] maps coordinates in link axes to coordinates in body axes.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/model/joint.h"
#include "solver/spatial/convert_spatial.h"
#include "solver/spatial/spatial.h"

namespace twinarm {

// Mimic joint: q[follower] = ratio q[leader] + offset, qd[follower] = ratio qd[leader]. A leader
// (mimicked joint) is never a mimic joint itself.
struct Mimic {
  std::size_t follower, leader;      // velocity indices
  std::size_t follower_q, leader_q;  // coordinate indices
  double ratio = 1, offset = 0;
};

// Per-body constants that are equal in all lanes of S: stored once and broadcast on access, at no
// extra instructions and 1/N of the memory.
template <template <class> class T, class S>
class Broadcast {
 public:
  Broadcast() = default;
  Broadcast(std::vector<T<Constant<S>>> once) : once_(std::move(once)) {}  // NOLINT: implicit
  T<S> operator[](std::size_t i) const { return convert<S>(once_[i]); }

 private:
  std::vector<T<Constant<S>>> once_;
};
template <template <class> class T, class S>
using Constants =
    std::conditional_t<std::is_same_v<S, Constant<S>>, std::vector<T<S>>, Broadcast<T, S>>;

// The index in `order`, ascending by name, of that name; -1: none.
inline int find_name(const std::string& name, const std::vector<std::string>& names,
                     const std::vector<int>& order) {
  const auto name_of = [&](int i) -> const std::string& {
    return names[static_cast<std::size_t>(i)];
  };
  const auto found = std::ranges::lower_bound(order, name, {}, name_of);
  return found != order.end() && name_of(*found) == name ? *found : -1;
}

// What does not depend on the scalar.
struct ModelTree {
  std::vector<std::string> body_name;            // link name in the user's file
  std::vector<std::string> joint_name;           // joint of the body; empty for the base
  std::vector<int> by_body_name, by_joint_name;  // bodies without the base, ascending by name
  std::vector<int> parent;
  std::vector<int> last_child;  // child of highest number, 0 for a leaf; not in RBDA: IA_p starts
                                // from its last child's contribution without a copy
  std::vector<std::size_t> chain_first;  // of a body: the first of those before it in a row, each
                                         // the parent of the next
  bool is_deep = false;                  // mass matrix in common axes (solver/passes/crba.h)
  std::vector<JointType> joint;
  std::vector<std::size_t> iq, iv, ip;  // first index of joint i in q, qd and State::prescribed
  std::size_t nq = 0, nv = 0, np = 0;
  std::vector<Mimic> mimics;

  std::size_t dofs(std::size_t i) const { return (i + 1 < iv.size() ? iv[i + 1] : nv) - iv[i]; }
  std::size_t shared_ancestor(std::size_t a, std::size_t b) const {  // a or b itself included
    while (a != b) (a > b ? a : b) = static_cast<std::size_t>(parent[std::max(a, b)]);
    return a;
  }
  int body_count() const { return static_cast<int>(parent.size()); }  // including the base
  // Index of the body, and of the child body of the joint; -1: not found. O(log n).
  int find_body(const std::string& name) const {
    const int found = find_name(name, body_name, by_body_name);  // links named "world" come first
    return found < 0 && !body_name.empty() && name == body_name[0] ? 0 : found;
  }
  int find_joint(const std::string& name) const {
    return find_name(name, joint_name, by_joint_name);
  }
};

template <class S>
struct Model : ModelTree {
  std::vector<S> pitch;                   // of screw joints [m/rad]; 0 for all others
  Constants<Transform, S> Xtree;          // XT_i: parent's body frame to joint i at q_i = identity
  Constants<Inertia, S> I;                // about the body's origin, body axes [kg, kg m, kg m^2]
  std::vector<Mat3<S>> R_BL;              // from link axes to body axes
  Vec3<S> gravity{S(0), S(0), S(-9.81)};  // world axes [m/s^2]

  // By velocity.
  std::vector<S> armature;                     // rotor inertia reflected to the joint [kg m^2, kg]
  std::vector<S> damping;                      // viscous [N m s/rad, N s/m]
  std::vector<S> coulomb_plus, coulomb_minus;  // Coulomb friction for qd > 0, qd < 0 [N m, N]
};

// Calls f with the joint struct of body i.
template <class S, class F>
void visit_joint(const Model<S>& model, std::size_t i, F&& f) {
  visit_joint<S>(model.joint[i], model.pitch[i], std::forward<F>(f));
}

// The same, and passes the sparsity of Ia: RevoluteSparsity for revolute joints without armature.
// M: Model, or a type with the same members.
template <class M, class S, class F>
void visit_joint(const M& model, const std::vector<S>& more_armature, std::size_t i, F&& f) {
  if (model.joint[i] == JointType::revolute &&
      !is_nonzero(model.armature[model.iv[i]] + more_armature[model.iv[i]]))
    return f(RevoluteJoint<S>{}, RevoluteSparsity{});
  visit_joint(model, i, [&](auto joint) { f(joint, FullInertia{}); });
}

// Joint positions q and velocities qd; those of joint i begin at Model::iq[i] and iv[i].
template <class S>
struct State {
  std::vector<S> q, qd;
  // Input: vJ and aJ of each prescribed joint [rad/s, m/s; rad/s^2, m/s^2].
  std::vector<S> prescribed;
  S t{};  // [s]

  State() = default;
  // All joints at identity, zero velocity.
  explicit State(const Model<S>& model)
      : q(model.nq, S(0)), qd(model.nv, S(0)), prescribed(model.np, S(0)) {
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      visit_joint(model, i, [&](auto joint) { joint.identity(q.data() + model.iq[i]); });
  }

  // qd of joint i; for a prescribed joint its given motion.
  template <class Joint, class M>
  const S* rates([[maybe_unused]] const Joint& joint, const M& model, std::size_t i) const {
    if constexpr (requires { joint.np; })
      return prescribed.data() + model.ip[i];
    else
      return qd.data() + model.iv[i];
  }
};

}  // namespace twinarm
