// Mechanisms with closed loops whose motion is known: group D of docs/reference/verification_cases.md.
//
// Each case holds the mechanism, where it starts, what is read off it, and reference values by
// time. Those were computed elsewhere in extended precision, in minimal coordinates, or are closed
// forms; nothing here computes with this project's solver. Planar mechanisms move in the x-z plane,
// z up, but for Andrews' squeezer (x-y).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solver/forces/force_source.h"
#include "solver/loops/loop_closure.h"

namespace twinarm {

struct LoopCase {
  std::string title{};
  Model<double> model{};
  std::vector<LoopClosure> loops{};
  State<double> start{};
  std::shared_ptr<ForceSource> source{};  // null: gravity alone
  // Energy of the source, if it has one at every state [J].
  std::function<double(const State<double>&)> stored{};
  std::function<std::vector<double>(const State<double>&, const Kinematics&)> read{};
  std::vector<std::string> readings{};  // what read() gives, in order, with unit
  struct Sample {
    double t;
    std::vector<double> values;
  };
  std::vector<Sample> reference{};
  double step = 1e-3;       // of rk4, with which
  double tolerance = 1e-6;  // holds for the largest error of all readings at all times

  void set_model(Model<double> made) {  // which starts at rest, at zero
    model = std::move(made);
    start = State<double>(model);
  }
};

LoopCase pendulum_on_hinge();   // D1: a free body, hinged to the world
LoopCase pendulum_on_circle();  // D1: a particle in a plane, at a distance of 1 m
LoopCase windows(int count);    // D2: N four-bars in a row, singular where all rods are in a line
LoopCase squeezer();            // D3: Andrews' mechanism
LoopCase bricard();             // D4: 6R, over-constrained
// D5: couplers that are stiff spring-dampers; rods of constant length; and spring-dampers as struts
// of negligible mass whose implicit spring is an armature (semi-implicit integrators only).
enum class Couplers { springs, rods, implicit_struts };
LoopCase governor(Couplers couplers);
LoopCase slider_crank();  // D6
LoopCase four_bar();      // D7: angles and rates at one place

// All that have a reference in time, for rk4.
std::vector<LoopCase> all_loop_cases();

}  // namespace twinarm
