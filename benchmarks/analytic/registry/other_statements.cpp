// What is known in the cases of couplings, of integrators and of published engine tasks that are no
// single motion: groups F, G, H.
#include "benchmarks/analytic/registry/case_statements.h"

namespace twinarm {

const std::vector<CaseStatement>& other_statements() {
  static const std::vector<CaseStatement> all = {
      {"F3",
       "The same arm follows its target for 3 s; the error of a joint is that of its angle. "
       "<p>max |q<sub>K</sub> &minus; q|, (1/T) &int; |q<sub>K</sub> &minus; q| dt</p>"},
      {"F4",
       "A spring-damper k, b holds a hinge of inertia I to a target at rest, in steps of h. The "
       "amplitude grows where a root of the scheme's characteristic polynomial leaves the unit "
       "circle; the edge is found by bisection with the real stepper. <p>&alpha; = k "
       "h<sup>2</sup>/I, &beta; = b h/I, |z(&alpha;, &beta;)| = 1</p>"},
      {"F4-implicit",
       "The implicit treatment of that spring-damper is backward Euler, and never grows: "
       "<p>|z|<sup>2</sup> = 1/(1 + &alpha; + &beta;) &lt; 1</p>"},
      {"F4-implicit-euler",
       "The same spring-damper stepped by implicit Euler: no step makes it grow. "
       "<p>|z(&alpha;, &beta;)| &lt; 1 for all &alpha;, &beta; &gt; 0</p>"},
      {"F4-implicit-midpoint",
       "The same by the implicit midpoint rule: <p>|z(&alpha;, &beta;)| &le; 1 for all &alpha;, "
       "&beta; &ge; 0</p>"},
      {"F4-trapezoid",
       "The same by the trapezoidal rule: <p>|z(&alpha;, &beta;)| &le; 1 for all &alpha;, &beta; "
       "&ge; 0</p>"},
      {"F4-implicit-damper",
       "Only the damper is implicit: <p>&alpha; &lt; 4 + 2&beta;, &alpha; = k h<sup>2</sup>/I, "
       "&beta; = b h/I</p>"},
      {"H1-rolling",
       "A box of M = 10 kg carries n = 25 balls of m = 1 kg and is pulled with F = 150 N (RaiSim's "
       "SimBenchmark). It slides, and the balls roll on it: <p>F &minus; &mu; (M + n m) g = (M + "
       "(2/7) n m) a, a<sub>ball</sub> = (2/7) a</p>"},
      {"H1-bouncing",
       "49 balls of m = 10 kg fall from h = 5 m and bounce without loss for 20 s: <p>E = n m g h = "
       "const</p>"},
      {"H1-666",
       "216 balls in a cube of six by six by six fall on each other without friction; none shall "
       "enter another. <p>&Sigma; d<sup>2</sup> = 0, d the overlap of two balls</p>"},
      {"H1-666-elastic", "The same without loss: <p>E = const</p>"},
      {"G2-trend-",
       "The pendulum of B2 for a million steps of 10 ms. The energy of a symplectic scheme swings "
       "about that of a system nearby, and has no trend: <p>|E(t) − E(0)| = O(h<sup>p</sup>) for "
       "all t</p>"},
      {"G1-order-",
       "The pendulum of B2 after 1 s, with steps of 10, 5 and 2.5 ms: the angle of a scheme of "
       "first "
       "order is off by half as much as the step halves. <p>e(h) = C h, "
       "log<sub>2</sub>(e(h)/e(h/2)) "
       "= 1</p>"},
      {"G4-",
       "The double pendulum of rods, C2, after 1 s, with steps that halve four times. On "
       "logarithmic axes the error is a straight line, and its slope is the order: <p>e(h) = C "
       "h<sup>p</sup>, p = log<sub>2</sub>(e(h)/e(h/2))</p>"},
      {"G4-dopri5",
       "The same by dopri5, with tolerances from 1e−6 to 1e−10: the error is in proportion. <p>e = "
       "C "
       "tol</p>"},
  };
  return all;
}

}  // namespace twinarm
