// Gragg's extrapolated midpoint rule (Hairer, Norsett, Wanner, Solving Ordinary Differential
// Equations I, section II.9): 2, 4 .. 16 substeps of a step, extrapolated in h^2, order 16.
#include "benchmarks/analytic/support/reference_math.h"

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

namespace twinarm::special {
namespace {

constexpr std::size_t kColumns = 8;

// The modified midpoint rule, n substeps of h / n.
Numbers midpoint_rule(const Rates& rates, long double t, const Numbers& x, long double h, int n) {
  const long double part = h / static_cast<long double>(n);
  Numbers before = x, now = x, rate(x.size());
  rates(t, x, rate);
  for (std::size_t i = 0; i < x.size(); ++i) now[i] += part * rate[i];
  for (int k = 1; k < n; ++k) {
    rates(t + static_cast<long double>(k) * part, now, rate);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const long double next = before[i] + 2 * part * rate[i];
      before[i] = now[i];
      now[i] = next;
    }
  }
  rates(t + h, now, rate);
  for (std::size_t i = 0; i < x.size(); ++i) now[i] = (now[i] + before[i] + part * rate[i]) / 2;
  return now;
}

}  // namespace

Numbers solution(const Rates& rates, Numbers x, long double t, long double max_step) {
  const long double steps = std::ceil(t / max_step), h = steps > 0 ? t / steps : 0;
  for (long double step = 0; step < steps; ++step) {
    std::array<Numbers, kColumns> row;  // Neville: row[j] has been extrapolated k - j times
    for (std::size_t k = 0; k < kColumns; ++k) {
      row[k] = midpoint_rule(rates, step * h, x, h, 2 * static_cast<int>(k + 1));
      for (std::size_t j = k; j-- > 0;) {
        const long double ratio = static_cast<long double>(k + 1) / static_cast<long double>(j + 1);
        for (std::size_t i = 0; i < x.size(); ++i)
          row[j][i] = row[j + 1][i] + (row[j + 1][i] - row[j][i]) / (ratio * ratio - 1);
      }
    }
    x = row[0];
  }
  return x;
}

Jacobi jacobi(long double u, long double m) {
  Jacobi j{};
  j.sn = boost::math::jacobi_elliptic(std::sqrt(m), u, &j.cn, &j.dn);
  // Boost's dn is 0/0 at cn = 0 and loses all digits near it if dn is small.
  j.dn = std::sqrt(1 - m + m * j.cn * j.cn);
  return j;
}

long double quarter_period(long double m) {
  return boost::math::ellint_1(std::sqrt(m));
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
