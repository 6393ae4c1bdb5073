// What ABA can be asked to show beyond its workspace: the quantities that live only while a body is
// handed on to its parent. NoTrace compiles to nothing.
#pragma once

#include <vector>

#include "solver/model/field_description.h"
#include "solver/spatial/spatial.h"

namespace twinarm {

struct NoTrace {
  void moved() const {}  // between pass 1 and pass 2
  template <class... T>
  void felt(const T&...) const {}
};

// By body; bodies that the base carries hand nothing on, and theirs stay zero.
template <class S>
struct FullTrace {
  std::vector<ArticulatedInertia<S>> Ia;  // IA - U D^-1 U^T: felt through the joint
  std::vector<Force<S>> pa;               // pA + Ia c + U D^-1 u
  explicit FullTrace(std::size_t body_count) : Ia(body_count), pa(body_count) {}
  void moved() const {}
  template <class Inertia>
  void felt(std::size_t i, const Inertia& Ia_i, const Force<S>& pa_i) {
    Ia[i] = ArticulatedInertia<S>(Ia_i);
    pa[i] = pa_i;
  }
  // As Workspace::describe().
  template <class Visitor>
  void describe(Visitor&& visit) const {
    using By = Quantity::By;
    visit({"Ia", 2, By::body, "inertia that the parent feels through the joint", "kg m^2, kg m, kg",
           "Ia = IA - U D^-1 U^T, table 7.1"},
          Ia);
    visit({"pa", 2, By::body, "force that the parent feels through the joint", "N m; N",
           "pa = pA + Ia c + U D^-1 u, table 7.1"},
          pa);
  }
};

}  // namespace twinarm
