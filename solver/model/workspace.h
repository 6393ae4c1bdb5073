// What the passes read and hand on to one another. Sized once; readable after a call at no cost.
//
// Everything is indexed by body (base included) unless marked "by velocity", and stands in body
// axes about the body's origin. Sorted by the pass that writes it. In debug builds each pass fills
// its fields with NaN first (forget), so that a value read too early shows.
#pragma once

#include <cstring>
#include <type_traits>
#include <vector>

#include "solver/model/field_description.h"
#include "solver/model/model.h"

namespace twinarm {

// What acts on the bodies besides gravity: the input of the passes, filled by ForceSources.
template <class S>
struct Forces {
  std::vector<S> tau;                            // by velocity [N m, N]
  std::vector<Force<S>> f_ext;                   // by body [N m, N]
  std::vector<S> armature;                       // by velocity, added to D [kg m^2, kg]
  std::vector<ArticulatedInertia<S>> impedance;  // by body, added to IA and to nothing else
  bool has_impedance = false;                    // false: all of impedance is zero

  explicit Forces(const Model<S>& model)
      : tau(model.nv),
        f_ext(model.parent.size()),
        armature(model.nv),
        impedance(model.parent.size()) {}
  void clear() {
    tau.assign(tau.size(), S(0));
    f_ext.assign(f_ext.size(), Force<S>{});
    armature.assign(armature.size(), S(0));
    if (has_impedance) impedance.assign(impedance.size(), ArticulatedInertia<S>{});
    has_impedance = false;
  }
  void add_impedance(std::size_t body, const ArticulatedInertia<S>& inertia) {
    impedance[body] += inertia;
    has_impedance = true;
  }

  // Calls visit(Quantity, field) for each field.
  template <class Visitor>
  void describe(Visitor&& visit) const {
    using By = Quantity::By;
    visit({"tau", 0, By::velocity, "force at the joint: actuator, friction, springs", "N m; N",
           "input"},
          tau);
    visit({"f_ext", 0, By::body, "wrench on the body from outside, gravity not counted", "N m; N",
           "input"},
          f_ext);
    visit({"armature", 0, By::velocity, "rotor-like inertia of implicit springs and dampers",
           "kg m^2; kg", "input, added to D"},
          armature);
    visit({"impedance", 0, By::body, "weightless inertia of implicit springs and dampers",
           "kg m^2, kg m, kg", "input, added to IA"},
          impedance);
  }
};

// In debug builds: fills with NaN (all bits set, for float and double alike).
template <class T>
void forget([[maybe_unused]] std::vector<T>& field) {
#ifndef NDEBUG
  static_assert(std::is_trivially_destructible_v<T>);
  if (!field.empty()) std::memset(static_cast<void*>(field.data()), 0xFF, field.size() * sizeof(T));
#endif
}

// What the velocities of the bodies are made of: the first pass of every algorithm.
template <class S>
struct BodyVelocities {
  std::vector<Motion<S>> S_;      // columns of the motion subspaces, by velocity
  std::vector<Transform<S>> Xup;  // XJ Xtree: from the parent's frame to the body's
  std::vector<Motion<S>> v;       // spatial velocity [rad/s, m/s]
  std::vector<Motion<S>> c;       // velocity-product acceleration cJ + v x vJ

  explicit BodyVelocities(const Model<S>& model)
      : S_(model.nv), Xup(model.parent.size()), v(Xup.size()), c(Xup.size()) {
    const State<S> home(model);
    for (std::size_t i = 0; i < Xup.size(); ++i)
      visit_joint(model, i, [&](auto joint) {
        const auto subspace = joint.subspace(home.q.data() + model.iq[i]);
        for (std::size_t k = 0; k < joint.nv; ++k)
          S_[model.iv[i] + k] = Motion<S>(times(subspace, unit_vector<S, joint.nv>(k)));
      });
  }
};

template <class S>
struct Workspace : BodyVelocities<S> {
  // pass 1 (base to tips) leaves BodyVelocities, and before it, in aba() of doubles alone
  // (solver/spatial/sincos_batch.h)
  std::vector<S> sin, cos;  // by coordinate
  // kinematics
  std::vector<Transform<S>> X0;  // from the world's frame to the body's
  // pass 2 (tips to base)
  std::vector<ArticulatedInertia<S>> IA;  // articulated-body inertia
  std::vector<Force<S>> pA;               // articulated bias force [N m, N]
  std::vector<Force<S>> U;                // IA S, by velocity
  std::vector<S> D;                       // S^T U + armature, nv x nv of body i at iD[i]
  std::vector<S> D_factors;               // L D L^T of it, at the same place (slice_spd)
  std::vector<S> u;                       // tau - S^T pA, by velocity
  // pass 3 (base to tips)
  std::vector<Motion<S>> a;  // spatial acceleration, gravity as a_0 = -g
  std::vector<S> qdd;        // by velocity
  // inverse dynamics
  std::vector<Force<S>> f;  // force transmitted through joint i [N m, N]
  std::vector<S> tau;       // by velocity
  // mass matrix
  std::vector<Inertia<S>> Ic;  // composite inertia of the subtree
  // M^-1 times a vector
  std::vector<Force<S>> p;    // bias force of the vector alone
  std::vector<Motion<S>> dv;  // acceleration that it causes
  std::vector<S> y;           // the product, by velocity

