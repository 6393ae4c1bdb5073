// Mechanisms with closed loops and known motion: group D of docs/reference/verification_cases.md.
//
// Reference values are closed forms, or were computed independently in extended precision and
// minimal coordinates. Planar mechanisms move in the x-z plane, z up; Andrews' squeezer in the x-y
// plane.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/analytic/support/trajectory_case.h"
#include "solver/dynamics/model_builder.h"
#include "solver/loops/loop_closure.h"

namespace twinarm {

struct LoopCase : CaseScene {
  std::vector<LoopClosure> loops{};
  std::function<std::vector<double>(const State<double>&, const Kinematics&)> read{};
  std::vector<std::string> readings{};  // names of read()'s values, with unit
  struct Sample {
    double t;
    std::vector<double> values;
  };
  std::vector<Sample> reference{};
  std::function<std::vector<double>(double t)> exact{};  // null: known at the samples only
  double step = 1e-3;                                    // of rk4
  double tolerance = 1e-6;  // of the largest error of all readings at all times, with rk4

  void set_model(Model<double> made) {  // the start is at rest at q = 0
    model = std::move(made);
    start = State<double>(model);
  }
  // A closed form, and samples of it.
  void set_exact(std::function<std::vector<double>(double t)> form,
                 std::initializer_list<double> times) {
    for (const double t : times) reference.push_back({t, form(t)});
    exact = std::move(form);
  }
};

LoopCase pendulum_on_hinge();   // D1: a free body, hinged to the world
LoopCase pendulum_on_circle();  // D1: a particle in a plane, at a distance of 1 m
LoopCase windows(int count);    // D2: N four-bars in a row, singular if all rods are collinear
LoopCase squeezer();            // D3: Andrews' mechanism
LoopCase bricard();             // D4: 6R, over-constrained
// D5: couplers as stiff spring-dampers, as rods of constant length, or as struts of negligible mass
// with implicit spring-dampers (semi-implicit integrators only).
enum class Couplers { springs, rods, implicit_struts };
LoopCase governor(Couplers couplers);
LoopCase slider_crank();  // D6
LoopCase four_bar();      // D7: angles and rates at one place

// ---- parts of the mechanisms ----

inline Pose at(double x, double y, double z) {
  return {Matrix3::Identity(), {x, y, z}};
}
// Frame with z along the world's y: of hinges in the x-z plane.
inline Matrix3 z_along_y() {
  return (Matrix3() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}
// A uniform slender rod from its link's origin along a unit vector.
inline BodyInertia rod(double mass, double length, const Vector3& along) {
  return {mass, 0.5 * length * along,
          mass * length * length / 12 * (Matrix3::Identity() - along * along.transpose())};
}

// A uniform rod on a hinge about -y, along x at angle 0: angles rotate x to z.
inline int add_rod(ModelBuilder& builder, const char* name, int parent, const char* joint, double x,
                   double mass, double length) {
  return builder.add_body(name, parent, joint, JointType::revolute, at(x, 0, 0), -Vector3::UnitY(),
                          rod(mass, length, Vector3::UnitX()));
}
// A hinge about y between two bodies, at these points of theirs.
inline LoopClosure hinge_closure(const std::string& name, int a, int b, const Vector3& p_A,
                                 const Vector3& p_B) {
  return {name, LoopType::hinge, a, b, {z_along_y(), p_A}, {z_along_y(), p_B}};
}

}  // namespace twinarm
