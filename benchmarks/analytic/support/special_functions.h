// Functions that references need: elliptic ones, Bessel's and integrals, by Boost.Math, in extended
// precision. m = k^2 is the parameter of the elliptic functions.
#pragma once

#include <functional>

namespace twinarm::special {

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
