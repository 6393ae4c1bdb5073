// Interior-point methods on one island: middle phase of island_solver.h.
#pragma once

#include "solver/impulses/newton_matrix.h"
#include "solver/linear_algebra/second_order_cone.h"

namespace twinarm {

class InteriorPhase {
 public:
  static constexpr int kStarts = 8;  // of follow_path()

  InteriorPhase(ImpulseIsland& island, NewtonMatrix& matrix) : island_(island), matrix_(matrix) {}

  // interior_point.cpp. Sets p to the best iterate; returns the number of iterations.
  int solve();
  // central_path.cpp: a different curve for each `start`. Sets p to the best point on it; returns
  // the number of steps.
  int follow_path(int start);

 private:
  bool has_cone(const ImpulseConstraint& c) const;
  double initialize(int start);
  double evaluate(double& residual);
  void evaluate_cone(ImpulseConstraint& c, int i);
  void couple_discs(int contact);
  double find_direction(double s, bool correct);
  void solve_kkt(const std::vector<ConeVec>& r, double factor);
  void back_substitute(const std::vector<ConeVec>& r);
  std::array<double, 2> tangential_dx(int i, double dp_n, const std::array<double, 2>& dz) const;
  void update(double step);
  struct CentralPath;

  ImpulseIsland& island_;
  NewtonMatrix& matrix_;
  std::vector<int> cones_;
  double shift_factor_ = 1;  // homotopy: factor of the de Saxce shift mu |u_t|
  double smoothing_ = 0;     // homotopy: smoothing of the kink of |u_t| at 0, relative to `kink`
  // By constraint.
  std::vector<ConeVec> x_, z_, dx_, dz_, d_, r_z_, right_, kept_, d_z_;
  struct ConeTerms {  // ipm_equations.h
    double arm = 0, kink = 0, slip = 0, A = 0, C = 0, n = 0;
    std::array<double, 2> h{}, l{};
    std::array<double, 3> S{};  // entries aa, ab, bb
  };
  std::vector<ConeTerms> terms_;
  std::vector<ConeScaling> scaling_;
  // central_path.cpp: direction or point in v, x, z and s (directions: relative to s)
  struct Direction {
    std::vector<double> v;
    std::vector<ConeVec> x, z;
    double s = 0;
  };
  Direction correction_, tangent_, last_, saved_;
};

}  // namespace twinarm
