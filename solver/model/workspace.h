// Inputs and variables of the algorithms. Allocated once; all remain readable after a call.
//
// Indexed by body (including the base) unless marked "by velocity"; in body axes, about the body's
// origin. Sorted by the pass that writes the variable. In debug builds each algorithm first fills
// its variables with NaN (poison_with_nan), which exposes values that are read before written.
#pragma once

#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "solver/model/field_description.h"
#include "solver/model/model.h"
#include "solver/model/spatial_rows.h"

namespace twinarm {

// Forces besides gravity: input of the algorithms, filled by the ForceSources.
template <class S>
struct Forces {
  std::vector<S> tau;                                // by velocity [N m, N]
  std::vector<Force<S>> f_ext;                       // by body [N m, N]
  std::vector<S> armature;                           // by velocity, added to D [kg m^2, kg]
  std::vector<ArticulatedInertia<S>> added_inertia;  // by body, added to IA only
  bool has_added_inertia = false;                    // false: added_inertia is zero for all bodies

  explicit Forces(const Model<S>& model)
      : tau(model.nv),
        f_ext(model.parent.size()),
        armature(model.nv),
        added_inertia(model.parent.size()) {}
  void clear() {
    tau.assign(tau.size(), S(0));
    f_ext.assign(f_ext.size(), Force<S>{});
    armature.assign(armature.size(), S(0));
    if (has_added_inertia) added_inertia.assign(added_inertia.size(), ArticulatedInertia<S>{});
    has_added_inertia = false;
  }
  void add_inertia(std::size_t body, const ArticulatedInertia<S>& inertia) {
    added_inertia[body] += inertia;
    has_added_inertia = true;
  }

  // Calls visit(Quantity, field) for each field.
  template <class Visitor>
  void describe(Visitor&& visit) const {
    using By = Quantity::By;
    visit({"tau", 0, By::velocity, "joint force: actuator, friction, springs", "N m; N", "input"},
          tau);
    visit({"f_ext", 0, By::body, "external wrench on the body, without gravity", "N m; N", "input"},
          f_ext);
    visit({"armature", 0, By::velocity, "added inertia of implicit spring-dampers at the joint",
           "kg m^2; kg", "input, added to D"},
          armature);
    visit({"added_inertia", 0, By::body, "added inertia of implicit spring-dampers on the body",
           "kg m^2, kg m, kg", "input, added to IA"},
          added_inertia);
  }
};

// In debug builds: fills all fields with NaN (all bits set).
template <class... T>
void poison_with_nan([[maybe_unused]] std::vector<T>&... fields) {
#ifndef NDEBUG
  static_assert((std::is_trivially_destructible_v<T> && ...));
  const auto fill = [](void* first, std::size_t bytes) {
    if (bytes > 0) std::memset(first, 0xFF, bytes);
  };
  (fill(fields.data(), fields.size() * sizeof(T)), ...);
#endif
}

// Variables of forward kinematics: pass 1 of every algorithm, and poses.
template <class S>
struct BodyKinematics {
  std::vector<S> sin, cos;        // by coordinate, of double only (solver/spatial/sincos_batch.h)
  std::vector<Motion<S>> S_;      // columns of the motion subspaces, by velocity
  std::vector<Transform<S>> Xup;  // XJ Xtree: from the parent's frame to the body's
  std::vector<Motion<S>> v;       // spatial velocity [rad/s, m/s]
  std::vector<Motion<S>> c;       // velocity-product acceleration cJ + v x S qd
  std::vector<Transform<S>> X0;   // from the world frame to the body frame, of kinematics() only

