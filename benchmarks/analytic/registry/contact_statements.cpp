// What is known in the cases of contact, group E: contact_*.cpp measure it.
#include "benchmarks/analytic/registry/case_statements.h"

namespace twinarm {

const std::vector<CaseStatement>& contact_statements() {
  static const std::vector<CaseStatement> all = {
      {"E1",
       "A ball falls from h = 1 m onto a floor, with a restitution of e = 0.8. It meets the floor "
       "for the nth time at <p>t<sub>n</sub> = √(2h/g) (1 + 2(e + e<sup>2</sup> + … + "
       "e<sup>n−1</sup>)), v<sub>n</sub> = e<sup>n−1</sup> √(2 g h)</p>"},
      {"E1-rest",
       "The same ball bounces without end in a time that has one: from <p>t = √(2h/g) (1 + e)/(1 − "
       "e) = 4.0637&nbsp;s</p> on it lies still."},
      {"E1-energy",
       "The same ball with restitutions from 0 to 1: an impact takes energy or, with e = 1, keeps "
       "it. <p>E<sub>after</sub> − E<sub>before</sub> = −(1 − e<sup>2</sup>) m "
       "v<sup>2</sup>/2</p>"},
      {"E2",
       "A block of 2 kg on an incline of 30° with a friction of μ = 0.5 slides, for tan 30° = "
       "0.577 "
       "is more than that: <p>x″ = g (sin α − μ cos α)</p>"},
      {"E2-creep",
       "A block of 2 kg on an incline of 30° with μ = 0.6 &gt; tan 30° is at rest, and stays "
       "there: "
       "exact Coulomb friction does not creep. <p>x(t) = x(0)</p>"},
      {"E2-forces",
       "The block at rest on 30°: what carries it is its weight. <p>F = m g sin α = 9.81&nbsp;N, N "
       "= m "
       "g "
       "cos α = 16.991&nbsp;N</p>"},
      {"E2-up",
       "The block is pushed uphill at 3 m/s, μ = 0.5: friction and weight slow it down together. "
       "<p>t = v/(g (sin α + μ cos α)), s = v<sup>2</sup>/(2g (sin α + μ cos α))</p>"},
      {"E2-return",
       "The block is pushed uphill at 3 m/s, and comes back to where it was: friction has taken "
       "energy on both ways. <p>v<sub>back</sub> = v √((sin α − μ cos α)/(sin α + μ cos α))</p>"},
      {"E2-stop",
       "A block on the flat starts at 3 m/s, μ = 0.4, in four directions: <p>t = v/(μ g), s = "
       "v<sup>2</sup>/(2 μ g)</p>"},
      {"E2-headings",
       "The same in four directions: a cone of friction knows none, a pyramid does. "
       "<p>s(0°) = s(15°) = s(30°) = s(45°)</p>"},
      {"E2-threshold",
       "The least friction that holds a block on 30°, by bisection: <p>μ = tan 30° = 0.57735</p>"},
      {"E3-tilt",
       "A block, b = 0.2 m wide and h = 0.5 m high, on an incline that it cannot slide down: it "
       "topples where its weight passes the lower edge. <p>tan α = b/h</p>"},
      {"E3-push",
       "A level force at the upper edge of the block topples it from <p>F = m g b/(2h)</p> on."},
      {"E3-slide",
       "The block slides down 30° with a friction that is too small to hold it; the friction "
       "topples it from <p>μ = b/h = 0.4</p> on, whatever the incline."},
      {"E3-curb",
       "The block slides without friction into a low curb at v = 1 m/s and turns about its edge; "
       "the impact is plastic: <p>ω = m v (h/2)/I<sub>edge</sub>, I<sub>edge</sub> = m "
       "(b<sup>2</sup> + h<sup>2</sup>)/3</p>"},
      {"E3-over",
       "How fast it must be to turn over that curb: the energy after the impact lifts its centre "
       "above the edge. <p>I<sub>edge</sub> ω<sup>2</sup>/2 = m g (√(b<sup>2</sup> + "
       "h<sup>2</sup>) − h)/2</p>"},
      {"E3-rocking",
       "A block that leans by 0.1 rad falls back, and goes on about its other edge (Housner 1963): "
       "<p>(ω<sub>+</sub>/ω<sub>−</sub>)<sup>2</sup> = (1 − (3/2) sin<sup>2</sup>α)<sup>2</sup>, "
       "tan α = b/h</p>"},
      {"E4",
       "Sphere, disc and hoop of R = 0.1 m, I = c m R<sup>2</sup> with c = 2/5, 1/2 and 1, roll "
       "down 20°: <p>x″ = g sin α/(1 + c), F = m g sin α c/(1 + c)</p>"},
      {"E4-threshold",
       "The least friction with which sphere, disc and hoop roll on 20° without slipping: <p>μ = "
       "tan α c/(1 + c)</p>"},
      {"E4-slip",
       "A sphere on 20° with μ = 0.05, too little to roll: it slips, and turns. <p>x″ = g (sin α − "
       "μ cos α), R ω′ = (5/2) μ g cos α</p>"},
      {"E4-small", "A sphere of R = 0.05 m rolls down 15°: <p>x″ = (5/7) g sin α</p>"},
      {"E5-time",
       "A billiard ball is struck to v = 2 m/s without spin, μ = 0.2. It slides, and rolls from "
       "<p>t = 2v/(7 μ g), x = 12 v<sup>2</sup>/(49 μ g)</p> on."},
      {"E5-speed",
       "How fast the ball rolls then, whatever μ is: without spin, and with a top spin R ω of 4 "
       "m/s. <p>v<sub>end</sub> = (5/7) v + (2/7) R ω</p> Without spin it has lost 2/7 of its "
       "energy."},
      {"E6-two",
       "1 kg at 2 m/s meets 3 kg at rest, e = 0.6: momentum, and Newton's law of impact. <p>v<sub>1"
       "</sub> = (m<sub>1</sub> − e m<sub>2</sub>) v/(m<sub>1</sub> + m<sub>2</sub>), "
       "v<sub>2</sub> "
       "= (1 + e) m<sub>1</sub> v/(m<sub>1</sub> + m<sub>2</sub>)</p>"},
      {"E6-cradle",
       "Newton's cradle of five equal balls with gaps of 0.1 and 1 mm, e = 1: one impact after the "
       "other, and the last ball leaves with the speed of the first. <p>v<sub>5</sub> = v</p>"},
      {"E6-lossy",
       "The cradle with e = 0.9: each impact hands (1 + e)/2 on. <p>v<sub>5</sub> = ((1 + "
       "e)/2)<sup>4</sup> v</p>"},
      {"E6-touching",
       "Three balls that touch from the start, e = 1, by Newton's law in all contacts at once: "
       "<p>v<sub>1</sub> = −v/3, v<sub>2</sub> = v<sub>3</sub> = 2v/3</p>"},
      {"E6-momentum", "All cradles, with gaps and without, e from 0 to 1: <p>Σ m v = const</p>"},
      {"E6-energy", "The same cradles: <p>Σ m v<sup>2</sup>/2</p> never grows."},
      {"E7-sign",
       "A rod that slides on its lower end, at θ to it (Painlevé 1895). A normal force on the "
       "end "
       "presses it away from the floor only below <p>μ = (1/3 + cos<sup>2</sup>θ)/(sin θ cos "
       "θ)</p>"},
      {"E7-rod",
       "The same rod with μ from 0.3 to 5. Below 4/3 it slides on; above, no force solves the "
       "equations, and an impulse must (impact without collision). In all cases: finite, solved, "
       "no energy won, no sinking. <p>μ<sub>crit</sub> = 4/3 at cos<sup>2</sup>θ = 1/5</p>"},
      {"E8",
       "A thin coin rolls round on its rim, leaning by α = 10°, while its centre stands still "
       "(Euler's disc): <p>Ω<sup>2</sup> = 4g/(R sin α)</p>"},
      {"E9",
       "A tippe-top, a sphere whose centre of mass lies 3 mm below its middle, spins at 155 rad/s "
       "and rubs on the floor. Whatever the friction, Jellett's integral stays: <p>J = −L · r</p> "
       "L "
       "the angular momentum, r from the centre of mass to the contact."},
      {"E9-over",
       "The same top turns over: as Jellett's integral stays while friction takes energy, the "
       "state of least energy is upside down. <p>cos θ → −1</p>"},
      {"E10-time",
       "A rattleback: an ellipsoid whose principal axes of inertia lie askew to those of its "
       "shape. "
       "Spun the one way it begins to rattle, stops, and turns the other way; −5 rad/s turn round "
       "at "
       "4.156 s by an independent integration of rolling, <p>v = −ω × r</p> with r from the centre "
       "of mass to the contact."},
      {"E10-spin",
       "The same stone in steps that locate their events: rolling then loses nothing, <p>v = −ω × "
       "r</p> and the spin after it has turned round is that of the independent integration."},
      {"E10-other",
       "The same stone, spun the other way, goes on for 20 s: <p>ω<sub>z</sub>(t) &gt; 0</p>"},
      {"E11",
       "Ten cubes of 1 kg stand on each other, each up to 1 cm off the middle, for 10 s. Box i "
       "from "
       "below carries itself and all above: <p>N<sub>i</sub> = (n − i + 1) m g</p>"},
      {"E11-drift", "The same stack: no box slides. <p>x(t) = x(0)</p>"},
      {"E11-sinking", "The same stack: no box sinks. <p>z(t) = z(0)</p>"},
      {"E11-heavy",
       "100 kg stand on 1 kg: what is hard for a solver that goes round from contact to contact. "
       "<p>N<sub>1</sub> = (m<sub>1</sub> + m<sub>2</sub>) g, N<sub>2</sub> = m<sub>2</sub> g</p>"},
      {"E12-bowl",
       "A sphere of r = 0.1 m rolls without slipping in a bowl of R = 1 m, 0.02 rad to and fro: "
       "<p>ω = √(5g/(7(R − r)))</p>"},
      {"E12-trough", "The same sphere in a trough: <p>ω = √(5g/(7(R − r)))</p>"},
      {"E12-cylinder", "A cylinder in the trough: <p>ω = √(2g/(3(R − r)))</p>"},
      {"E12-turntable",
       "A ball rolls on a table that turns at Ω. Its centre goes round a circle that is not about "
       "the table's axis, at <p>v′ = (2/7) Ω × v</p> so that it takes 7/2 turns of the table."},
      {"E12-circle",
       "The same ball: where on that circle it is, at any time. <p>r(t) − c = Rot(2Ωt/7) (r(0) − "
       "c), c = −(5/2) r(0)</p>"},
      {"E12-tube",
       "A ball rolls round in an upright tube, and does not sink: it goes up and down at <p>ω = "
       "√(2/7) φ′</p> where φ′ is the rate at which it goes round."},
      {"E13-stands",
       "A semicircular arch of 20 loose stones, t/R = 0.12, stands by its weight alone: a line of "
       "thrust stays within all joints. With H and m thrust and moment at the crown, W and X "
       "weight "
       "and middle of the stones up to the joint at φ: <p>r(φ) = (m + W X)/(W sin φ + H cos φ), "
       "R − t/2 &lt; r(φ) &lt; R + t/2</p>"},
      {"E13-falls",
       "The same arch with t/R = 0.095: no line of thrust stays within, and it falls. <p>t/R &lt; "
       "0.1073</p>"},
      {"E13-limit",
       "The least thickness at which that arch stands, against the least that leaves room for a "
       "line "
       "of thrust. <p>r(φ) = (m + W X)/(W sin φ + H cos φ), R − t/2 &lt; r(φ) &lt; R + t/2</p>"},
      {"E14",
       "Two blocks press a wedge between them with 100 N. It stays if friction can hold it on its "
       "flanks: <p>μ ≥ tan θ</p> θ half the angle of the wedge: 5°, 15°, 30°."},
      {"E16",
       "A sphere without spin comes down at (2, −3) m/s, e = 0.8. With little friction it slips "
       "through the impact, <p>v<sub>t</sub><sup>+</sup> = v<sub>t</sub> − μ (1 + e) "
       "v<sub>n</sub>, R ω<sup>+</sup> = "
       "(5/2) μ (1 + e) v<sub>n</sub>,</p> with more than μ = 2 v<sub>t</sub>/(7 (1 + e) "
       "v<sub>n</sub>) it ends rolling: <p>v<sub>t</sub><sup>+</sup> = R ω<sup>+</sup> = (5/7) "
       "v<sub>t</sub></p>"},
      {"E17",
       "A rod at 45° falls on its end with v = 2 m/s, e = 0.5 (Routh 1860). Impulses p and q up "
       "and "
       "sideways act on the end; n and t are its responses: <p>p = (1 + e) v/(n − μ t), q = μ "
       "p</p> "
       "where it slips, and where it sticks, from μ = t/n on, <p>p = (1 + e) v n/(n<sup>2</sup> − "
       "t<sup>2</sup>), q = p t/n</p>"},
      {"E17-energy",
       "The rod with velocities along the floor, 630 impacts. Newton's law of impact with friction "
       "could gain energy here (Kane, Levinson 1985); this solver's does not: "
       "<p>E<sub>after</sub> ≤ E<sub>before</sub></p>"},
  };
  return all;
}

}  // namespace twinarm
