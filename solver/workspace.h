// What the passes read and hand on to one another. Sized once; readable after a call at no cost.
//
// Everything is indexed by body (base included) unless marked "by velocity", and stands in body
// axes about the body's origin. Sorted by the pass that writes it. In debug builds each pass fills
// its fields with NaN first (forget), so that a value read too early shows.
#pragma once

#include <cstring>
#include <type_traits>
#include <vector>

#include "solver/model.h"

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
};

// In debug builds: fills with NaN (all bits set, for float and double alike).
template <class T>
void forget([[maybe_unused]] std::vector<T>& field) {
#ifndef NDEBUG
  static_assert(std::is_trivially_destructible_v<T>);
  if (!field.empty()) std::memset(static_cast<void*>(field.data()), 0xFF, field.size() * sizeof(T));
#endif
}

template <class S>
struct Workspace {
  // ahead of pass 1, in aba() of doubles alone (solver/sines.h)
  std::vector<S> sin, cos;  // by coordinate
  // pass 1 (base to tips)
  std::vector<Motion<S>> S_;      // columns of the motion subspaces, by velocity
  std::vector<Transform<S>> Xup;  // XJ Xtree: from the parent's frame to the body's
  std::vector<Motion<S>> v;       // spatial velocity [rad/s, m/s]
  std::vector<Motion<S>> c;       // velocity-product acceleration cJ + v x vJ
  std::vector<Transform<S>> X0;   // from the world's frame to the body's; kinematics() alone
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
  std::vector<S> M;            // nv x nv, row by row, both triangles [kg m^2, kg]
  // M^-1 times a vector
  std::vector<Force<S>> p;    // bias force of the vector alone
  std::vector<Motion<S>> dv;  // acceleration that it causes
  std::vector<S> y;           // the product, by velocity

  std::vector<std::size_t> iD;  // where D of body i begins

  explicit Workspace(const Model<S>& model)
      : sin(model.nq),
        cos(model.nq),
        S_(model.nv),
        Xup(n(model)),
        v(n(model)),
        c(n(model)),
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
        M(model.nv * model.nv),
        p(n(model)),
        dv(n(model)),
        y(model.nv) {
    std::size_t size = 0;
    const State<S> home(model);
    for (std::size_t i = 0; i < n(model); ++i) {
      iD.push_back(size);
      visit_joint(model, i, [&](auto joint) {
        size += joint.nv * joint.nv;
        const auto subspace = joint.subspace(home.q.data() + model.iq[i]);
        for (std::size_t k = 0; k < joint.nv; ++k)
          S_[model.iv[i] + k] = Motion<S>(times(subspace, unit_vector<S, joint.nv>(k)));
      });
    }
    D.resize(size);
    D_factors.resize(size);
  }

 private:
  static std::size_t n(const Model<S>& model) { return model.parent.size(); }
};

}  // namespace twinarm