  std::vector<std::size_t> iD;  // where D of body i begins

  explicit Workspace(const Model<S>& model)
      : BodyVelocities<S>(model),
        sin(model.nq),
        cos(model.nq),
        X0(n(model)),
        IA(n(model)),
        pA(n(model)),
        U(model.nv),
        u(model.nv),
        a(n(model)),
        qdd(model.nv),
        f(n(model)),
        tau(model.nv),
        Ic(n(model)),
        p(n(model)),
        dv(n(model)),
        y(model.nv) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < n(model); ++i) {
      iD.push_back(size);
      size += model.dofs(i) * model.dofs(i);
    }
    D.resize(size);
    D_factors.resize(size);
  }

  // Calls visit(Quantity, field) for what aba() leaves, in the order in which it is written. What
  // other algorithms leave is theirs; D_factors is D again.
  template <class Visitor>
  void describe(Visitor&& visit) const {
    describe_motion(visit);
    describe_inertias(visit);
    using By = Quantity::By;
    visit({"qdd", 3, By::velocity, "acceleration of the joint", "rad/s^2; m/s^2",
           "qdd = D^-1 (u - U^T (Xup a_p + c)), table 7.1"},
          qdd);
    visit({"a", 3, By::body, "spatial acceleration; gravity as an upward one of the base",
           "rad/s^2; m/s^2", "a = Xup a_p + c + S qdd, table 7.1"},
          a);
  }

 private:
  template <class Visitor>
  void describe_motion(Visitor& visit) const {
    using By = Quantity::By;
    visit({"S", 1, By::velocity, "motion subspace: how the joint lets the body move", "1",
           "section 3.5, table 4.1"},
          this->S_);
    visit({"Xup", 1, By::body, "transform from the parent's axes and origin to the body's", "1; m",
           "Xup = XJ Xtree, table 7.1; (2.24)"},
          this->Xup);
    visit({"v", 1, By::body, "spatial velocity: turn, and velocity of the origin", "rad/s; m/s",
           "v = Xup v_p + S qd, table 7.1"},
          this->v);
    visit({"c", 1, By::body, "acceleration that the velocities alone cause", "rad/s^2; m/s^2",
           "c = cJ + v x S qd, table 7.1"},
          this->c);
  }
  template <class Visitor>
  void describe_inertias(Visitor& visit) const {
    using By = Quantity::By;
    visit({"IA", 2, By::body, "articulated-body inertia: the body with all that hangs on it",
           "kg m^2, kg m, kg", "IA = I + sum of X^T Ia X, table 7.1; (7.22)"},
          IA);
    visit({"pA", 2, By::body, "force that it takes to give the body no acceleration", "N m; N",
           "pA = v x* I v - f_ext + sum of X^T pa, table 7.1"},
          pA);
    visit({"U", 2, By::velocity, "force that a unit acceleration of the joint takes",
           "kg m^2, kg m; kg m, kg", "U = IA S, table 7.1"},
          U);
    visit({"D", 2, By::square, "inertia felt at the joint: ancestors locked, descendants free",
           "kg m^2; kg", "D = S^T U + armature, table 7.1"},
          D);
    visit({"u", 2, By::velocity, "force left at the joint to accelerate it", "N m; N",
           "u = tau - S^T pA, table 7.1"},
          u);
  }

  static std::size_t n(const Model<S>& model) { return model.parent.size(); }
};

}  // namespace twinarm
