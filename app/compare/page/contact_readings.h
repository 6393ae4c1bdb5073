// What several contact cases are looked at by, and why some have no error against the step.
#pragma once

#include "app/compare/page/contact_plots.h"

namespace twinarm::compare_page::contact_look {

using Values = std::vector<double>;
using Scene = const ContactScene&;

inline constexpr const char* kLocated =
    "Events are located in time: what is left of the error does not come from the step.";
inline constexpr const char* kPartOfStep =
    "The end of sliding is met by the next step: the error is some part of a step.";
inline constexpr const char* kSearch =
    "The limit is found by bisection; drawn are its first runs on either side.";
inline constexpr const char* kCounted =
    "Faults are counted: there is no error to draw against the step.";
inline constexpr const char* kRounding =
    "What is kept is kept at every step: only rounding and the tolerance of the solver are left.";
inline constexpr const char* kResting =
    "Nothing moves: the tolerance of the solver is left, at any step.";

// Body by body, from 1 on; axes 0 to 2.
template <int body, int axis>
Values place(Scene s) {
  return {s.p(body)[axis]};
}
template <int body, int axis>
Values velocity(Scene s) {
  return {s.v(body)[axis]};
}
template <int... bodies>
Values velocities_x(Scene s) {
  return {s.v(bodies).x()...};
}
template <int radius_mm10>
Values speed_and_rim(Scene s) {
  return {s.v(1).x(), 1e-4 * radius_mm10 * s.w(1).y()};
}
inline double zero(std::size_t, double) {
  return 0;
}

}  // namespace twinarm::compare_page::contact_look
