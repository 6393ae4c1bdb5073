// References without a closed form: equations of motion in minimal coordinates, solved in extended
// precision. They share no code with the solver.
#pragma once

#include <functional>
#include <vector>

namespace twinarm::special {

using Numbers = std::vector<long double>;
// dx/dt at (t, x); dx has the size of x.
using Rates = std::function<void(long double t, const Numbers& x, Numbers& dx)>;

// x(t), from x at time 0. `max_step` [s]: a tenth of the shortest period gives 17 digits per step.
// Cost: 72 rates per step.
Numbers solution(const Rates& rates, Numbers x, long double t, long double max_step = 1.0L / 64);

// x of A x = right, A = (a, b; b, c): accelerations of two coordinates.
struct Two {
  long double first, second;
};
inline Two solve_two(long double a, long double b, long double c, Two right) {
  const long double det = a * c - b * b;
  return {(c * right.first - b * right.second) / det, (a * right.second - b * right.first) / det};
}

// Elliptic functions (parameter m = k^2), zeros of J_0 and integrals, by Boost.Math.
struct Jacobi {
  long double sn, cn, dn;
};
Jacobi jacobi(long double u, long double m);  // 0 <= m <= 1
long double quarter_period(long double m);    // K(m), m < 1
// u = u1 + (u0 - u1) cd^2(k t, m), from u0 at t = 0 to u1 after half a period, K(m) / k.
struct SquaredCd {
  long double u0, u1, k, m;
  long double at(long double t) const {
    const Jacobi j = jacobi(k * t, m);
    return u1 + (u0 - u1) * (j.cn / j.dn) * (j.cn / j.dn);
  }
  long double rate(long double t) const {
    const Jacobi j = jacobi(k * t, m);
    return -2 * k * (u0 - u1) * (1 - m) * j.cn * j.sn / (j.dn * j.dn * j.dn);
  }
  long double half_period() const { return quarter_period(m) / k; }
};
double zero_of_bessel(int k);  // the k-th positive zero of J_0, k from 1

// Integral of a smooth f from a to b: adaptive Gauss-Kronrod, relative tolerance 1e-17.
long double integral(const std::function<long double(long double)>& f, long double a,
                     long double b);

}  // namespace twinarm::special
