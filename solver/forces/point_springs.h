// Spring-dampers and force laws along the line between two points (translational spring-dampers):
//   l = |p_B - p_A|,   e = (p_B - p_A) / l,   l' = e . (v_B - v_A)
//   tension f = k (l - l0) + c l' + law(l, l', t)
// f e acts on A and -f e on B: a positive tension pulls the points together. Where the points
// coincide the line has no direction, and there is no force.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/expressions/expression_tape.h"
#include "solver/forces/force_source.h"

namespace twinarm {

struct PointSpring {
  struct End {
    int body = 0;  // 0: the world
    Vector3 p_L = Vector3::Zero();
  };
  std::string name;
  End a, b;
  double stiffness = 0, damping = 0, rest_length = 0;  // [N/m, N s/m, m]
  std::optional<ExpressionTape> law = std::nullopt;    // of (l, l', t) [N]
};

class PointSprings final : public ForceSource, public Checkpointable {
 public:
  explicit PointSprings(std::vector<PointSpring> springs) : springs_(std::move(springs)) {}

  // Explicit: force at the state.
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;

  struct Reading {
    Vector3 p_A, p_B;                          // world
    double length = 0, rate = 0;               // l, l' [m, m/s]
    double elastic = 0, damping = 0, law = 0;  // parts of the tension [N]
    Vector3 direction = Vector3::Zero();       // e
    double tension() const { return elastic + damping + law; }
  };
  Reading reading(std::size_t i, const State<double>& x, const Kinematics& k) noexcept;
  const std::vector<PointSpring>& springs() const { return springs_; }

 private:
  std::vector<PointSpring> springs_;
};

}  // namespace twinarm
