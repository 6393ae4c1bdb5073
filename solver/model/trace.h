// Hooks into aba() for temporaries that the workspace does not store: Ia and pa of pass 2. NoTrace
// compiles to nothing.
#pragma once

#include <vector>

#include "solver/model/field_description.h"
#include "solver/spatial/spatial.h"

namespace twinarm {

struct NoTrace {
  void after_pass_1() const {}
  template <class... T>
  void transmitted(const T&...) const {}
};

// Indexed by body; zero for children of the base, for which aba() does not compute them.
template <class S>
struct FullTrace {
  std::vector<ArticulatedInertia<S>> Ia;  // IA - U D^-1 U^T
  std::vector<Force<S>> pa;               // pA + Ia c + U D^-1 u
  explicit FullTrace(std::size_t body_count) : Ia(body_count), pa(body_count) {}
  void after_pass_1() const {}
  template <class Inertia>
  void transmitted(std::size_t i, const Inertia& Ia_i, const Force<S>& pa_i) {
    Ia[i] = ArticulatedInertia<S>(Ia_i);
    pa[i] = pa_i;
  }
  // As Workspace::describe().
  template <class Visitor>
  void describe(Visitor&& visit) const {
    using By = Quantity::By;
    visit({"Ia", 2, By::body, "apparent inertia across the joint", "kg m^2, kg m, kg",
           "Ia = IA - U D^-1 U^T, table 7.1"},
          Ia);
    visit({"pa", 2, By::body, "bias force transmitted to the parent", "N m; N",
           "pa = pA + Ia c + U D^-1 u, table 7.1"},
          pa);
  }
};

}  // namespace twinarm
