// What a page draws of a contact case: which coordinate of which body, and what is known of it in
// closed form. Its scenes are made and stepped by the case itself, while a recorder looks on
// (contact_scene.h).
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {

struct ContactLook {
  std::vector<std::string> readings;  // with unit: "height [m]"
  std::vector<double> (*read)(const ContactScene&);
  // Of curve `k` at a time; not a number where it is not known. Curves are readings, or runs.
  double (*exact)(std::size_t k, double t) = nullptr;
  std::vector<std::string> runs{};  // of one reading: a curve each. Empty: the first run
  std::size_t every = 1;            // of so many scenes one is such a run
  double until = HUGE_VAL;          // [s]
  double known_at = NAN;            // the only time at which exact() is known [s]
  bool from_start = false;          // readings count from where they begin
  // What is tried to find a limit, of which a run on either side is drawn; null: no search.
  const char* search = nullptr;
  double step = kStep;             // of the case [s]
  const char* no_steps = nullptr;  // why no error is drawn against the step; null: it is
  const char* about_steps = "";    // what is to be said of that error, where it has no order
};

// What several cases are looked at by, and why some have no error against the step.
namespace contact_looks {

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

// The same without an error against the step, and why; or as runs on either side of a limit.
inline ContactLook without_steps(ContactLook look, const char* why) {
  look.no_steps = why;
  return look;
}
inline ContactLook searched(ContactLook look, const char* what) {
  look.search = what;
  return without_steps(look, kSearch);
}
inline ContactLook of_runs(ContactLook look, std::vector<std::string> runs) {
  look.runs = std::move(runs);
  return look;
}

}  // namespace contact_looks

// A case with its mistake: the experiment multiplies one thing in it by `off`, which is 1 in the
// case; in the mistake it is some thousandths more or less, and the case must fail.
template <CaseResult (*experiment)(double off), int thousandths>
AnalyticCase contact_case(const char* name, double tolerance, ContactLook look = {}) {
  AnalyticCase c(name, tolerance,
                 [](bool mistaken) { return experiment(mistaken ? 1 + 1e-3 * thousandths : 1); });
  if (look.read) c.look = std::make_shared<const ContactLook>(std::move(look));
  return c;
}

}  // namespace twinarm
