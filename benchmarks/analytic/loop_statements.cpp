// What is known in the cases of closed loops, group D, and in those of integrators that are no
// single motion, group G.
#include "benchmarks/analytic/case_statements.h"

namespace twinarm {

const std::vector<CaseStatement>& loop_statements() {
  static const std::vector<CaseStatement> all = {
      {"D1",
       "A pendulum as a closed loop: a free body that a hinge holds to the world, or a particle in "
       "a "
       "plane at a fixed distance. Released level, it moves as the pendulum of B2: <p>θ = 2 asin(k "
       "cd(ω<sub>0</sub>t)), k = sin(θ<sub>0</sub>/2)</p>"},
      {"D2",
       "N four-bars in a row (IFToMM A02), 2N + 1 rods of 1 m and 1 kg, upright, the first corner "
       "at "
       "1 m/s. They pass a place where the constraints lose rank. All move as one pendulum: <p>q″ "
       "= "
       "c (g/l) sin q, c = ((N + 1)/2 + N)/((N + 1)/3 + N)</p>"},
      {"D3",
       "Andrews' squeezing mechanism (IFToMM A03; Hairer, Wanner): seven bodies in a plane, three "
       "loops, a motor of 0.033 N m, a spring of 4530 N/m, no gravity, within 0.03 s. The "
       "reference "
       "solves <p>M(q) q″ + h(q, q′) = J(q)<sup>T</sup>λ, g(q) = 0</p> in minimal coordinates and "
       "extended precision."},
      {"D4",
       "Bricard's mechanism (IFToMM A04): six rods and six hinges at right angles. Five equations "
       "hold it of which one says nothing new, so that it moves although the count says that it "
       "cannot: <p>rank J = 4 of 5 rows, 5 − 4 = 1 degree of freedom</p>"},
      {"D5",
       "A flyball governor (IFToMM A05): two balls of 5 kg on rods of 1 m, a slider on the shaft, "
       "started at 2π rad/s. Nothing turns it, so its angular momentum stays: <p>I(s) Ω = "
       "I(s<sub>0</sub>) Ω<sub>0</sub></p>"},
      {"D6",
       "A slider-crank: crank r = 0.1 m, rod l = 0.3 m, in a vertical plane, from 5 rad/s. With "
       "the "
       "piston's place written by the crank's angle it has one equation of motion: <p>x = r cos φ "
       "+ "
       "√(l<sup>2</sup> − r<sup>2</sup>sin<sup>2</sup>φ), M(φ) φ″ + M′(φ) φ′<sup>2</sup>/2 + V′(φ) "
       "= 0</p>"},
      {"D7",
       "A four-bar with links of 0.1, 0.35 and 0.3 m on a ground of 0.4 m, the crank at φ = 60° "
       "and "
       "10 rad/s: assembled from nearby, and its rates. <p>a e<sup>iφ</sup> + b e<sup>iβ</sup> = d "
       "+ c e<sup>iγ</sup>, a φ′ e<sup>iφ</sup> + b β′ e<sup>iβ</sup> = c γ′ e<sup>iγ</sup></p>"},
      {"G2-trend-",
       "The pendulum of B2 for a million steps of 10 ms. The energy of a symplectic scheme swings "
       "about that of a system nearby, and has no trend: <p>|E(t) − E(0)| = O(h<sup>p</sup>) for "
       "all t</p>"},
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
