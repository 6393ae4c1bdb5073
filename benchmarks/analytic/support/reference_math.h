// References that are no closed form: a case's own equations of motion, in coordinates of its own,
// solved in extended precision. They share nothing with the solver.
#pragma once

#include <functional>
#include <vector>

namespace twinarm::special {

using Numbers = std::vector<long double>;
// dx/dt at (t, x); dx has the size of x.
using Rates = std::function<void(long double t, const Numbers& x, Numbers& dx)>;

// x(t), from x at time 0. `longest` step [s]: a tenth of the shortest period in it gives 17 digits
// of what a step does. Cost: 72 rates a step.
Numbers solution(const Rates& rates, Numbers x, long double t, long double longest = 1.0L / 64);

// x of A x = b, A = (a, b; b, c): the accelerations of two coordinates.
struct Two {
  long double first, second;
};
inline Two solve_two(long double a, long double b, long double c, Two right) {
  const long double det = a * c - b * b;
  return {(c * right.first - b * right.second) / det, (a * right.second - b * right.first) / det};
}

// Functions that references need: elliptic ones, Bessel's and integrals, by Boost.Math, in extended
// precision. m = k^2 is the parameter of the elliptic functions.
struct Jacobi {
  long double sn, cn, dn;
};
Jacobi jacobi(long double u, long double m);  // 0 <= m <= 1
long double quarter_period(long double m);    // K(m), m < 1
long double arithmetic_geometric_mean(long double a, long double b);
double zero_of_bessel(int k);  // the k-th positive zero of J_0, k from 1

// Of a smooth f from a to b: adaptive Gauss-Kronrod, to 1e-17 of the result's size.
long double integral(const std::function<long double(long double)>& f, long double a,
                     long double b);

}  // namespace twinarm::special