  explicit BodyKinematics(const Model<S>& model)
      : sin(model.nq),
        cos(model.nq),
        S_(model.nv),
        Xup(model.parent.size()),
        v(Xup.size()),
        c(Xup.size()),
        X0(Xup.size()) {
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
struct Workspace : BodyKinematics<S> {
  // pass 1 (base to tips) of ABA: BodyKinematics
  // pass 2 (tips to base)
  std::vector<ArticulatedInertia<S>> IA;  // articulated-body inertia
  std::vector<Force<S>> pA;               // articulated-body bias force [N m, N]
  std::vector<Force<S>> U;                // IA S, by velocity
  std::vector<S> D;                       // S^T U + armature, nv x nv of body i from iD[i]
  std::vector<S> D_factors;               // its L D L^T factors, same index (slice_spd)
  std::vector<S> u;                       // tau - S^T pA, by velocity
  // pass 3 (base to tips)
  std::vector<Motion<S>> a;  // spatial acceleration, with gravity as a_0 = -a_g
  std::vector<S> qdd;        // by velocity
  // inverse dynamics
  std::vector<Force<S>> f;  // wrench transmitted through joint i [N m, N]
  std::vector<S> tau;       // by velocity
  // mass matrix
  std::vector<Inertia<S>> Ic;  // composite inertia of the subtree
  // matrices (crba_in_common_axes, minv_matrix, derivatives): from axes that all bodies of a tree
  // share, parallel to those of the world, with the origin of the body that is next to the base;
  // far from the world's origin moments about it would lose digits
  std::vector<Transform<S>> Xr;
  SpatialRows<S> axes;  // S in these axes, by velocity
  // M^-1 times a vector
  std::vector<Force<S>> p;    // bias force of the right-hand side
  std::vector<Motion<S>> dv;  // spatial acceleration for qdd = y
  std::vector<S> y;           // the product, by velocity

  std::vector<std::size_t> iD;  // first index of D of body i

  explicit Workspace(const Model<S>& model) : BodyKinematics<S>(model), axes(model.nv) {
    const auto resize = [](std::size_t size, auto&... fields) { (fields.resize(size), ...); };
    const std::size_t n = model.parent.size();
    std::size_t entries = 0;
    for (std::size_t i = 0; i < n; ++i) {
      iD.push_back(entries);
      entries += model.dofs(i) * model.dofs(i);
    }
    resize(n, Xr, IA, pA, a, f, Ic, p, dv);
    resize(model.nv, U, u, qdd, tau, y);
    resize(entries, D_factors);
    D.assign(entries, S(std::numeric_limits<double>::quiet_NaN()));  // D_factors are of no matrix
  }

  // Calls visit(Quantity, field) for the variables of aba(), in the order of computation.
  template <class Visitor>
  void describe(Visitor&& visit) const {
    using By = Quantity::By;
    visit({"S", 1, By::velocity, "motion subspace", "1", "section 3.5, table 4.1"}, this->S_);
    visit({"Xup", 1, By::body, "motion transform from parent to body", "1; m",
           "Xup = XJ Xtree, table 7.1; (2.24)"},
          this->Xup);
    visit({"v", 1, By::body, "spatial velocity", "rad/s; m/s", "v = Xup v_p + S qd, table 7.1"},
          this->v);
    visit({"c", 1, By::body, "velocity-product acceleration", "rad/s^2; m/s^2",
           "c = cJ + v x S qd, table 7.1"},
          this->c);
    visit({"IA", 2, By::body, "articulated-body inertia", "kg m^2, kg m, kg",
           "IA = I + sum of X^T Ia X, table 7.1; (7.22)"},
          IA);
    visit({"pA", 2, By::body, "articulated-body bias force", "N m; N",
           "pA = v x* I v - f_ext + sum of X^T pa, table 7.1"},
          pA);
    visit({"U", 2, By::velocity, "articulated-body inertia times motion subspace",
           "kg m^2, kg m; kg m, kg", "U = IA S, table 7.1"},
          U);
    visit({"D", 2, By::square, "joint-space articulated inertia", "kg m^2; kg",
           "D = S^T U + armature, table 7.1"},
          D);
    visit({"u", 2, By::velocity, "joint force minus articulated-body bias force", "N m; N",
           "u = tau - S^T pA, table 7.1"},
          u);
    visit({"qdd", 3, By::velocity, "joint acceleration", "rad/s^2; m/s^2",
           "qdd = D^-1 (u - U^T (Xup a_p + c)), table 7.1"},
          qdd);
    visit({"a", 3, By::body, "spatial acceleration, with gravity as a_0 = -a_g", "rad/s^2; m/s^2",
           "a = Xup a_p + c + S qdd, table 7.1"},
          a);
  }
};

// Computes and returns Xr of body i, from Xup of the body and Xr of its parent.
template <class S>
Transform<S> place(const Model<S>& model, std::size_t i, Workspace<S>& w) {
  const auto p = static_cast<std::size_t>(model.parent[i]);
  return w.Xr[i] = p > 0 ? w.Xup[i] * w.Xr[p] : Transform<S>{w.Xup[i].E, {}};
}

}  // namespace twinarm
