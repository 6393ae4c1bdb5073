#include "benchmarks/analytic/support/special_functions.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

namespace twinarm::special {

Jacobi jacobi(long double u, long double m) {
  Jacobi j{};
  j.sn = boost::math::jacobi_elliptic(std::sqrt(m), u, &j.cn, &j.dn);
  // The library's dn is 0/0 where cn = 0, and loses all digits of a small one there.
  j.dn = std::sqrt(1 - m + m * j.cn * j.cn);
  return j;
}

long double quarter_period(long double m) {
  return boost::math::ellint_1(std::sqrt(m));
}

long double arithmetic_geometric_mean(long double a, long double b) {
  while (std::abs(a - b) > 1e-18L * std::abs(a)) {
    const long double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    if (mean == a) break;
    a = mean;
  }
  return a;
}

double zero_of_bessel(int k) {
  return boost::math::cyl_bessel_j_zero(0.0, k);
}

long double integral(const std::function<long double(long double)>& f, long double a,
                     long double b) {
  if (a == b) return 0;
  return boost::math::quadrature::gauss_kronrod<long double, 31>::integrate(f, a, b, 15, 1e-17L);
}

}  // namespace twinarm::special
